#include <gslam/core/plugins.h>
#include <gslam/svar/json.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

#include "command.h"
#include "options.h"

namespace app {
namespace {

using gslam::Plugin;
using gslam::Svar;

constexpr std::size_t kHelpColumn = 34;

template <class Factory>
void printFactory(const char* kind, const Factory& factory, const std::string& needs) {
  std::cout << "  " << kind << ' ' << factory.name << ": " << factory.description << '\n';
  if (!needs.empty()) std::cout << "    needs " << needs << '\n';
  if (factory.parameters.isNull()) return;
  for (const Svar::Member& parameter : factory.parameters.members()) {
    std::string line = "    " + parameter.first + " = " + gslam::printJson(parameter.second);
    const std::string help = factory.help.template get<std::string>(parameter.first, "");
    if (!help.empty()) {
      line.resize(std::max(line.size() + 2, kHelpColumn), ' ');
      line += help;
    }
    std::cout << line << '\n';
  }
}

void printPlugin(const Plugin& plugin) {
  std::cout << plugin.name << ' ' << plugin.version << ": " << plugin.description << "\n  "
            << (plugin.path.empty() ? "linked into the program" : plugin.path) << '\n';
  const gslam::Registry& factories = plugin.factories;
  for (const auto& one : factories.datasets()) printFactory("dataset", one, "");
  for (const auto& one : factories.slams()) printFactory("SLAM", one, gslam::toText(one.needs));
  for (const auto& one : factories.applications()) printFactory("application", one, "");
}

void printAll(const gslam::Plugins& plugins) {
  for (const Plugin& plugin : plugins.loaded()) printPlugin(plugin);
  if (plugins.loaded().empty()) {
    std::cout << "no plugins were found in\n";
    for (const std::string& folder : plugins.folders()) std::cout << "  " << folder << '\n';
  }
  for (const gslam::RefusedPlugin& refused : plugins.refused()) {
    std::cout << "refused: " << refused.path << ": " << refused.reason << '\n';
  }
}

}  // namespace

int pluginsCommand(const std::vector<std::string>& arguments) {
  Options options("gslam plugins [options] [FILE ...]",
                  "Lists all plugins that are found, and the FILEs, with what they bring, its "
                  "parameters, and the sensors that a SLAM system needs.");
  if (!options.read(arguments)) return kSuccess;
  gslam::Plugins plugins;
  for (const std::string& file : options.words()) plugins.load(file);
  if (options.words().empty()) plugins.loadAll();
  if (options.isJson()) {
    std::cout << gslam::printJson(gslam::describe(plugins)) << '\n';
  } else {
    printAll(plugins);
  }
  return kSuccess;
}

}  // namespace app
