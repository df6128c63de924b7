#ifndef GSLAM_CORE_PLUGINS_H
#define GSLAM_CORE_PLUGINS_H

#include <gslam/base/error.h>
#include <gslam/core/build_facts.h>
#include <gslam/core/detail/shared_library.h>
#include <gslam/core/plugin.h>
#include <gslam/core/registry.h>
#include <gslam/svar/svar.h>

#include <cstddef>
#include <deque>
#include <string>
#include <utility>
#include <vector>

/// @file
/// For programs that use plugins: finds, checks and loads them.
///
///     gslam::Plugins plugins;
///     std::unique_ptr<gslam::Slam> slam = plugins.slam("orb").make();

namespace gslam {
inline namespace v1 {

namespace detail {
struct PluginInFile;
}

/// A plugin that was loaded.
struct Plugin {
  std::string name;         ///< such as "orb"
  std::string version;      ///< such as "1.0.0"
  std::string description;  ///< one sentence
  std::string path;         ///< its file, as it was found; empty: linked into the program
  BuildFacts built;         ///< how it was
  Registry factories;       ///< what it brought
};

/// A file that is no plugin, or none for this program.
struct RefusedPlugin {
  std::string path;    ///< the file
  std::string reason;  ///< a sentence without its subject: "was built with ..."
};

/// Where plugins are looked for, in this order: the folders in the environment's GSLAM_PLUGIN_PATH
/// (separated by colons), the program's folder, and from there ../lib/gslam/plugins, the same in
/// ../lib64 and in ../lib/x86_64-linux-gnu or its like (as Debian has it).
std::vector<std::string> defaultPluginFolders();

/// The plugins of a program and all their factories.
///
/// A plugin is a shared library that exports `gslam_plugin` (see GSLAM_PLUGIN). What stands there
/// is read from the file and checked; only then is it loaded, and adds its factories. Nothing else
/// happens. It is loaded local (its symbols are seen by nobody) and stays until the process ends,
/// so that what it made may live as long. A file is loaded once, by whatever path. A plugin whose
/// loading failed leaves all as it was.
///
/// **Names.** "orb" is a file libgslam_orb.so, liborb.so, gslam_orb.so or orb.so in one of the
/// folders. What has a slash or ends in .so is a path.
///
/// **Threads.** One thread at a time may use it, while others use others.
class Plugins {
 public:
  /// Those that were linked into the program, and what defaultPluginFolders() have.
  /// @throws Error when one that was linked in cannot add its factories
  Plugins() : Plugins(defaultPluginFolders()) {}
  /// The same with other folders.
  explicit Plugins(std::vector<std::string> folders);
  Plugins(const Plugins&) = delete;
  Plugins& operator=(const Plugins&) = delete;

  /// Loads a plugin, unless it is loaded.
  /// @param name_or_path  see above
  /// @return it; it lives as long as this
  /// @throws FileError that names the file and both sides when it is no plugin or none for this
  ///   program, cannot be loaded, fails to add its factories, or brings a name that is taken;
  ///   Error that says where a name was looked for
  const Plugin& load(const std::string& name_or_path);

  /// Loads all that is in the folders. A shared library that is no plugin and has no
  /// "gslam_" in its name is passed over, and so is a plugin of which an earlier folder has one.
  /// @return those that were refused; also refused() until the next call
  const std::vector<RefusedPlugin>& loadAll();

  /// @{
  /// Adds a factory of the program's own.
  /// @throws ArgumentError as Registry::add()
  void add(DatasetFactory factory) { registry_.add(std::move(factory)); }
  void add(SlamFactory factory) { registry_.add(std::move(factory)); }
  void add(ApplicationFactory factory) { registry_.add(std::move(factory)); }
  /// @}

  /// @{
  /// The factory of a name: one that is known; else of the plugin of that name; else, where it is a
  /// path, the plugin's only one of its kind, or with "path:name" that one; else whichever plugin
  /// in the folders has it.
  /// @throws Error that says where it was looked for and which name is near; what load() throws
  SlamFactory slam(const std::string& name);
  DatasetFactory dataset(const std::string& name);
  ApplicationFactory application(const std::string& name);
  /// @}

  /// The factory of the dataset in a file or folder, of all plugins in the folders.
  /// @throws FileError when the path does not exist, or none or several recognize it
  DatasetFactory datasetFor(const std::string& path);

  /// Makes what the plugins log end in the program's log (gslam/base/log_hook.h), as of now. To be
  /// called after setLogSink() when plugins were loaded before.
  void connectLogs();

  /// All factories that are known now: the program's own and those of loaded plugins.
  const Registry& registry() const noexcept { return registry_; }
  /// The loaded plugins, in the order of loading.
  const std::deque<Plugin>& loaded() const noexcept { return loaded_; }
  /// Those that loadAll() refused.
  const std::vector<RefusedPlugin>& refused() const noexcept { return refused_; }
  /// Where it looks.
  const std::vector<std::string>& folders() const noexcept { return folders_; }

 private:
  // Of a loaded plugin, what is nobody's business.
  struct Loaded {
    bool is_file;  // else it is part of the program
    detail::FileIdentity file;
    void (*connect_log)(const void*, const LogSink&, LogLevel);
  };
  const Plugin& loadFile(const std::string& path);
  const Plugin& addPlugin(const PluginEntry& entry, const std::string& path, const Loaded& more);
  const Plugin* findLoaded(const detail::FileIdentity& file) const;
  std::string findFile(const std::string& name) const;
  bool isNoneOrShadowed(const std::string& file, const detail::PluginInFile& inside) const;
  void loadFolder(const std::string& folder);
  template <class Factory>
  void mergeKind(Registry& all, const Plugin& plugin) const;

  template <class Factory>
  Factory resolve(const std::string& name);
  template <class Factory>
  Factory fromPath(const std::string& path);
  template <class Factory>
  Factory oneOf(const Plugin& plugin, const std::string& factory) const;
  template <class Factory>
  std::string unknownText(const std::string& name) const;
  std::string lookedIn() const;

  std::vector<std::string> folders_;
  Registry registry_;
  std::deque<Plugin> loaded_;
  std::deque<Loaded> more_;  // as many
  std::vector<RefusedPlugin> refused_;
};

/// All that is known of the plugins, for machines:
///
///     {"folders": [...], "plugins": [{"name", "version", "description", "path", "compiler",
///      "core", "slams": [{"name", "description", "parameters", "needs": {"cameras": 1, "depth",
///      "imu", "gnss", "calibration"}}], "datasets": [{"name", "description", "parameters"}],
///      "applications": [...]}], "refused": [{"path", "reason"}]}
///
/// Factories that the program added itself are a plugin without name, the first, if there are any.
Svar describe(const Plugins& plugins);

}  // namespace v1
}  // namespace gslam

#include <gslam/core/detail/plugins_impl.h>

#endif  // GSLAM_CORE_PLUGINS_H
