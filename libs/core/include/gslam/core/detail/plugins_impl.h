// Definitions of what plugins.h declares.
#ifndef GSLAM_CORE_DETAIL_PLUGINS_IMPL_H
#define GSLAM_CORE_DETAIL_PLUGINS_IMPL_H

#include <gslam/base/error.h>
#include <gslam/base/log_hook.h>
#include <gslam/core/detail/exception_text.h>
#include <gslam/core/detail/plugin_file.h>
#include <gslam/core/detail/shared_library.h>
#include <gslam/core/plugins.h>
#include <gslam/svar/detail/nearest_name.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// What functions for all kinds of factories need to know of one.
template <class Factory>
struct FactoryKind;
template <>
struct FactoryKind<SlamFactory> {
  static const char* name() { return "SLAM system"; }
  static const std::vector<SlamFactory>& in(const Registry& all) { return all.slams(); }
};
template <>
struct FactoryKind<DatasetFactory> {
  static const char* name() { return "dataset"; }
  static const std::vector<DatasetFactory>& in(const Registry& all) { return all.datasets(); }
};
template <>
struct FactoryKind<ApplicationFactory> {
  static const char* name() { return "application"; }
  static const std::vector<ApplicationFactory>& in(const Registry& all) {
    return all.applications();
  }
};

