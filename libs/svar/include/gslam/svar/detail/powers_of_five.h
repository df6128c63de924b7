// What reading and printing doubles share: the parts of a double, wide products, powers of five.
#ifndef GSLAM_SVAR_DETAIL_POWERS_OF_FIVE_H
#define GSLAM_SVAR_DETAIL_POWERS_OF_FIVE_H

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace detail {

/// high * 2^64 + low
struct Uint128 {
  std::uint64_t high;
  std::uint64_t low;
};

/// The product of two words, by halves of words; for compilers without wider integers.
inline Uint128 multiplyByHalves(std::uint64_t a, std::uint64_t b) noexcept {
  const std::uint64_t half = 0xFFFFFFFFu;
  const std::uint64_t low = (a & half) * (b & half);
  const std::uint64_t middle = (a >> 32) * (b & half) + (low >> 32);
  const std::uint64_t other = (a & half) * (b >> 32) + (middle & half);
  return {(a >> 32) * (b >> 32) + (middle >> 32) + (other >> 32), (other << 32) | (low & half)};
}

/// The product of two words.
inline Uint128 multiplyWide(std::uint64_t a, std::uint64_t b) noexcept {
#ifdef __SIZEOF_INT128__
  __extension__ typedef unsigned __int128 Wide;
  const Wide product = static_cast<Wide>(a) * b;
  return {static_cast<std::uint64_t>(product >> 64), static_cast<std::uint64_t>(product)};
#else
  return multiplyByHalves(a, b);
#endif
}

/// How many bits stand before the first that is set; there must be one.
inline int leadingZeros(std::uint64_t word) noexcept {
#ifdef __GNUC__
  return __builtin_clzll(word);
#else
  int count = 0;
  for (; (word >> 63) == 0; word <<= 1) ++count;
  return count;
#endif
}

/// How many bits stand behind the last that is set; there must be one.
inline int trailingZeros(std::uint64_t word) noexcept {
#ifdef __GNUC__
  return __builtin_ctzll(word);
#else
  return 63 - leadingZeros(word & (~word + 1));
#endif
}

inline Uint128 plusOne(Uint128 number) noexcept {
  const std::uint64_t low = number.low + 1;
  return {number.high + (low == 0 ? 1 : 0), low};
}

inline std::uint64_t bitsOf(double value) noexcept {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

inline double doubleOf(std::uint64_t bits) noexcept {
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

constexpr std::uint64_t kInfinityBits = std::uint64_t(0x7FF) << 52;

/// A double, finite and not negative, as significand * 2^exponent.
struct BinaryParts {
  explicit BinaryParts(std::uint64_t bits) noexcept
      : significand(bits & ((std::uint64_t(1) << 52) - 1)), exponent(-1074) {
    const int biased = static_cast<int>(bits >> 52);
    if (biased == 0) return;
    significand |= std::uint64_t(1) << 52;
    exponent = biased - 1075;
  }

  std::uint64_t significand;
  int exponent;
};

/// 10^n, for n <= 19.
inline std::uint64_t tenToThe(std::size_t n) noexcept {
  static constexpr std::uint64_t kPowers[] = {1u,
                                              10u,
                                              100u,
                                              1000u,
                                              10000u,
                                              100000u,
                                              1000000u,
                                              10000000u,
                                              100000000u,
                                              1000000000u,
                                              10000000000u,
                                              100000000000u,
                                              1000000000000u,
                                              10000000000000u,
                                              100000000000000u,
                                              1000000000000000u,
                                              10000000000000000u,
                                              100000000000000000u,
                                              1000000000000000000u,
                                              10000000000000000000u};
  return kPowers[n];
}

/// floor(log2(10^n)) for |n| <= 400. Division rounds down whatever the sign: what is divided is
/// moved to where it is positive.
inline int floorLog2OfTenToThe(int n) noexcept {
  const int far = 2000;
  return static_cast<int>(static_cast<unsigned>(n * 217706 + far * 65536) >> 16) - far;
}

/// A number from digits * 2^(exponent - 63) on, less than 2^(exponent - 63) above; the highest bit
/// of the digits is set.
struct RoughPower {
  std::uint64_t digits;
  std::int64_t exponent;
};

/// 10^-n for n <= 19: PowersOfFive::table()[-n].high at hand.
inline RoughPower tenToTheMinus(std::size_t n) noexcept {
  static constexpr RoughPower kPowers[] = {
      {0x8000000000000000, 0},   {0xCCCCCCCCCCCCCCCC, -4},  {0xA3D70A3D70A3D70A, -7},
      {0x83126E978D4FDF3B, -10}, {0xD1B71758E219652B, -14}, {0xA7C5AC471B478423, -17},
      {0x8637BD05AF6C69B5, -20}, {0xD6BF94D5E57A42BC, -24}, {0xABCC77118461CEFC, -27},
      {0x89705F4136B4A597, -30}, {0xDBE6FECEBDEDD5BE, -34}, {0xAFEBFF0BCB24AAFE, -37},
      {0x8CBCCC096F5088CB, -40}, {0xE12E13424BB40E13, -44}, {0xB424DC35095CD80F, -47},
      {0x901D7CF73AB0ACD9, -50}, {0xE69594BEC44DE15B, -54}, {0xB877AA3236A4B449, -57},
      {0x9392EE8E921D5D07, -60}, {0xEC1E4A7DB69561A5, -64}};
  return kPowers[n];
}

/// The first 128 bits of 5^n, hence of 10^n, the highest of which is set:
/// 10^n = table[n] * 2^(floorLog2OfTenToThe(n) - 127).
///
/// Exact from 0 to 55, rounded up from -27 to -1 and down elsewhere, as Eisel-Lemire wants it
/// (see parse_number.h). Computed at the first use, in some 20 us: the compiler would have to read
/// 1334 literals in every file that includes this. Safe to share.
class PowersOfFive {
 public:
  static constexpr int kMin = -342;
  static constexpr int kMax = 324;

  static const PowersOfFive& table() noexcept {
    static const PowersOfFive powers;
    return powers;
  }

  Uint128 operator[](int n) const noexcept { return powers_[n - kMin]; }

  /// The least number of 128 bits that is not below.
  Uint128 roundedUp(int n) const noexcept {
    return n >= -27 && n <= 55 ? (*this)[n] : plusOne((*this)[n]);
  }

 private:
  static constexpr int kWords = 16;  // the lowest first

  PowersOfFive() noexcept {
    std::uint64_t power[kWords] = {0, 0, 1};  // 2^128 * 5^n, exactly
    for (int n = 0; n <= kMax; ++n) {
      powers_[n - kMin] = highest(power);
      timesFive(power);
    }
    // floor(2^960 / 5^n): rounding down many times is the same as doing so once. At the end there
    // are still 165 bits.
    std::uint64_t reciprocal[kWords] = {};
    reciprocal[kWords - 1] = 1;
    for (int n = -1; n >= kMin; --n) {
      overFive(reciprocal);
      powers_[n - kMin] = n >= -27 ? plusOne(highest(reciprocal)) : highest(reciprocal);
    }
  }

  // The 128 bits from the first that is set.
  static Uint128 highest(const std::uint64_t* words) noexcept {
    int i = kWords - 1;
    while (words[i] == 0) --i;
    const int shift = leadingZeros(words[i]);
    if (shift == 0) return {words[i], words[i - 1]};
    return {(words[i] << shift) | (words[i - 1] >> (64 - shift)),
            (words[i - 1] << shift) | (words[i - 2] >> (64 - shift))};
  }

  static void timesFive(std::uint64_t* words) noexcept {
    std::uint64_t carry = 0;
    for (int i = 0; i < kWords; ++i) {
      const Uint128 product = multiplyWide(words[i], 5);
      words[i] = product.low + carry;
      carry = product.high + (words[i] < carry ? 1 : 0);
    }
  }

  static void overFive(std::uint64_t* words) noexcept {
    const std::uint64_t fifth_of_word = 0x3333333333333333u;  // 2^64 = 5 * fifth_of_word + 1
    std::uint64_t rest = 0;
    for (int i = kWords; i-- > 0;) {
      const std::uint64_t sum = words[i] % 5 + rest;
      words[i] = words[i] / 5 + rest * fifth_of_word + sum / 5;
      rest = sum % 5;
    }
  }

  Uint128 powers_[kMax - kMin + 1];
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_POWERS_OF_FIVE_H
