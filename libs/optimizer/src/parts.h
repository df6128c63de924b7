#ifndef GSLAM_OPTIMIZER_SRC_PARTS_H
#define GSLAM_OPTIMIZER_SRC_PARTS_H

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

// The connected parts of a graph.

namespace gslam {
inline namespace v1 {
namespace detail {

// Sets that are joined (Tarjan, JACM 22(2), 1975; path halving).
class Parts {
 public:
  explicit Parts(std::size_t count) : parent_(count), parts_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t(0));
  }

  // Lowest member of the part of i.
  std::uint32_t rootOf(std::uint32_t i) noexcept {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) noexcept {
    a = rootOf(a);
    b = rootOf(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    --parts_;
  }
  // How many there are.
  std::size_t count() const noexcept { return parts_; }

 private:
  std::vector<std::uint32_t> parent_;
  std::size_t parts_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_PARTS_H
