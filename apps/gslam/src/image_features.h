// Features of images, by OpenCV, on all processors.
#ifndef GSLAM_APPS_IMAGE_FEATURES_H
#define GSLAM_APPS_IMAGE_FEATURES_H

#include <gslam/vocabulary/descriptors.h>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <opencv2/features2d.hpp>
#include <string>
#include <vector>

#include "image_stream.h"
#include "options.h"

namespace app {

/// A kind of feature that OpenCV finds.
struct FeatureKind {
  const char* name;
  bool is_binary;
  std::uint32_t size;  ///< bytes of its descriptors, or floats
};

/// All kinds.
const std::vector<FeatureKind>& featureKinds();
/// Their names.
std::vector<std::string> featureNames();
/// The kind of that name, which is one of these.
const FeatureKind& featureKind(const std::string& name);
/// The kind that a vocabulary is for.
/// @throws Error when no kind has such descriptors
const FeatureKind& featureKindFor(const gslam::DescriptorFormat& format);

/// What was found in an image.
struct ImageFeatures {
  std::string name;
  cv::Mat descriptors;  ///< a row each; may be empty
};

/// The features of all images of a stream, in their order. They do not depend on the threads.
class FeatureStream {
 public:
  /// Declares --features and --threads.
  static void declare(Options& options);

  /// @param options  where they were declared
  /// @param kind     of feature
  /// @param images   must outlive it
  FeatureStream(const Options& options, const FeatureKind& kind, ImageStream& images);

  /// Those of the next image; false behind the last one.
  /// @throws FileError for an image that cannot be read
  bool next(ImageFeatures& features);

 private:
  // An image of those that are worked on at once.
  struct Slot {
    SourceImage image;
    cv::Mat descriptors;
  };

  void fill();
  void describe(Slot& slot);
  cv::Ptr<cv::Feature2D> takeDetector();

  ImageStream& images_;
  const std::string kind_;
  const std::size_t most_;
  const unsigned threads_;
  std::mutex mutex_;
  std::vector<cv::Ptr<cv::Feature2D>> detectors_;  // that no thread uses; they are large
  std::vector<Slot> slots_;
  std::size_t at_ = 0, filled_ = 0;  // of the slots
};

}  // namespace app

#endif  // GSLAM_APPS_IMAGE_FEATURES_H
