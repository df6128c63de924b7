// SHA-256, FIPS 180-4. The conformance files are there as their SHA-256, see mcap_conformance_test.
#ifndef GSLAM_DATASETS_ROS_TESTS_SHA256_H
#define GSLAM_DATASETS_ROS_TESTS_SHA256_H

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class Sha256 {
 public:
  static std::string of(std::vector<std::uint8_t> bytes) {
    const std::uint64_t bits = bytes.size() * 8;
    bytes.push_back(0x80);
    while (bytes.size() % 64 != 56) bytes.push_back(0);
    for (int shift = 56; shift >= 0; shift -= 8) bytes.push_back(std::uint8_t(bits >> shift));
    Sha256 sha;
    for (std::size_t i = 0; i < bytes.size(); i += 64) sha.add(bytes.data() + i);
    std::string text;
    for (const std::uint32_t word : sha.state_) {
      for (int shift = 28; shift >= 0; shift -= 4) text += "0123456789abcdef"[word >> shift & 15U];
    }
    return text;
  }

 private:
  // The first bits of the fractional parts of roots of the first primes.
  Sha256() {
    std::size_t found = 0;
    for (unsigned n = 2; found < 64; ++n) {
      bool is_prime = true;
      for (unsigned d = 2; d * d <= n; ++d) is_prime = is_prime && n % d != 0;
      if (!is_prime) continue;
      if (found < 8) state_[found] = fraction(std::sqrt(static_cast<long double>(n)));
      k_[found++] = fraction(std::cbrt(static_cast<long double>(n)));
    }
  }
  static std::uint32_t fraction(long double x) {
    return static_cast<std::uint32_t>((x - std::floor(x)) * 4294967296.0L);
  }
  static std::uint32_t turned(std::uint32_t x, unsigned n) { return x >> n | x << (32 - n); }

  void add(const std::uint8_t* block) {
    std::array<std::uint32_t, 64> w{};
    for (std::size_t i = 0; i < 64; ++i) {
      if (i < 16) {
        for (std::size_t j = 0; j < 4; ++j) w[i] = w[i] << 8 | block[4 * i + j];
        continue;
      }
      const std::uint32_t a = w[i - 15], b = w[i - 2];
      w[i] = w[i - 16] + (turned(a, 7) ^ turned(a, 18) ^ a >> 3) + w[i - 7] +
             (turned(b, 17) ^ turned(b, 19) ^ b >> 10);
    }
    std::array<std::uint32_t, 8> s = state_;
    for (std::size_t i = 0; i < 64; ++i) {
      const std::uint32_t sum = turned(s[4], 6) ^ turned(s[4], 11) ^ turned(s[4], 25);
      const std::uint32_t t1 = s[7] + sum + ((s[4] & s[5]) ^ (~s[4] & s[6])) + k_[i] + w[i];
      const std::uint32_t other = turned(s[0], 2) ^ turned(s[0], 13) ^ turned(s[0], 22);
      const std::uint32_t t2 = other + ((s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]));
      s = {t1 + t2, s[0], s[1], s[2], s[3] + t1, s[4], s[5], s[6]};
    }
    for (std::size_t i = 0; i < 8; ++i) state_[i] += s[i];
  }

  std::array<std::uint32_t, 8> state_{};
  std::array<std::uint32_t, 64> k_{};
};

#endif  // GSLAM_DATASETS_ROS_TESTS_SHA256_H
