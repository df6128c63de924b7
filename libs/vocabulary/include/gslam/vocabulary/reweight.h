#ifndef GSLAM_VOCABULARY_REWEIGHT_H
#define GSLAM_VOCABULARY_REWEIGHT_H

#include <gslam/base/error.h>
#include <gslam/base/parallel.h>
#include <gslam/base/span.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/word_counts.h>
#include <gslam/vocabulary/image_source.h>
#include <gslam/vocabulary/vocabulary.h>

#include <algorithm>
#include <cstddef>

/// @file
/// How much words count, from other images than those of the training.

namespace gslam {
inline namespace v1 {

namespace detail {

inline void requireWords(const Vocabulary& vocabulary) {
  if (vocabulary.empty()) throw ArgumentError("vocabulary", "is empty");
}

inline Vocabulary withWeights(const Vocabulary& vocabulary, const WordCounts& counts) {
  TreeData data = treeDataOf(vocabulary);
  if (needsFrequency(vocabulary.weighting())) {
    setWeights(counts, data);
  } else {
    std::fill(data.weights.begin(), data.weights.end(), 1.0);
  }
  return buildVocabulary(data, "reweighted vocabulary");
}

}  // namespace detail

/// The same tree with the weights of other images: for tf-idf and idf log(N / n) of a word that is
/// in n of N images (natural; those without descriptors count, too) and 0 of a word that is in
/// none, for the others 1. All as in DBoW2. A word in all images has the weight 0 by this, as it
/// tells nothing: so have all words after a single image.
/// @param vocabulary   whose words; not changed
/// @param images       the descriptors of each
/// @param parallel     threads; its grain does not matter, nor does their number for the result
/// @throws ArgumentError when the vocabulary is empty, or there are no images, or an image has
///         descriptors of another kind or size, or a number that is not finite or over 1e15: it
///         names the image
inline Vocabulary reweighted(const Vocabulary& vocabulary, Span<const Descriptors> images,
                             const ParallelOptions& parallel = ParallelOptions()) {
  detail::requireWords(vocabulary);
  if (images.empty()) throw ArgumentError("images", "are none");
  detail::WordCounts counts(vocabulary);
  detail::countWords(
      images, parallel, [] { return true; }, counts);
  return detail::withWeights(vocabulary, counts);
}
/// The same from a source, one image after the other.
/// @param vocabulary   whose words; not changed
/// @param image_count  how many images the source has
/// @param image        gives them, once each
/// @throws ArgumentError as above
inline Vocabulary reweighted(const Vocabulary& vocabulary, std::size_t image_count,
                             const ImageSource& image) {
  detail::requireWords(vocabulary);
  if (image_count == 0) throw ArgumentError("images", "are none");
  detail::WordCounts counts(vocabulary);
  for (std::size_t i = 0; i < image_count; ++i) counts.add(image(i), i);
  return detail::withWeights(vocabulary, counts);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_REWEIGHT_H
