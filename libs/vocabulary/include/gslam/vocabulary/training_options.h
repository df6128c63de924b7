#ifndef GSLAM_VOCABULARY_TRAINING_OPTIONS_H
#define GSLAM_VOCABULARY_TRAINING_OPTIONS_H

#include <gslam/base/parallel.h>
#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/weighting.h>

#include <cstddef>
#include <cstdint>
#include <functional>

/// @file
/// What trainVocabulary() is asked for, and what it tells.

namespace gslam {
inline namespace v1 {

/// What is to be trained, and how.
struct TrainingOptions {
  std::uint32_t branching = 10;             ///< K: most children of a node, 2 to 64
  std::uint32_t depth = 5;                  ///< L: levels below the root, 1 to 64
  Weighting weighting = Weighting::tf_idf;  ///< how much a word counts
  Scoring scoring = Scoring::l1;            ///< how bags are compared

  /// How the vocabulary keeps floats: float32, float16 or int8, whose steps share the range of all
  /// numbers evenly. Binary descriptors stay what they are, whatever this is.
  DescriptorType storage = DescriptorType::float32;

  std::uint64_t seed = 0;  ///< another one gives another tree
  /// Most times that the descriptors of a node are assigned to its children anew, 1 or more
  std::uint32_t most_iterations = 100;

  /// Bytes for the descriptors that are in memory at once, with what is noted of each: 17 more than
  /// a row, also of bits. Only for images from a source. All of it is asked for at once
  /// (std::bad_alloc where that is not to be had), but not touched before it is needed.
  std::size_t memory = std::size_t(1) << 30;

  /// Threads. They do not change the tree, and its grain does not matter.
  ParallelOptions parallel;

  /// Called now and then with the part of the work that is done, from 0 to 1: with each image that
  /// is read, after each node that brings it to another hundredth, and with each seed and iteration
  /// of a large node. It may be called by any of the threads, but by one at a time. When it returns
  /// false, the training ends soon after, with an empty vocabulary. What it throws comes out of
  /// trainVocabulary().
  std::function<bool(double)> progress;
};

/// What happened in a training.
struct TrainingReport {
  bool is_cancelled = false;           ///< whether the progress callback ended it
  std::uint64_t images = 0;            ///< of the set, with those without descriptors
  std::uint64_t descriptors = 0;       ///< of the set
  std::uint32_t passes = 0;            ///< of the source; 1 from memory
  std::uint64_t iterations = 0;        ///< of all nodes together
  std::uint64_t unfinished_nodes = 0;  ///< whose children still changed after the most iterations
  std::uint64_t moved_centres = 0;     ///< children without descriptors that were given some
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_TRAINING_OPTIONS_H
