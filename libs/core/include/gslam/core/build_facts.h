#ifndef GSLAM_CORE_BUILD_FACTS_H
#define GSLAM_CORE_BUILD_FACTS_H

#include <gslam/base/version.h>
#include <gslam/core/application.h>
#include <gslam/core/dataset.h>
#include <gslam/core/detail/map_layout.h>
#include <gslam/core/frame.h>
#include <gslam/core/registry.h>
#include <gslam/core/slam.h>
#include <gslam/core/version.h>
#include <gslam/geometry/version.h>
#include <gslam/messenger/version.h>
#include <gslam/svar/version.h>

#include <cstddef>
#include <cstdint>
#include <string>

/// @file
/// How a program or plugin was built, as far as the two must agree on it.

namespace gslam {
inline namespace v1 {

/// Version of a library.
struct LibraryVersion {
  std::uint16_t major;  ///< changes when users must change their code
  std::uint16_t minor;  ///< grows with what is added
  std::uint16_t patch;  ///< grows with what is repaired
};

/// How something was built. Plain bytes without pointers: they are read from a plugin's file before
/// any of its code runs.
struct BuildFacts {
  LibraryVersion core;                 ///< of the GSLAM libraries whose headers were used
  LibraryVersion base;                 ///< see core
  LibraryVersion svar;                 ///< see core
  LibraryVersion messenger;            ///< see core
  LibraryVersion geometry;             ///< see core
  std::uint8_t pointer_size;           ///< bytes
  std::uint8_t byte_order;             ///< 1: least byte first, 2: greatest byte first
  char standard_library[16];           ///< "libstdc++", "libc++" or "unknown"
  std::uint32_t standard_library_abi;  ///< what of it may not be mixed: 6 of libstdc++.so.6
  std::uint8_t string_abi;             ///< libstdc++: whether _GLIBCXX_USE_CXX11_ABI, else 0
  std::uint8_t debug_mode;             ///< whether containers are those of a debug mode
  std::uint8_t sanitizer;              ///< 1: address, 2: thread, 0: none
  std::uint8_t reserved;               ///< 0
  std::uint32_t layout;                ///< from the sizes of all types that cross the border
  char compiler[44];                   ///< such as "g++ 12.2", for people
};

static_assert(sizeof(BuildFacts) == 104, "facts are read by programs of other versions");

/// @cond
#if defined(__clang__) && defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GSLAM_DETAIL_SANITIZER 1
#elif __has_feature(thread_sanitizer)
#define GSLAM_DETAIL_SANITIZER 2
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define GSLAM_DETAIL_SANITIZER 1
#elif defined(__SANITIZE_THREAD__)
#define GSLAM_DETAIL_SANITIZER 2
#endif
#ifndef GSLAM_DETAIL_SANITIZER
#define GSLAM_DETAIL_SANITIZER 0
#endif

#if defined(_LIBCPP_VERSION)
#define GSLAM_DETAIL_LIBRARY "libc++"
#define GSLAM_DETAIL_LIBRARY_ABI _LIBCPP_ABI_VERSION
#elif defined(__GLIBCXX__)
#define GSLAM_DETAIL_LIBRARY "libstdc++"
#define GSLAM_DETAIL_LIBRARY_ABI 6
#else
#define GSLAM_DETAIL_LIBRARY "unknown"
#define GSLAM_DETAIL_LIBRARY_ABI 0
#endif

#if defined(_GLIBCXX_USE_CXX11_ABI) && _GLIBCXX_USE_CXX11_ABI
#define GSLAM_DETAIL_STRING_ABI 1
#else
#define GSLAM_DETAIL_STRING_ABI 0
#endif

// Those of the hardened modes that change the layout of iterators and containers.
#if defined(_GLIBCXX_DEBUG) || defined(_LIBCPP_ENABLE_DEBUG_MODE) ||                              \
    defined(_LIBCPP_ABI_BOUNDED_ITERATORS) || defined(_LIBCPP_ABI_BOUNDED_ITERATORS_IN_VECTOR) || \
    defined(_LIBCPP_ABI_BOUNDED_ITERATORS_IN_STRING)
#define GSLAM_DETAIL_DEBUG_MODE 1
#else
#define GSLAM_DETAIL_DEBUG_MODE 0
#endif

#define GSLAM_DETAIL_TEXT_OF(x) #x
#define GSLAM_DETAIL_TEXT(x) GSLAM_DETAIL_TEXT_OF(x)
#if defined(__clang__)
#define GSLAM_DETAIL_COMPILER \
  "clang++ " GSLAM_DETAIL_TEXT(__clang_major__) "." GSLAM_DETAIL_TEXT(__clang_minor__)
#elif defined(__GNUC__)
#define GSLAM_DETAIL_COMPILER \
  "g++ " GSLAM_DETAIL_TEXT(__GNUC__) "." GSLAM_DETAIL_TEXT(__GNUC_MINOR__)
#else
#define GSLAM_DETAIL_COMPILER "unknown"
#endif

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define GSLAM_DETAIL_BYTE_ORDER 2
#else
#define GSLAM_DETAIL_BYTE_ORDER 1
#endif
/// @endcond

namespace detail {

constexpr std::uint32_t mixedSize(std::uint32_t sum, std::size_t size) {
  return (sum ^ static_cast<std::uint32_t>(size)) * 16777619u;  // FNV-1a, with whole sizes
}

// One number for many sizes.
template <class... Ts>
struct LayoutOf {
  static constexpr std::uint32_t value = 2166136261u;
};
template <class T, class... Ts>
struct LayoutOf<T, Ts...> {
  static constexpr std::uint32_t value =
      mixedSize(mixedSize(LayoutOf<Ts...>::value, sizeof(T)), alignof(T));
};

// Of maps also the inside, which both sides walk through.
using BorderLayout =
    LayoutOf<Svar, Messenger, Image, CameraImage, Frame, ImuSample, ImuCalibration, GnssSample,
             CameraSensor, SensorRig, SensorNeeds, Map, Trajectory, DatasetInfo, TrackedPose,
             SlamSetup, ApplicationSetup, DatasetFactory, SlamFactory, ApplicationFactory, Registry,
             Feature, KeyframeContent, Keyframe, KeyframeRow, Observation, MapPoint, Shape,
             PoseEdge, CowOwner, Cow<std::vector<PointId>>, MapLayout::ChunkSize,
             MapLayout::PageSize, RecordChunk<KeyframeRow>, RecordChunk<MapPoint>,
             ListChunk<Observation>, MapLayout::Place, MapLayout::KeyframePage,
             MapLayout::KeyframeNode, MapLayout::PointPage, MapLayout::PointNode,
             MapLayout::ObservationPage, MapLayout::ObservationNode, MapLayout::PointsSeenNode>;

}  // namespace detail

/// The facts of whatever is being compiled.
constexpr BuildFacts thisBuild() {
  return BuildFacts{
      {GSLAM_CORE_VERSION_MAJOR, GSLAM_CORE_VERSION_MINOR, GSLAM_CORE_VERSION_PATCH},
      {GSLAM_BASE_VERSION_MAJOR, GSLAM_BASE_VERSION_MINOR, GSLAM_BASE_VERSION_PATCH},
      {GSLAM_SVAR_VERSION_MAJOR, GSLAM_SVAR_VERSION_MINOR, GSLAM_SVAR_VERSION_PATCH},
      {GSLAM_MESSENGER_VERSION_MAJOR, GSLAM_MESSENGER_VERSION_MINOR, GSLAM_MESSENGER_VERSION_PATCH},
      {GSLAM_GEOMETRY_VERSION_MAJOR, GSLAM_GEOMETRY_VERSION_MINOR, GSLAM_GEOMETRY_VERSION_PATCH},
      sizeof(void*),
      GSLAM_DETAIL_BYTE_ORDER,
      GSLAM_DETAIL_LIBRARY,
      GSLAM_DETAIL_LIBRARY_ABI,
      GSLAM_DETAIL_STRING_ABI,
      GSLAM_DETAIL_DEBUG_MODE,
      GSLAM_DETAIL_SANITIZER,
      0,
      detail::BorderLayout::value,
      GSLAM_DETAIL_COMPILER};
}

/// For people: "1.2.0".
inline std::string toText(const LibraryVersion& version) {
  return std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
         std::to_string(version.patch);
}

namespace detail {

// A fixed array that may lack its zero byte.
template <std::size_t N>
std::string fixedText(const char (&bytes)[N]) {
  std::size_t size = 0;
  while (size < N && bytes[size] != '\0') ++size;
  return std::string(bytes, size);
}

inline std::string standardLibraryText(const BuildFacts& facts) {
  return fixedText(facts.standard_library) + " with ABI " +
         std::to_string(facts.standard_library_abi);
}

inline const char* sanitizerText(std::uint8_t sanitizer) {
  static const char* const kNames[] = {"no sanitizer", "the address sanitizer",
                                       "the thread sanitizer"};
  return sanitizer < 3 ? kNames[sanitizer] : "an unknown sanitizer";
}

inline std::string builtWith(const std::string& plugin, const std::string& host,
                             const std::string& remedy) {
  return "was built with " + plugin + ", this program with " + host + ": " + remedy;
}

// A library of which the two sides need the same major version, and where said the same minor.
inline std::string versionProblem(const char* library, const LibraryVersion& plugin,
                                  const LibraryVersion& host, bool same_minor) {
  if (plugin.major == host.major && (!same_minor || plugin.minor == host.minor)) return "";
  const std::string series =
      std::to_string(host.major) + (same_minor ? "." + std::to_string(host.minor) + ".x" : ".x");
  return builtWith("GSLAM " + std::string(library) + " " + toText(plugin),
                   "GSLAM " + std::string(library) + " " + toText(host),
                   "rebuild it with " + std::string(library) + " " + series);
}

inline std::string versionProblems(const BuildFacts& plugin, const BuildFacts& host) {
  const struct {
    const char* library;
    LibraryVersion plugin, host;
    bool same_minor;
  } pairs[] = {{"core", plugin.core, host.core, false},
               {"messenger", plugin.messenger, host.messenger, true},
               {"base", plugin.base, host.base, false},
               {"svar", plugin.svar, host.svar, false},
               {"geometry", plugin.geometry, host.geometry, false}};
  for (const auto& pair : pairs) {
    std::string problem = versionProblem(pair.library, pair.plugin, pair.host, pair.same_minor);
    if (!problem.empty()) return problem;
  }
  return "";
}

inline std::string standardLibraryProblem(const BuildFacts& plugin, const BuildFacts& host) {
  if (standardLibraryText(plugin) != standardLibraryText(host)) {
    return builtWith("the C++ standard library " + standardLibraryText(plugin),
                     standardLibraryText(host), "rebuild one of them (-stdlib=)");
  }
  if (plugin.string_abi != host.string_abi) {
    return builtWith("_GLIBCXX_USE_CXX11_ABI=" + std::to_string(plugin.string_abi),
                     "_GLIBCXX_USE_CXX11_ABI=" + std::to_string(host.string_abi),
                     "rebuild it with the same -D_GLIBCXX_USE_CXX11_ABI");
  }
  if (plugin.debug_mode != host.debug_mode) {
    return std::string("was built ") + (plugin.debug_mode != 0 ? "with" : "without") +
           " the debug mode of the standard library, this program " +
           (host.debug_mode != 0 ? "with" : "without") +
           " it: rebuild it with the same -D_GLIBCXX_DEBUG";
  }
  return "";
}

// Why a plugin cannot work in this host: a sentence without its subject. Empty: it can.
inline std::string buildProblem(const BuildFacts& plugin, const BuildFacts& host) {
  if (plugin.pointer_size != host.pointer_size || plugin.byte_order != host.byte_order) {
    return "was built for another kind of processor: rebuild it for this one";
  }
  std::string problem = versionProblems(plugin, host);
  if (problem.empty()) problem = standardLibraryProblem(plugin, host);
  if (!problem.empty()) return problem;
  // A host that is instrumented takes plugins that are not; the other way the process would end.
  if (plugin.sanitizer != 0 && plugin.sanitizer != host.sanitizer) {
    return builtWith(sanitizerText(plugin.sanitizer), sanitizerText(host.sanitizer),
                     "rebuild one of them (-fsanitize=)");
  }
  if (plugin.layout != host.layout) {
    return builtWith(fixedText(plugin.compiler) + ", whose types have other sizes",
                     fixedText(host.compiler), "rebuild it without options that change layouts");
  }
  return "";
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_BUILD_FACTS_H
