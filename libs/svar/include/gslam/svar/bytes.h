#ifndef GSLAM_SVAR_BYTES_H
#define GSLAM_SVAR_BYTES_H

#include <cstddef>
#include <cstdint>
#include <cstring>

/// @file
/// Hashing and comparing bytes. Hashes differ between machines of different byte order.

namespace gslam {
inline namespace v1 {
namespace detail {

/// Each bit of either changes about half of the result's bits (the finalizer of SplitMix64;
/// Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators, OOPSLA 2014).
inline std::uint64_t mixWords(std::uint64_t a, std::uint64_t b) noexcept {
  std::uint64_t x = a + 0x9E3779B97F4A7C15u * (b + 1);
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
  x = (x ^ x >> 27) * 0x94D049BB133111EBu;
  return x ^ x >> 31;
}

template <class Word>
Word loadWord(const char* p) noexcept {
  Word word;
  std::memcpy(&word, p, sizeof(word));
  return word;
}

/// The first and last bytes of up to 8, which overlap where there are fewer.
inline std::uint64_t shortWord(const char* p, std::size_t size) noexcept {
  if (size == 8) return loadWord<std::uint64_t>(p);
  if (size >= 4) {
    return static_cast<std::uint64_t>(loadWord<std::uint32_t>(p)) << 32 |
           loadWord<std::uint32_t>(p + size - 4);
  }
  if (size == 0) return 0;
  const auto byte = [p](std::size_t i) { return std::uint64_t(static_cast<unsigned char>(p[i])); };
  return byte(0) << 16 | byte(size / 2) << 8 | byte(size - 1);
}

inline std::uint64_t hashBytes(const char* p, std::size_t size, std::uint64_t seed) noexcept {
  std::uint64_t hash = seed ^ size * 0xBF58476D1CE4E5B9u;  // mixWords() multiplies by another
  std::size_t left = size;
  for (; left > 8; p += 8, left -= 8) {
    hash = mixWords(hash, loadWord<std::uint64_t>(p));
  }
  return mixWords(hash, shortWord(p, left));
}

/// Whether as many bytes are the same at both places. Names differ mostly at their end.
inline bool sameBytes(const char* a, const char* b, std::size_t size) noexcept {
  if (size <= 8) return shortWord(a, size) == shortWord(b, size);
  const std::size_t last = size - 8;
  if (loadWord<std::uint64_t>(a + last) != loadWord<std::uint64_t>(b + last)) return false;
  for (std::size_t i = 0; i < last; i += 8) {
    if (loadWord<std::uint64_t>(a + i) != loadWord<std::uint64_t>(b + i)) return false;
  }
  return true;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_BYTES_H
