// What training from memory and from a source share.
#ifndef GSLAM_VOCABULARY_DETAIL_TRAINING_H
#define GSLAM_VOCABULARY_DETAIL_TRAINING_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/grow_tree.h>
#include <gslam/vocabulary/detail/training_progress.h>
#include <gslam/vocabulary/detail/training_rows.h>
#include <gslam/vocabulary/detail/word_counts.h>
#include <gslam/vocabulary/training_options.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

inline void checkOptions(const TrainingOptions& options) {
  const auto refuse = [](const char* what, std::uint64_t value, const char* expected) {
    throw ArgumentError(what, "is " + std::to_string(value) + ", expected " + expected);
  };
  if (options.branching < 2 || options.branching > kMostChildren) {
    refuse("options.branching", options.branching, "2 to 64");
  }
  if (options.depth < 1 || options.depth > kMostDepth) {
    refuse("options.depth", options.depth, "1 to 64");
  }
  if (options.most_iterations < 1) refuse("options.most_iterations", 0, "1 or more");
  if (options.weighting > Weighting::binary) {
    refuse("options.weighting", static_cast<std::uint64_t>(options.weighting), "0 to 3");
  }
  if (options.scoring > Scoring::dot) {
    refuse("options.scoring", static_cast<std::uint64_t>(options.scoring), "0 to 5");
  }
}

// Bits stay what they are.
inline void checkStorage(DescriptorType storage, const DescriptorFormat& rows) {
  if (rows.type == DescriptorType::binary || storage == DescriptorType::float32 ||
      storage == DescriptorType::float16 || storage == DescriptorType::int8) {
    return;
  }
  throw ArgumentError("options.storage", std::string("is ") + descriptorTypeName(storage) +
                                             ", expected float32, float16 or int8 for floats");
}

// Each descriptor may be a node in each level.
inline void checkCount(std::uint64_t descriptors, std::uint32_t depth) {
  if (descriptors == 0) throw ArgumentError("images", "have no descriptors");
  if (descriptors < kNone / depth) return;
  throw ArgumentError("images", "have " + std::to_string(descriptors) +
                                    " descriptors, expected less than " +
                                    std::to_string(kNone / depth) + " for so many levels");
}

inline void checkDescriptorSize(const Descriptors& image, std::size_t number) {
  if (image.size >= 1 && image.size <= kMostDescriptorSize) return;
  throw ArgumentError(
      imageName(number),
      "has descriptors of " + kindOf(image.is_binary, image.size) + ", expected 1 to 4096");
}

// One use: the tree that grows, and what becomes of it.
struct Training {
  Training(const TrainingOptions& wanted, TrainingReport& told)
      : options(wanted), report(told), progress(wanted.progress) {
    report = TrainingReport();
    checkOptions(options);
  }

  // Of rows of this format.
  void setFormat(const DescriptorFormat& format, const FloatRange& range) {
    settings.format = format;
    settings.storage = storageFormat(format, options.storage, range);
    settings.clusters = options.branching;
    settings.most_iterations = options.most_iterations;
  }

  GrowingNode root(std::size_t rows) const {
    GrowingNode root;
    root.levels = options.depth;
    root.seed = options.seed;
    root.count = rows;
    return root;
  }

  void grow(std::uint8_t* rows, const std::vector<GrowingNode>& growing) {
    growTree(settings, rows, growing, options.parallel, progress, tree, counts);
  }

  // `count_images(counts)` gives all images to a WordCounts. Empty when the training was cancelled.
  template <class CountImages>
  Vocabulary finish(const CountImages& count_images) {
    report.iterations = counts.iterations;
    report.unfinished_nodes = counts.unconverged;
    report.moved_centres = counts.reseeded;
    if (!progress.isCancelled()) progress.ask();
    Vocabulary vocabulary;
    if (!progress.isCancelled()) vocabulary = build(count_images);
    report.is_cancelled = progress.isCancelled();
    return report.is_cancelled ? Vocabulary() : vocabulary;
  }

  const TrainingOptions& options;
  TrainingReport& report;
  TrainingProgress progress;
  SplitSettings settings;
  GrownTree tree;
  SplitCounts counts;

 private:
  template <class CountImages>
  Vocabulary build(const CountImages& count_images) {
    TreeData data = treeDataOf(tree, breadthFirst(tree), settings, options.depth);
    data.weighting = options.weighting;
    data.scoring = options.scoring;
    tree = GrownTree();
    Vocabulary unweighted = buildVocabulary(data, "training");
    if (!needsFrequency(options.weighting)) return unweighted;
    WordCounts word_counts(unweighted);
    count_images(word_counts);
    setWeights(word_counts, data);
    return buildVocabulary(data, "training");
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_TRAINING_H
