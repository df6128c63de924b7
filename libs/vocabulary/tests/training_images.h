// Descriptors of made images, for tests and benchmarks of the training.
#ifndef GSLAM_VOCABULARY_TESTS_TRAINING_IMAGES_H
#define GSLAM_VOCABULARY_TESTS_TRAINING_IMAGES_H

#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace training_images {

using gslam::Descriptors;

// Images with descriptors of one kind.
template <class Number>
struct Images {
  std::uint32_t size = 0;  // numbers of a descriptor
  std::vector<std::vector<Number>> rows;

  std::vector<Descriptors> views() const {
    std::vector<Descriptors> views;
    for (const std::vector<Number>& image : rows) views.push_back(view(image));
    return views;
  }
  Descriptors view(const std::vector<std::uint8_t>& image) const {
    return gslam::binaryDescriptors(image.data(), image.size() / size, size);
  }
  Descriptors view(const std::vector<float>& image) const {
    return gslam::floatDescriptors(image.data(), image.size() / size, size);
  }
};

// Bits as ORB has them: centres that are like other centres, of which an eighth of the bits flip.
inline Images<std::uint8_t> binaryImages(std::size_t images, std::size_t per_image,
                                         std::uint32_t size, std::size_t centre_count,
                                         std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> centres(centre_count * size);
  for (std::size_t i = 0; i < centre_count; ++i) {
    const std::size_t like = i < 30 ? i : random() % i;
    for (std::size_t b = 0; b < size; ++b) {
      const std::uint_fast32_t noise = i < 30 ? random() : random() & random();
      centres[i * size + b] = static_cast<std::uint8_t>(centres[like * size + b] ^ noise);
    }
  }
  Images<std::uint8_t> made;
  made.size = size;
  made.rows.resize(images);
  for (std::vector<std::uint8_t>& image : made.rows) {
    for (std::size_t i = 0; i < per_image; ++i) {
      const std::size_t centre = random() % centre_count;
      for (std::size_t b = 0; b < size; ++b) {
        const std::uint_fast32_t noise = random() & random() & random();
        image.push_back(static_cast<std::uint8_t>(centres[centre * size + b] ^ noise));
      }
    }
  }
  return made;
}

// Whole numbers as SIFT has them, around centres.
inline Images<float> floatImages(std::size_t images, std::size_t per_image, std::uint32_t size,
                                 std::size_t centre_count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<float> centres(centre_count * size);
  for (float& number : centres) number = static_cast<float>(random() % 200);
  Images<float> made;
  made.size = size;
  made.rows.resize(images);
  for (std::vector<float>& image : made.rows) {
    for (std::size_t i = 0; i < per_image; ++i) {
      const std::size_t centre = random() % centre_count;
      for (std::size_t b = 0; b < size; ++b) {
        image.push_back(centres[centre * size + b] + static_cast<float>(random() % 60));
      }
    }
  }
  return made;
}

// Whether both have the same nodes with the same descriptors and weights.
inline bool areSame(const gslam::Vocabulary& a, const gslam::Vocabulary& b) {
  const gslam::detail::TreeData x = gslam::detail::treeDataOf(a);
  const gslam::detail::TreeData y = gslam::detail::treeDataOf(b);
  return x.parents == y.parents && x.descriptors == y.descriptors && x.weights == y.weights &&
         x.words == y.words && x.ids == y.ids;
}

}  // namespace training_images

#endif  // GSLAM_VOCABULARY_TESTS_TRAINING_IMAGES_H
