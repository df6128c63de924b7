#ifndef GSLAM_CORE_DETAIL_ALIGNED_MEMORY_H
#define GSLAM_CORE_DETAIL_ALIGNED_MEMORY_H

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr std::size_t kMemoryAlignment = 64;  // a cache line, and a register of AVX-512

// The first address in a block of `size + kMemoryAlignment` bytes that is aligned.
inline void* alignedIn(void* block) noexcept {
  const std::uintptr_t address = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t gap = (kMemoryAlignment - address % kMemoryAlignment) % kMemoryAlignment;
  return static_cast<unsigned char*>(block) + gap;
}

inline std::shared_ptr<void> ownedBlock(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  // If no memory is left for the count, the pointer's constructor frees the block.
  const std::shared_ptr<void> owner(block, &std::free);
  return std::shared_ptr<void>(owner, alignedIn(block));
}

// `size` bytes that are not initialised.
inline std::shared_ptr<void> alignedMemory(std::size_t size) {
  return ownedBlock(std::malloc(size + kMemoryAlignment));  // NOLINT(*-no-malloc)
}

// `size` bytes that are zero, which large ones are before anybody touches them.
inline std::shared_ptr<void> alignedZeros(std::size_t size) {
  return ownedBlock(std::calloc(size + kMemoryAlignment, 1));  // NOLINT(*-no-malloc)
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_ALIGNED_MEMORY_H