// Null where there is none; it lives as long as the registry is not changed.
template <class Factory>
const Factory* findFactory(const Registry& all, const std::string& name) {
  for (const Factory& one : FactoryKind<Factory>::in(all)) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

template <class Factory>
std::vector<std::string> factoryNames(const Registry& all) {
  std::vector<std::string> names;
  for (const Factory& one : FactoryKind<Factory>::in(all)) names.push_back(one.name);
  return names;
}

inline std::string commaList(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

// Whether it stands for a file, not for a name.
inline bool isPluginPath(const std::string& name) {
  return name.find('/') != std::string::npos || isLibraryName(name) ||
         name.find(".so:") != std::string::npos;
}

// The folders in GSLAM_PLUGIN_PATH.
inline std::vector<std::string> pluginFoldersOf(const char* list) {
  std::vector<std::string> folders;
  const std::string text = list != nullptr ? list : "";
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    if (end > begin) folders.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return folders;
}

// Debian's name of this architecture, where it has one.
inline const char* multiarchName() noexcept {
#if defined(__linux__) && defined(__x86_64__) && defined(__LP64__)
  return "x86_64-linux-gnu";
#elif defined(__linux__) && defined(__aarch64__)
  return "aarch64-linux-gnu";
#elif defined(__linux__) && defined(__i386__)
  return "i386-linux-gnu";
#elif defined(__linux__) && defined(__arm__) && defined(__ARM_PCS_VFP)
  return "arm-linux-gnueabihf";
#elif defined(__linux__) && defined(__riscv) && defined(__LP64__)
  return "riscv64-linux-gnu";
#else
  return "";
#endif
}

inline Svar describeNeeds(const SensorNeeds& needs) {
  return Svar::object({{"cameras", needs.cameras},
                       {"depth", needs.depth},
                       {"imu", needs.imu},
                       {"gnss", needs.gnss},
                       {"calibration", needs.calibration}});
}

template <class Factory>
Svar describeFactory(const Factory& factory) {
  Svar text = Svar::object({{"name", factory.name},
                            {"description", factory.description},
                            {"parameters", factory.parameters}});
  if (!factory.help.isNull()) text.set("help", factory.help);
  return text;
}

inline Svar describeFactory(const SlamFactory& factory) {
  Svar text = describeFactory<SlamFactory>(factory);
  text.set("needs", describeNeeds(factory.needs));
  return text;
}

// Those factories that `wanted(name)`.
template <class Factory, class Wanted>
Svar describeFactories(const Registry& all, const Wanted& wanted) {
  Svar list = Svar::array();
  for (const Factory& one : FactoryKind<Factory>::in(all)) {
    if (wanted(one.name)) list.push_back(describeFactory(one));
  }
  return list;
}

inline bool isAnyName(const std::string&) noexcept {
  return true;
}

inline Svar describePlugin(const Plugin& plugin) {
  const Registry& all = plugin.factories;
  return Svar::object({{"name", plugin.name},
                       {"version", plugin.version},
                       {"description", plugin.description},
                       {"path", plugin.path},
                       {"compiler", fixedText(plugin.built.compiler)},
                       {"core", toText(plugin.built.core)},
                       {"slams", describeFactories<SlamFactory>(all, isAnyName)},
                       {"datasets", describeFactories<DatasetFactory>(all, isAnyName)},
                       {"applications", describeFactories<ApplicationFactory>(all, isAnyName)}});
}

// The program's own factories of a kind: those that no plugin brought.
template <class Factory>
Svar describeOwn(const Plugins& plugins) {
  return describeFactories<Factory>(plugins.registry(), [&](const std::string& name) {
    for (const Plugin& plugin : plugins.loaded()) {
      if (findFactory<Factory>(plugin.factories, name) != nullptr) return false;
    }
    return true;
  });
}

}  // namespace detail

inline std::vector<std::string> defaultPluginFolders() {
  std::vector<std::string> folders = detail::pluginFoldersOf(std::getenv("GSLAM_PLUGIN_PATH"));
  const std::string program = detail::programPath();
  if (program.empty()) return folders;
  const std::string own = detail::parentFolderOf(program);
  const std::string above = detail::parentFolderOf(own) == "/" ? "" : detail::parentFolderOf(own);
  folders.push_back(own);
  folders.push_back(above + "/lib/gslam/plugins");
  folders.push_back(above + "/lib64/gslam/plugins");
  const std::string multiarch = detail::multiarchName();
  if (!multiarch.empty()) folders.push_back(above + "/lib/" + multiarch + "/gslam/plugins");
  return folders;
}

inline Plugins::Plugins(std::vector<std::string> folders) : folders_(std::move(folders)) {
  std::vector<const PluginEntry*> linked;  // from first to last
  for (const detail::StaticPlugin* one = detail::StaticPlugin::last(); one != nullptr;
       one = one->before) {
    linked.insert(linked.begin(), one->entry);
  }
  for (const PluginEntry* const entry : linked) {
    const std::string problem = detail::entryProblem(*entry, thisBuild());
    if (!problem.empty()) {
      throw Error("plugin '" + detail::fixedText(entry->name) + "' of this program " + problem);
    }
    addPlugin(*entry, "", Loaded{false, detail::FileIdentity(), entry->connect_log});
  }
}

inline const Plugin& Plugins::load(const std::string& name_or_path) {
  if (name_or_path.empty()) throw ArgumentError("plugin", "is empty, expected a name or path");
  if (detail::isPluginPath(name_or_path)) return loadFile(name_or_path);
  const std::string file = findFile(name_or_path);
  if (!file.empty()) return loadFile(file);
  for (const Plugin& plugin : loaded_) {  // such as one that is part of the program
    if (plugin.name == name_or_path) return plugin;
  }
  throw Error("there is no plugin '" + name_or_path + "' (libgslam_" + name_or_path +
              ".so and the like); looked in " + lookedIn());
}

inline const Plugin& Plugins::loadFile(const std::string& path) {
  Loaded more = {true, detail::FileIdentity(), nullptr};
  switch (detail::fileKind(path, &more.file)) {
    case detail::FileKind::none:
      throw FileError(path, "does not exist, expected a plugin");
    case detail::FileKind::folder:
      throw FileError(path, "is a folder, expected a plugin");
    case detail::FileKind::other:
      throw FileError(path, "is neither a file nor a link to one, expected a plugin");
    case detail::FileKind::file:
      break;
  }
  const Plugin* const known = findLoaded(more.file);
  if (known != nullptr) return *known;
  const detail::PluginInFile file = detail::readPluginFile(path);
  if (!file.problem.empty()) throw FileError(path, file.problem);
  if (file.is_read) {
    const std::string problem = detail::entryProblem(file.entry, thisBuild());
    if (!problem.empty()) throw FileError(path, problem);
  }
  const void* const object = detail::loadObject(path, "gslam_plugin");
  if (object == nullptr) throw FileError(path, "is no plugin: it does not export `gslam_plugin`");
  // Again: the file may have been replaced meanwhile, or nobody could read it before.
  const PluginEntry& entry = *static_cast<const PluginEntry*>(object);
  const std::string problem = detail::entryProblem(entry, thisBuild());
  if (!problem.empty()) throw FileError(path, problem);
  more.connect_log = entry.connect_log;
  return addPlugin(entry, path, more);
}

inline const Plugin* Plugins::findLoaded(const detail::FileIdentity& file) const {
  for (std::size_t i = 0; i < more_.size(); ++i) {
    if (more_[i].is_file && more_[i].file == file) return &loaded_[i];
  }
  return nullptr;
}

inline const Plugin& Plugins::addPlugin(const PluginEntry& entry, const std::string& path,
                                        const Loaded& more) {
  Plugin plugin;
  plugin.name = detail::fixedText(entry.name);
  plugin.version = detail::fixedText(entry.version);
  plugin.description = detail::fixedText(entry.description);
  plugin.path = path;
  plugin.built = entry.built;
  const std::string place = path.empty() ? "this program" : path;
  for (const Plugin& other : loaded_) {
    if (other.name != plugin.name) continue;
    throw FileError(place, "is plugin '" + plugin.name + "' " + plugin.version +
                               ", of which there is " + other.version + " already, from " +
                               (other.path.empty() ? "this program" : other.path));
  }
  std::string problem;
  try {
    entry.add_factories(plugin.factories);
  } catch (...) {
    problem = detail::exceptionText();
  }
  if (!problem.empty()) {
    throw FileError(place,
                    "plugin '" + plugin.name + "' threw while it added its factories: " + problem);
  }
  Registry all = registry_;
  mergeKind<DatasetFactory>(all, plugin);
  mergeKind<SlamFactory>(all, plugin);
  mergeKind<ApplicationFactory>(all, plugin);
  more_.push_back(more);
  try {
    loaded_.push_back(std::move(plugin));
  } catch (...) {
    more_.pop_back();
    throw;
  }
  std::swap(registry_, all);
  connectLogs();
  return loaded_.back();
}

template <class Factory>
void Plugins::mergeKind(Registry& all, const Plugin& plugin) const {
  for (const Factory& one : detail::FactoryKind<Factory>::in(plugin.factories)) {
    if (detail::findFactory<Factory>(all, one.name) == nullptr) {
      all.add(one);
      continue;
    }
    std::string owner = "this program";
    for (const Plugin& other : loaded_) {
      if (detail::findFactory<Factory>(other.factories, one.name) == nullptr) continue;
      owner = "plugin '" + other.name + "'" + (other.path.empty() ? "" : ", " + other.path);
    }
    throw FileError(plugin.path.empty() ? "this program" : plugin.path,
                    "plugin '" + plugin.name + "' brings the " +
                        detail::FactoryKind<Factory>::name() + " '" + one.name +
                        "', which there is already from " + owner);
  }
}

inline void Plugins::connectLogs() {
  const int least = detail::logState().least.load(std::memory_order_relaxed);
  LogSink sink;
  if (least < detail::kLogOff) sink = [](const LogRecord& record) { log(record); };
  const LogLevel level = sink ? static_cast<LogLevel>(least) : LogLevel::error;
  for (const Loaded& one : more_) {
    if (one.is_file) one.connect_log(&detail::logState(), sink, level);
  }
}

inline std::string Plugins::findFile(const std::string& name) const {
  for (const std::string& folder : folders_) {
    for (const char* const prefix : {"libgslam_", "lib", "gslam_", ""}) {
      std::string path = folder;
      path.append("/").append(prefix).append(name).append(".so");
      if (detail::fileKind(path) != detail::FileKind::none) return path;
    }
  }
  return "";
}

inline const std::vector<RefusedPlugin>& Plugins::loadAll() {
  refused_.clear();
  std::vector<std::string> done;
  for (const std::string& folder : folders_) {
    if (std::find(done.begin(), done.end(), folder) != done.end()) continue;
    loadFolder(folder);
    done.push_back(folder);
  }
  return refused_;
}

// A library that a plugin needs, or a plugin of which there is one in a folder before.
inline bool Plugins::isNoneOrShadowed(const std::string& file,
                                      const detail::PluginInFile& inside) const {
  const bool claims_to_be_one = file.find("gslam_") != std::string::npos;
  if (inside.is_library && !inside.problem.empty()) return !claims_to_be_one;
  if (!inside.is_read) return false;
  for (const Plugin& plugin : loaded_) {
    if (plugin.name == detail::fixedText(inside.entry.name)) return true;
  }
  return false;
}

inline void Plugins::loadFolder(const std::string& folder) {
  for (const std::string& name : detail::namesIn(folder)) {
    if (!detail::isLibraryName(name)) continue;
    std::string path = folder;
    path.append("/").append(name);
    try {
      detail::FileIdentity file;
      if (detail::fileKind(path, &file) == detail::FileKind::file && findLoaded(file)) continue;
      if (isNoneOrShadowed(name, detail::readPluginFile(path))) continue;
      loadFile(path);
    } catch (const FileError& error) {
      const std::string start = path + ": ";
      const std::string text = error.what();
      refused_.push_back(
          {path, text.compare(0, start.size(), start) == 0 ? text.substr(start.size()) : text});
    } catch (const std::exception& error) {
      refused_.push_back({path, error.what()});
    }
  }
}

inline SlamFactory Plugins::slam(const std::string& name) {
  return resolve<SlamFactory>(name);
}
inline DatasetFactory Plugins::dataset(const std::string& name) {
  return resolve<DatasetFactory>(name);
}
inline ApplicationFactory Plugins::application(const std::string& name) {
  return resolve<ApplicationFactory>(name);
}

template <class Factory>
Factory Plugins::resolve(const std::string& name) {
  if (name.empty()) {
    throw ArgumentError(detail::FactoryKind<Factory>::name(), "is empty, expected a name or path");
  }
  const Factory* known = detail::findFactory<Factory>(registry_, name);
  if (known != nullptr) return *known;
  if (detail::isPluginPath(name)) return fromPath<Factory>(name);
  const std::string file = findFile(name);
  if (!file.empty()) {
    const Plugin& plugin = loadFile(file);
    known = detail::findFactory<Factory>(plugin.factories, name);
    if (known != nullptr) return *known;
    if (!detail::FactoryKind<Factory>::in(plugin.factories).empty()) {
      return oneOf<Factory>(plugin, "");
    }
  }
  loadAll();
  known = detail::findFactory<Factory>(registry_, name);
  if (known != nullptr) return *known;
  throw Error(unknownText<Factory>(name));
}

template <class Factory>
Factory Plugins::fromPath(const std::string& path) {
  const std::size_t colon = path.rfind(':');
  const bool is_file = detail::fileKind(path) != detail::FileKind::none;
  if (is_file || colon == std::string::npos) return oneOf<Factory>(loadFile(path), "");
  return oneOf<Factory>(loadFile(path.substr(0, colon)), path.substr(colon + 1));
}

// That of the name, or the only one where it is empty.
template <class Factory>
Factory Plugins::oneOf(const Plugin& plugin, const std::string& factory) const {
  const std::vector<Factory>& all = detail::FactoryKind<Factory>::in(plugin.factories);
  const std::vector<std::string> names = detail::factoryNames<Factory>(plugin.factories);
  const std::string kind = detail::FactoryKind<Factory>::name();
  if (all.empty()) throw FileError(plugin.path, "brings no " + kind);
  if (factory.empty()) {
    if (all.size() == 1) return all.front();
    throw FileError(plugin.path, "brings several " + kind + "s, " + detail::commaList(names) +
                                     ": say which, as in " + plugin.path + ":" + names.front());
  }
  const Factory* const found = detail::findFactory<Factory>(plugin.factories, factory);
  if (found != nullptr) return *found;
  throw FileError(plugin.path, "brings no " + kind + " '" + factory + "', only " +
                                   detail::commaList(names) +
                                   detail::suggestion(detail::nearestName(factory, names)));
}

template <class Factory>
std::string Plugins::unknownText(const std::string& name) const {
  const std::string kind = detail::FactoryKind<Factory>::name();
  const std::vector<std::string> names = detail::factoryNames<Factory>(registry_);
  std::string text = "there is no " + kind + " '" + name + "'" +
                     detail::suggestion(detail::nearestName(name, names)) +
                     " (known: " + (names.empty() ? "none" : detail::commaList(names)) +
                     "); looked in " + lookedIn();
  for (const RefusedPlugin& one : refused_) {
    text += "\nrefused: " + one.path + ": " + one.reason;
  }
  return text;
}

inline std::string Plugins::lookedIn() const {
  if (folders_.empty()) return "no folder";
  std::vector<std::string> texts;
  for (const std::string& folder : folders_) {
    const bool is_there = detail::fileKind(folder) == detail::FileKind::folder;
    texts.push_back(folder + (is_there ? "" : " (does not exist)"));
  }
  return detail::commaList(texts) + "; GSLAM_PLUGIN_PATH adds folders";
}

inline DatasetFactory Plugins::datasetFor(const std::string& path) {
  if (detail::fileKind(path) == detail::FileKind::none) {
    throw FileError(path, "does not exist, expected a dataset");
  }
  loadAll();
  std::vector<std::string> names;
  for (const DatasetFactory& one : registry_.datasets()) {
    try {
      if (one.recognizes && one.recognizes(path)) names.push_back(one.name);
    } catch (...) {
      const std::string problem = detail::exceptionText();
      detail::logParts(LogLevel::warning, __FILE__, __LINE__,
                       {"dataset ", one.name.c_str(), " cannot tell whether it knows ",
                        path.c_str(), ": ", problem.c_str()});
    }
  }
  if (names.size() == 1) return *detail::findFactory<DatasetFactory>(registry_, names.front());
  if (names.empty()) {
    const std::string known = detail::commaList(detail::factoryNames<DatasetFactory>(registry_));
    throw FileError(path, "is no dataset that is known (" + (known.empty() ? "none" : known) +
                              "); looked for plugins in " + lookedIn());
  }
  throw FileError(path,
                  "may be several kinds of datasets, " + detail::commaList(names) + ": say which");
}

inline Svar describe(const Plugins& plugins) {
  Svar folders = Svar::array();
  for (const std::string& folder : plugins.folders()) folders.push_back(folder);
  Svar list = Svar::array();
  const Svar slams = detail::describeOwn<SlamFactory>(plugins);
  const Svar datasets = detail::describeOwn<DatasetFactory>(plugins);
  const Svar applications = detail::describeOwn<ApplicationFactory>(plugins);
  if (slams.size() + datasets.size() + applications.size() != 0) {
    Plugin own;
    own.description = "part of this program";
    own.built = thisBuild();
    Svar text = detail::describePlugin(own);
    text.set("slams", slams);
    text.set("datasets", datasets);
    text.set("applications", applications);
    list.push_back(text);
  }
  for (const Plugin& plugin : plugins.loaded()) list.push_back(detail::describePlugin(plugin));
  Svar refused = Svar::array();
  for (const RefusedPlugin& one : plugins.refused()) {
    refused.push_back(Svar::object({{"path", one.path}, {"reason", one.reason}}));
  }
  return Svar::object({{"folders", folders}, {"plugins", list}, {"refused", refused}});
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_PLUGINS_IMPL_H
