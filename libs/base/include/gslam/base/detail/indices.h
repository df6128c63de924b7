// 0, 1, 2... as template arguments: std::index_sequence, which C++11 lacks.
#ifndef GSLAM_BASE_DETAIL_INDICES_H
#define GSLAM_BASE_DETAIL_INDICES_H

#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

template <std::size_t... I>
struct Indices {};
template <std::size_t count, std::size_t... I>
struct MakeIndices : MakeIndices<count - 1, count - 1, I...> {};
template <std::size_t... I>
struct MakeIndices<0, I...> {
  using Type = Indices<I...>;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_DETAIL_INDICES_H
