// Sums of products of floats, to the last bit.
#ifndef GSLAM_VOCABULARY_DETAIL_EXACT_SUM_H
#define GSLAM_VOCABULARY_DETAIL_EXACT_SUM_H

#include <gslam/vocabulary/detail/half.h>

#include <cstddef>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

// In integers, so that neither compilers nor modes of the processor change anything. Up to 2^29
// products of finite floats.
// Source: U. Kulisch, "Computer Arithmetic and Validity", 2008: the long accumulator.
class ExactSum {
 public:
  // a b times a factor of -2, -1, 1 or 2.
  void addProduct(float a, float b, int factor = 1) noexcept {
    const std::uint32_t x = bitsOfFloat(a);
    const std::uint32_t y = bitsOfFloat(b);
    // The product is that of two integers of 24 bits, times 2^(place - 298).
    const std::uint64_t product = significandOf(x) * significandOf(y);
    const std::uint32_t place = placeOf(x) + placeOf(y) + (factor == 2 || factor == -2 ? 1 : 0);
    const bool is_negative = (((x ^ y) >> 31) != 0) != (factor < 0);
    std::int64_t* const digits = digits_ + place / 32;
    const std::uint32_t shift = place % 32;
    const std::uint64_t low = (product & 0xFFFFFFFFu) << shift;
    const std::uint64_t high = (product >> 32) << shift;
    add(digits[0], low & 0xFFFFFFFFu, is_negative);
    add(digits[1], (low >> 32) + (high & 0xFFFFFFFFu), is_negative);
    add(digits[2], high >> 32, is_negative);
  }

  bool isNegative() const noexcept {
    std::int64_t carry = 0;  // rounded down, so that it has the sign when all is in it
    for (const std::int64_t digit : digits_) {
      const std::int64_t sum = digit + carry;
      carry = sum >= 0 ? sum / kBase : -((-sum + kBase - 1) / kBase);
    }
    return carry < 0;
  }

 private:
  static constexpr std::int64_t kBase = std::int64_t(1) << 32;
  // Of a product the last bit is at 2 * 253 + 1 at most, and two digits follow its first.
  static constexpr std::size_t kDigits = 507 / 32 + 3;

  static std::uint64_t significandOf(std::uint32_t bits) noexcept {
    return (bits & 0x7FFFFFu) | ((bits & 0x7F800000u) != 0 ? 0x800000u : 0u);
  }
  static std::uint32_t placeOf(std::uint32_t bits) noexcept {
    const std::uint32_t exponent = (bits >> 23) & 0xFFu;
    return exponent == 0 ? 0 : exponent - 1;
  }
  static void add(std::int64_t& digit, std::uint64_t value, bool is_negative) noexcept {
    const auto amount = static_cast<std::int64_t>(value);
    digit += is_negative ? -amount : amount;
  }

  std::int64_t digits_[kDigits] = {};  // of 32 bits, the lowest first, not carried yet
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_EXACT_SUM_H
