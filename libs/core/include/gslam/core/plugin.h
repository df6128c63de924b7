#ifndef GSLAM_CORE_PLUGIN_H
#define GSLAM_CORE_PLUGIN_H

#include <gslam/base/log_hook.h>
#include <gslam/base/platform.h>
#include <gslam/core/build_facts.h>
#include <gslam/core/registry.h>

#include <cstddef>
#include <cstdint>

/// @file
/// For the authors of plugins: one macro makes a shared library one.
///
///     #include <gslam/core/plugin.h>
///
///     GSLAM_PLUGIN(orb, "1.0.0", "Feature-based SLAM for all cameras") {
///       gslam::SlamFactory orb;
///       orb.name = "orb";
///       orb.make = [] { return std::unique_ptr<gslam::Slam>(new Orb); };
///       registry.add(orb);
///     }
///
/// and in CMake `gslam_add_plugin(orb SOURCES orb.cpp)`.

namespace gslam {
inline namespace v1 {

/// Version of PluginEntry. Another version is another interface: it is refused.
constexpr std::uint32_t kPluginInterface = 1;

/// What a plugin exports as the C symbol `gslam_plugin`: data, constant initialised, that is read
/// from the file before any code of the plugin runs. `magic`, `size` and `interface_version` stand
/// there in all versions.
struct PluginEntry {
  char magic[8];                    ///< "GSLAMPG" and a zero byte
  std::uint32_t size;               ///< of this struct, bytes
  std::uint32_t interface_version;  ///< kPluginInterface
  BuildFacts built;                 ///< how the plugin was
  char name[64];                    ///< such as "orb"
  char version[32];                 ///< of the plugin, such as "1.0.0"
  char description[256];            ///< one sentence
  /// Adds the factories. Is called once for each Plugins, and only where `built` fits; may throw.
  void (*add_factories)(Registry& registry);
  /// Makes the plugin's log end in the host's, unless they are one. `host_log` says which is the
  /// host's.
  void (*connect_log)(const void* host_log, const LogSink& sink, LogLevel least);
};

static_assert(offsetof(PluginEntry, built) == 16 && offsetof(PluginEntry, name) == 120,
              "the facts are read by programs of other versions");

/// @cond
namespace detail {

inline void connectLog(const void* host_log, const LogSink& sink, LogLevel least) {
  if (host_log != &logState()) setLogSink(sink, least);
}

}  // namespace detail

#if defined(__GNUC__) || defined(__clang__)
#define GSLAM_DETAIL_PLUGIN_EXPORT __attribute__((visibility("default")))
#elif defined(_WIN32)
#define GSLAM_DETAIL_PLUGIN_EXPORT __declspec(dllexport)
#else
#define GSLAM_DETAIL_PLUGIN_EXPORT
#endif

#ifdef GSLAM_STATIC_PLUGINS
#define GSLAM_DETAIL_PLUGIN_SYMBOL(name) gslam_plugin_##name
#else
#define GSLAM_DETAIL_PLUGIN_SYMBOL(name) gslam_plugin
#endif
/// @endcond

/// Makes this library a plugin; the body that follows adds its factories to `registry`. Stands once
/// in a plugin, in no namespace.
///
/// Compiled with GSLAM_STATIC_PLUGINS the same source is part of a program, which says
/// GSLAM_USE_STATIC_PLUGIN(name) in one of its files.
/// @param name         an identifier, up to 63 characters
/// @param version      of the plugin, a literal of up to 31 characters
/// @param description  one sentence, a literal of up to 255 characters
#define GSLAM_PLUGIN(name, version, description)                                                 \
  static void gslamAddFactoriesOf_##name(::gslam::Registry& registry);                           \
  extern "C" {                                                                                   \
  GSLAM_DETAIL_PLUGIN_EXPORT extern const ::gslam::PluginEntry GSLAM_DETAIL_PLUGIN_SYMBOL(name); \
  constexpr ::gslam::PluginEntry GSLAM_DETAIL_PLUGIN_SYMBOL(name) = {                            \
      "GSLAMPG",                                                                                 \
      sizeof(::gslam::PluginEntry),                                                              \
      ::gslam::kPluginInterface,                                                                 \
      ::gslam::thisBuild(),                                                                      \
      #name,                                                                                     \
      version,                                                                                   \
      description,                                                                               \
      &gslamAddFactoriesOf_##name,                                                               \
      &::gslam::detail::connectLog};                                                             \
  }                                                                                              \
  static void gslamAddFactoriesOf_##name(::gslam::Registry& registry)

namespace detail {

// Plugins that were linked into the program, from last to first. Filled before main(); they
// allocate nothing and cannot fail.
struct StaticPlugin {
  explicit StaticPlugin(const PluginEntry& plugin) noexcept : entry(&plugin), before(last()) {
    last() = this;
  }
  static StaticPlugin*& last() noexcept {
    static StaticPlugin* last = nullptr;
    return last;
  }
  const PluginEntry* entry;
  StaticPlugin* before;
};

}  // namespace detail

/// Makes a plugin that was linked into the program (see GSLAM_PLUGIN) known to each Plugins of it.
/// Stands in one source file of the program, in no namespace.
#define GSLAM_USE_STATIC_PLUGIN(name)                        \
  extern "C" const ::gslam::PluginEntry gslam_plugin_##name; \
  static const ::gslam::detail::StaticPlugin gslamStaticPlugin_##name(gslam_plugin_##name)

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_PLUGIN_H
