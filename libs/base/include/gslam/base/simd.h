#ifndef GSLAM_BASE_SIMD_H
#define GSLAM_BASE_SIMD_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

/// @file
/// SIMD variants: named, chosen once at run time, listed, and forced with `GSLAM_SIMD=scalar`.

namespace gslam {
inline namespace v1 {

/// Instruction sets that a kernel may be written for. Each x86 one contains those before it.
enum class Simd {
  scalar,  ///< plain C++, on every machine
  sse4,    ///< x86-64-v2: SSE4.2, POPCNT
  avx2,    ///< x86-64-v3: AVX2, FMA, BMI2
  avx512,  ///< x86-64-v4: AVX-512 F, BW, CD, DQ, VL
  neon     ///< arm64
};

/// All variants there are, whether or not this machine runs them.
inline const std::vector<Simd>& allSimd() {
  static const std::vector<Simd> all = {Simd::scalar, Simd::sse4, Simd::avx2, Simd::avx512,
                                        Simd::neon};
  return all;
}

/// The name that `GSLAM_SIMD` uses, e.g. "avx2".
inline const char* simdName(Simd variant) {
  static const char* const names[] = {"scalar", "sse4", "avx2", "avx512", "neon"};
  const std::size_t index = static_cast<std::size_t>(variant);
  return index < sizeof(names) / sizeof(names[0]) ? names[index] : "unknown";
}

/// The variants that this machine runs, slowest first.
inline std::vector<Simd> availableSimd() {
  const detail::CpuFeatures cpu = detail::detectCpu();
  std::vector<Simd> variants(1, Simd::scalar);
  if (cpu.sse4) variants.push_back(Simd::sse4);
  if (cpu.avx2) variants.push_back(Simd::avx2);
  if (cpu.avx512) variants.push_back(Simd::avx512);
  if (cpu.neon) variants.push_back(Simd::neon);
  return variants;
}

namespace detail {

constexpr int kSimdUndecided = -1;

// One per program, or one per library that is built with hidden visibility; both read GSLAM_SIMD.
inline std::atomic<int>& activeSimdSlot() {
  static std::atomic<int> slot(kSimdUndecided);
  return slot;
}

[[noreturn]] inline void refuseSimd(const std::string& argument, const std::string& name) {
  std::string known;
  for (Simd variant : availableSimd()) known += std::string(" ") + simdName(variant);
  throw ArgumentError(argument, "is \"" + name + "\", but this machine runs:" + known);
}

inline Simd availableSimdFromName(const std::string& argument, const std::string& name) {
  for (Simd variant : availableSimd()) {
    if (name == simdName(variant)) return variant;
  }
  refuseSimd(argument, name);
}

inline Simd decideSimd() {
  const char* const wish = std::getenv("GSLAM_SIMD");
  const Simd decided = (wish == nullptr || *wish == '\0')
                           ? availableSimd().back()
                           : availableSimdFromName("GSLAM_SIMD", wish);
  int expected = kSimdUndecided;  // a variant that was forced meanwhile stays
  activeSimdSlot().compare_exchange_strong(expected, static_cast<int>(decided));
  return static_cast<Simd>(activeSimdSlot().load());
}

}  // namespace detail

/// The variant that kernels use: the best of this machine, unless the environment variable
/// `GSLAM_SIMD` or forceSimd() names another. Costs one relaxed atomic load. Thread-safe.
/// @throws ArgumentError when `GSLAM_SIMD` names none that this machine runs
inline Simd activeSimd() {
  const int active = detail::activeSimdSlot().load(std::memory_order_relaxed);
  return active == detail::kSimdUndecided ? detail::decideSimd() : static_cast<Simd>(active);
}

/// Makes kernels use this variant from now on, in all threads; overrides `GSLAM_SIMD`.
/// For tests and measurements.
/// @throws ArgumentError when this machine does not run it
inline void forceSimd(Simd variant) {
  detail::availableSimdFromName("variant", simdName(variant));
  detail::activeSimdSlot().store(static_cast<int>(variant));
}

/// Forces a variant for the length of a scope and restores the one before.
class ScopedSimd {
 public:
  /// @throws ArgumentError when this machine does not run it
  explicit ScopedSimd(Simd variant) : before_(activeSimd()) { forceSimd(variant); }
  ~ScopedSimd() { detail::activeSimdSlot().store(static_cast<int>(before_)); }
  ScopedSimd(const ScopedSimd&) = delete;
  ScopedSimd& operator=(const ScopedSimd&) = delete;

 private:
  Simd before_;
};

/// @def GSLAM_IF_X86
/// The function where x86 kernels are compiled, else a null pointer.
/// @def GSLAM_IF_ARM64
/// The function where arm64 kernels are compiled, else a null pointer.
#if GSLAM_X86
#define GSLAM_IF_X86(function) function
#else
#define GSLAM_IF_X86(function) nullptr
#endif
#if GSLAM_ARM64
#define GSLAM_IF_ARM64(function) function
#else
#define GSLAM_IF_ARM64(function) nullptr
#endif

/// One kernel in all the variants that it was written for.
///
///     inline float dot(const float* a, const float* b, std::size_t n) {
///       static constexpr SimdKernel<float (*)(const float*, const float*, std::size_t)> kernel(
///           dotScalar, nullptr, GSLAM_IF_X86(dotAvx2), nullptr, GSLAM_IF_ARM64(dotNeon));
///       return kernel.active()(a, b, n);
///     }
///
/// @tparam Function  pointer to function
/// Immutable, so it may be shared by threads.
template <class Function>
class SimdKernel {
 public:
  /// A null pointer stands for a variant that was not written; `scalar` must be there.
  constexpr SimdKernel(Function scalar, Function sse4, Function avx2, Function avx512,
                       Function neon)
      : functions_{scalar, sse4, avx2, avx512, neon} {}

  /// The function for activeSimd(), or the next plainer one that was written.
  Function active() const { return plainer(activeSimd()); }

  /// The function written for exactly this variant, or a null pointer.
  Function exact(Simd variant) const { return functions_[static_cast<int>(variant)]; }

  /// The variants that were written and that this machine runs: what a test goes through.
  std::vector<Simd> variants() const {
    std::vector<Simd> written;
    for (Simd variant : availableSimd()) {
      if (exact(variant) != nullptr) written.push_back(variant);
    }
    return written;
  }

 private:
  Function plainer(Simd variant) const {
    if (variant == Simd::neon) return exact(Simd::neon) ? exact(Simd::neon) : functions_[0];
    int level = static_cast<int>(variant);
    while (level > 0 && functions_[level] == nullptr) --level;
    return functions_[level];
  }

  Function functions_[5];
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_SIMD_H
