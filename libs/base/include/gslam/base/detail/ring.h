// A queue that allocates nothing once it has found its size.
#ifndef GSLAM_BASE_DETAIL_RING_H
#define GSLAM_BASE_DETAIL_RING_H

#include <cstddef>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

/// First in, first out, in one block of memory that grows and is kept.
template <class Item>
class Ring {
 public:
  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }

  void push(Item item) {
    if (size_ == items_.size()) grow();
    items_[(first_ + size_) & (items_.size() - 1)] = std::move(item);
    ++size_;
  }

  /// Must not be called on an empty one.
  Item pop() {
    Item item = std::move(items_[first_]);
    items_[first_] = Item();  // what it held ends now, not when its place is used again
    first_ = (first_ + 1) & (items_.size() - 1);
    --size_;
    return item;
  }

  void swap(Ring& other) noexcept {
    items_.swap(other.items_);
    std::swap(first_, other.first_);
    std::swap(size_, other.size_);
  }

 private:
  void grow() {
    std::vector<Item> larger(items_.empty() ? 4 : 2 * items_.size());
    for (std::size_t i = 0; i < size_; ++i) {
      larger[i] = std::move(items_[(first_ + i) & (items_.size() - 1)]);
    }
    items_.swap(larger);
    first_ = 0;
  }

  std::vector<Item> items_;  // a power of two of them
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_DETAIL_RING_H
