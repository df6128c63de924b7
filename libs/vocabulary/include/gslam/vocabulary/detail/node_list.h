// Checks that readers of lists of nodes share, for errors that name the place.
#ifndef GSLAM_VOCABULARY_DETAIL_NODE_LIST_H
#define GSLAM_VOCABULARY_DETAIL_NODE_LIST_H

#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/detail/tree_view.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Types of OpenCV, which all these files have: CV_8UC1 and CV_32FC1.
constexpr std::uint32_t kOpenCvBytes = 0;
constexpr std::uint32_t kOpenCvFloats = 5;

inline bool isOpenCvType(std::uint32_t type) noexcept {
  return type == kOpenCvBytes || type == kOpenCvFloats;
}
inline std::string strangeType(std::uint32_t type) {
  return "is of type " + std::to_string(type) +
         ", expected bytes, which are 0, or floats, which are 5";
}

// The index in the list of each id, from 0 (kNone: the root) to the last.
// @param fail  gets the index of a wrong node and what is wrong; throws
template <class Fail>
std::vector<std::uint32_t> indexOfIds(const TreeData& data, const Fail& fail) {
  const std::size_t count = data.ids.size();
  const std::string range = "expected 1 to " + std::to_string(count) + ", as there are nodes";
  std::vector<std::uint32_t> index_of(count + 1, kNone);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t id = data.ids[i];
    if (id == 0 || id > count) fail(i, "has the id " + std::to_string(id) + ", " + range);
    if (index_of[id] != kNone) {
      fail(i, "has the id " + std::to_string(id) + ", which another has, too");
    }
    if (data.parents[i] > count || data.parents[i] == id) {
      fail(i, "has the id " + std::to_string(id) + " and the parent " +
                  std::to_string(data.parents[i]) + ", which cannot be");
    }
    index_of[id] = static_cast<std::uint32_t>(i);
  }
  return index_of;
}

// Weights of inner nodes do not count, whatever they are: files have what was in the memory.
inline void dropInnerWeights(TreeData& data) {
  for (std::size_t i = 0; i < data.words.size(); ++i) {
    if (data.words[i] == kNone) data.weights[i] = 0;
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_NODE_LIST_H
