// Everything that depends on the compiler, the processor or the system stands in this file.
#ifndef GSLAM_BASE_PLATFORM_H
#define GSLAM_BASE_PLATFORM_H

#include <cstdlib>
#include <string>

#if defined(__GNUC__) || defined(__clang__)
#include <cxxabi.h>
#endif
#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

/// @file
/// Differences of compilers, architectures and systems: symbol visibility, SIMD target regions,
/// names of types, processes.

/// @def GSLAM_PUBLIC
/// Marks a type whose identity must survive shared-library borders (exceptions, messages), so that
/// a plugin built with hidden visibility can throw it and its host can catch it.
#if defined(__GNUC__) || defined(__clang__)
#define GSLAM_PUBLIC __attribute__((visibility("default")))
#else
#define GSLAM_PUBLIC
#endif

/// @def GSLAM_NODISCARD
/// Marks a function whose result must be kept.
#if defined(__GNUC__) || defined(__clang__)
#define GSLAM_NODISCARD __attribute__((warn_unused_result))
#else
#define GSLAM_NODISCARD
#endif

/// @def GSLAM_ALWAYS_INLINE
/// Before a function that is small once its arguments are known, which compilers cannot see.
/// Without optimisation, and under the address sanitizer of g++, they are not known, and it is a
/// function like others.
/// @def GSLAM_COLD
/// Before a function for rare cases, which stays out of line, so that the usual case is small.
#if defined(__GNUC__) || defined(__clang__)
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define GSLAM_ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define GSLAM_ALWAYS_INLINE inline
#endif
#define GSLAM_COLD __attribute__((noinline, cold))
#else
#define GSLAM_ALWAYS_INLINE inline
#define GSLAM_COLD
#endif

/// @def GSLAM_X86
/// 1 where x86-64 kernels (SSE4, AVX2, AVX-512) can be compiled, else 0.
/// @def GSLAM_ARM64
/// 1 where NEON kernels can be compiled, else 0.
#if (defined(__GNUC__) || defined(__clang__)) && defined(__x86_64__)
#define GSLAM_X86 1
#define GSLAM_ARM64 0
#elif (defined(__GNUC__) || defined(__clang__)) && defined(__aarch64__)
#define GSLAM_X86 0
#define GSLAM_ARM64 1
#else
#define GSLAM_X86 0
#define GSLAM_ARM64 0
#endif

/// @def GSLAM_HAS_VECTORS
/// 1 where the compiler has vector types of 128 bits as an extension of the language, and the
/// processor always has the registers, else 0.
/// @def GSLAM_HAS_FMA
/// 1 where all that is compiled may use fused multiply-add instructions (-mfma, -march=native),
/// else 0.
#if GSLAM_X86 || GSLAM_ARM64
#define GSLAM_HAS_VECTORS 1
#else
#define GSLAM_HAS_VECTORS 0
#endif
#if (GSLAM_X86 && defined(__FMA__)) || (GSLAM_ARM64 && defined(__ARM_FEATURE_FMA))
#define GSLAM_HAS_FMA 1
#else
#define GSLAM_HAS_FMA 0
#endif

/// @def GSLAM_TARGET_SSE4
/// Begins a region whose functions are compiled for x86-64-v2 (SSE4.2, POPCNT).
/// @def GSLAM_TARGET_AVX2
/// Begins a region whose functions are compiled for x86-64-v3 (AVX2, FMA, BMI2).
/// @def GSLAM_TARGET_AVX512
/// Begins a region whose functions are compiled for x86-64-v4 (AVX-512 F, BW, CD, DQ, VL).
/// @def GSLAM_TARGET_AVX512_POPCNT
/// Begins a region as GSLAM_TARGET_AVX512 with AVX-512 VPOPCNTDQ, which not all of these have: a
/// second kernel for Simd::avx512, where detail::detectCpu() says `avx512_popcnt`.
/// @def GSLAM_TARGET_END
/// Ends a target region.
///
/// Regions replace compiler flags, so one file holds all variants of a kernel and nothing is
/// exported to whoever includes it. Include the intrinsics header before the first region.
#if GSLAM_X86 && defined(__clang__)
#define GSLAM_DETAIL_PRAGMA(text) _Pragma(#text)
#define GSLAM_DETAIL_TARGET(features) \
  GSLAM_DETAIL_PRAGMA(clang attribute push(__attribute__((target(features))), apply_to = function))
#define GSLAM_TARGET_END GSLAM_DETAIL_PRAGMA(clang attribute pop)
#elif GSLAM_X86
#define GSLAM_DETAIL_PRAGMA(text) _Pragma(#text)
// g++ 12 warns about uninitialised values inside its own AVX-512 header once it is inlined.
#define GSLAM_DETAIL_TARGET(features)                           \
  GSLAM_DETAIL_PRAGMA(GCC push_options)                         \
  GSLAM_DETAIL_PRAGMA(GCC target features)                      \
  GSLAM_DETAIL_PRAGMA(GCC diagnostic push)                      \
  GSLAM_DETAIL_PRAGMA(GCC diagnostic ignored "-Wuninitialized") \
  GSLAM_DETAIL_PRAGMA(GCC diagnostic ignored "-Wmaybe-uninitialized")
#define GSLAM_TARGET_END                  \
  GSLAM_DETAIL_PRAGMA(GCC diagnostic pop) \
  GSLAM_DETAIL_PRAGMA(GCC pop_options)
#endif
#if GSLAM_X86
#define GSLAM_TARGET_SSE4 GSLAM_DETAIL_TARGET("sse4.2,popcnt")
#define GSLAM_TARGET_AVX2 GSLAM_DETAIL_TARGET("avx2,fma,bmi,bmi2,popcnt")
#define GSLAM_TARGET_AVX512 \
  GSLAM_DETAIL_TARGET("avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,fma,bmi,bmi2,popcnt")
#define GSLAM_TARGET_AVX512_POPCNT \
  GSLAM_DETAIL_TARGET(             \
      "avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx512vpopcntdq,avx2,fma,bmi,bmi2,popcnt")
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

/// What the processor and the operating system offer, by x86-64 level (see GSLAM_TARGET_*).
struct CpuFeatures {
  bool sse4;
  bool avx2;
  bool avx512;
  bool neon;
  bool avx512_popcnt;  // avx512 and VPOPCNTDQ
};

inline CpuFeatures detectCpu() {
  CpuFeatures cpu = {false, false, false, GSLAM_ARM64 == 1, false};
#if GSLAM_X86
  __builtin_cpu_init();
  cpu.sse4 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
  cpu.avx2 = cpu.sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
             __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  cpu.avx512 = cpu.avx2 && __builtin_cpu_supports("avx512f") &&
               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
               __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  cpu.avx512_popcnt = cpu.avx512 && __builtin_cpu_supports("avx512vpopcntdq");
#endif
  return cpu;
}

// The name of a type as people write it, from std::type_info::name().
inline std::string readableTypeName(const char* name) {
#if defined(__GNUC__) || defined(__clang__)
  int status = 0;
  char* const readable = abi::__cxa_demangle(name, nullptr, nullptr, &status);
  std::string text = status == 0 ? readable : name;
  std::free(readable);  // NOLINT(cppcoreguidelines-no-malloc): its contract asks for free()
  return text;
#else
  return name;
#endif
}

// Changes at fork(); 0 where there is no such thing.
inline long processId() noexcept {
#if defined(__unix__) || defined(__APPLE__)
  return static_cast<long>(getpid());
#else
  return 0;
#endif
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_PLATFORM_H
