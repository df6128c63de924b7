#ifndef GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_PLACE_INDEX_H
#define GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_PLACE_INDEX_H

#include <gslam/core.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "options.h"
#include "scene/view.h"

namespace visual {

/// A keyframe that looks like a view.
struct SimilarPlace {
  gslam::KeyframeId keyframe;
  double score;  ///< 0 to 1; of bags of words
};

/// Which keyframes look like this view? By a vocabulary that is loaded, or trained on the first
/// keyframes, and again when there are many more of them.
///
/// Threads may share it.
class PlaceIndex {
 public:
  /// @throws FileError, ParseError when the vocabulary cannot be read
  PlaceIndex(const LoopOptions& options, std::uint64_t seed);
  ~PlaceIndex();

  /// Adds a keyframe. Its descriptors are kept as long as a vocabulary may be trained.
  /// @throws ArgumentError when they are not such as the vocabulary has
  void add(gslam::KeyframeId id, const std::shared_ptr<const View>& view);
  void remove(gslam::KeyframeId id);

  /// The keyframes that look most like a view, the best first; all of them without scores, the
  /// newest first, as long as there is no vocabulary.
  std::vector<SimilarPlace> similar(const View& view, std::size_t count) const;
  /// How much a keyframe looks like a view; 0 where there is no vocabulary or no such keyframe.
  double score(gslam::KeyframeId id, const View& view) const;
  bool hasVocabulary() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_PLACE_INDEX_H
