// Bags of words of images, as far as commands have them in common.
#ifndef GSLAM_APPS_IMAGE_BAGS_H
#define GSLAM_APPS_IMAGE_BAGS_H

#include <gslam/vocabulary/transform.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "options.h"

namespace app {

/// An image by its words.
struct ImageBag {
  std::string name;                ///< of the image
  std::size_t features = 0;        ///< that were found in it
  gslam::BowVector bow;            ///< its words
  gslam::FeatureVector by_node{};  ///< its features by node
};

/// Declares the options of those who turn images into bags.
void declareBags(Options& options);

/// Calls a function for each image, until Ctrl-C.
/// @param options     where they were declared
/// @param vocabulary  whose words; its kind of descriptors says which features, unless --feature
/// @param words       the arguments that name images
/// @param levels_up   for the features by node
/// @param visit       gets each image in its order
/// @return whether it came to the end
bool forEachBag(const Options& options, const gslam::Vocabulary& vocabulary,
                const std::vector<std::string>& words, std::uint32_t levels_up,
                const std::function<void(const ImageBag&)>& visit);

}  // namespace app

#endif  // GSLAM_APPS_IMAGE_BAGS_H
