#ifndef GSLAM_VOCABULARY_TRAIN_H
#define GSLAM_VOCABULARY_TRAIN_H

#include <gslam/base/span.h>
#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/memory_training.h>
#include <gslam/vocabulary/detail/stream_training.h>
#include <gslam/vocabulary/image_source.h>
#include <gslam/vocabulary/training_options.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstddef>

/// @file
/// Makes vocabularies from the descriptors of many images.

namespace gslam {
inline namespace v1 {

/// Trains a vocabulary by hierarchical k-means: the descriptors are split into K clusters, each of
/// these again, and so on, L times.
///
/// Seeds by k-means++ (D. Arthur, S. Vassilvitskii, "k-means++: The Advantages of Careful Seeding",
/// SODA 2007), then Lloyd's iterations until nothing changes. The centre of binary descriptors is
/// the majority of each bit, set when half of them have it; that of floats is the mean. Of equally
/// near centres the first counts, as in transform(). A child that is left without descriptors is
/// moved to the one that is farthest from its centre. Equal descriptors never part: where there are
/// no more than K different ones, each is a leaf; a node whose descriptors are all equal is one,
/// too. So no two children are equal, and each word has been seen. Floats that differ by less than
/// 1e-18 may count as equal: their squares are no floats. Weights are those of reweighted() on the
/// same images.
///
/// The result depends on the descriptors, their order, the options and the seed; not on the number
/// of threads. Of binary descriptors it is the same with every SIMD variant. Of floats it may
/// differ where a distance is rounded in another way.
///
/// Descriptors are copied, and not changed. In memory there are then, of each, its bytes, rounded
/// up to 8 for bits and to 16 for floats, and 9 more, for floats 17. From a source there may be
/// more of them than fit. Then nodes with more descriptors than fit are split by a sample of as
/// many as do: the root by a random one, others by an even part of theirs, in their order. What is
/// below them is trained on all of its descriptors, as many nodes in a pass as fit. That takes 3
/// passes over the images and one or two for each time that the descriptors fill options.memory.
/// Where all fit it is the same as from memory, in 2 passes. Of a node with more equal descriptors
/// than fit others may stay unseen, and become no words of their own.
///
/// @param images       the descriptors of each; some images may have none
/// @param options      what to make
/// @param report       unless null, is told what happened
/// @return the vocabulary; an empty one when the progress callback ended the training
/// @throws ArgumentError when an option is outside its range, there are no descriptors or too many,
///         an image has descriptors of another kind or size than the first, or a number that is not
///         finite or over 1e15 (65504 for float16): it names the image and the descriptor
///
/// Thread-safety: images are only read. Threads work for it, see options.parallel.
inline Vocabulary trainVocabulary(Span<const Descriptors> images,
                                  const TrainingOptions& options = TrainingOptions(),
                                  TrainingReport* report = nullptr) {
  TrainingReport unread;
  detail::Training training(options, report != nullptr ? *report : unread);
  return detail::trainFromMemory(images, training);
}
/// The same from a source, of more descriptors than fit the memory: see above.
/// @param image_count  how many images the source has
/// @param image        gives them; some may have no descriptors
/// @param options      what to make
/// @param report       unless null, is told what happened
/// @return the vocabulary; an empty one when the progress callback ended the training
/// @throws ArgumentError as above
inline Vocabulary trainVocabulary(std::size_t image_count, const ImageSource& image,
                                  const TrainingOptions& options = TrainingOptions(),
                                  TrainingReport* report = nullptr) {
  TrainingReport unread;
  detail::Training training(options, report != nullptr ? *report : unread);
  return detail::StreamTraining(image_count, image, training).run();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_TRAIN_H
