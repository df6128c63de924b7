#ifndef GSLAM_OPTIMIZER_PBA_SRC_RAW_VECTOR_H
#define GSLAM_OPTIMIZER_PBA_SRC_RAW_VECTOR_H

#include <memory>
#include <new>
#include <utility>
#include <vector>

// Vectors whose new elements have no value: large ones are filled by many threads, which then also
// are the first to touch their pages.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

template <class T>
struct RawAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };
  RawAllocator() = default;
  template <class U>
  RawAllocator(const RawAllocator<U>&) noexcept {}

  template <class U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_RAW_VECTOR_H
