// The text of a string value: one allocation for characters and reference count.
#ifndef GSLAM_SVAR_DETAIL_SHARED_TEXT_H
#define GSLAM_SVAR_DETAIL_SHARED_TEXT_H

#include <gslam/svar/text.h>

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Puts what a shared_ptr keeps beside its object at the front of a block from operator new, of
/// which the object is the rest, and frees the block with it. (C++20 has
/// make_shared<char[]>(size) for this.)
template <class T>
class FrontAllocator {
 public:
  using value_type = T;
  static constexpr std::size_t kFrontSize = 48;  // libstdc++ and libc++ need 32 to 40

  explicit FrontAllocator(void* block) noexcept : block_(block) {}
  template <class U>
  FrontAllocator(const FrontAllocator<U>& other) noexcept  // NOLINT(google-explicit-constructor)
      : block_(other.block()) {}

  void* block() const noexcept { return block_; }

  T* allocate(std::size_t count) {
    const std::size_t size = count * sizeof(T);
    return static_cast<T*>(size <= kFrontSize ? block_ : ::operator new(size));
  }
  void deallocate(T* front, std::size_t) noexcept {
    if (front != block_) ::operator delete(front);
    ::operator delete(block_);
  }

  friend bool operator==(FrontAllocator a, FrontAllocator b) noexcept {
    return a.block_ == b.block_;
  }
  friend bool operator!=(FrontAllocator a, FrontAllocator b) noexcept { return !(a == b); }

 private:
  void* block_;
};

/// A copy of the characters, without a zero byte at the end.
inline std::shared_ptr<void> makeSharedText(Text text) {
  struct FreedWithItsFront {
    void operator()(void*) const noexcept {}
  };
  const std::size_t front_size = FrontAllocator<char>::kFrontSize;
  char* const block = static_cast<char*>(::operator new(front_size + text.size()));
  if (!text.empty()) std::memcpy(block + front_size, text.data(), text.size());
  return std::shared_ptr<void>(static_cast<void*>(block + front_size), FreedWithItsFront(),
                               FrontAllocator<char>(block));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_SHARED_TEXT_H
