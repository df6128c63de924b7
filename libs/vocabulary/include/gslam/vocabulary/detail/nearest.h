// For each of many descriptors the nearest of a few: the one kernel of training and transform.
#ifndef GSLAM_VOCABULARY_DETAIL_NEAREST_H
#define GSLAM_VOCABULARY_DETAIL_NEAREST_H

#include <gslam/base/simd.h>
#include <gslam/vocabulary/detail/hamming.h>
#include <gslam/vocabulary/detail/l2.h>
#include <gslam/vocabulary/detail/tree_view.h>
#include <gslam/vocabulary/detail/visit.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

inline SimdKernel<ChooseFunction> chooseKernel(const DescriptorFormat& format) {
  return format.type == DescriptorType::binary ? binaryKernel() : floatKernel();
}

// For each of `count` rows the nearest of `centre_count` rows, 1 to 64; of equally near ones the
// first. The format is binary or float32, and all lie strideOf(format) bytes apart, with zeros
// behind binary ones. Distances are bits, or squares of L2; may be null.
inline void nearestRows(const DescriptorFormat& format, const std::uint8_t* rows, std::size_t count,
                        const std::uint8_t* centres, std::uint32_t centre_count,
                        std::uint32_t* nearest, float* distances) {
  constexpr std::size_t kPiece = 128;
  const ChooseFunction choose = chooseKernel(format).active();
  const std::size_t stride = strideOf(format);
  Visit visits[kPiece];
  Choice choices[kPiece];
  for (std::size_t begin = 0; begin < count; begin += kPiece) {
    const std::size_t size = std::min(kPiece, count - begin);
    for (std::size_t i = 0; i < size; ++i) {
      visits[i] = Visit{rows + (begin + i) * stride, centres, centre_count, 0};
    }
    choose(format, stride, visits, size, choices);
    for (std::size_t i = 0; i < size; ++i) {
      nearest[begin + i] = choices[i].index;
      if (distances != nullptr) distances[begin + i] = choices[i].distance;
    }
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_NEAREST_H
