#include <gslam/core/plugins.h>
#include <gslam/svar/json.h>

#include <algorithm>
#include <iostream>

#include "command.h"
#include "options.h"

namespace app {

int datasetsCommand(const std::vector<std::string>& arguments) {
  Options options("gslam datasets [options]", "Lists the kinds of datasets that can be read.");
  if (!options.read(arguments)) return kSuccess;
  options.noWords();
  gslam::Plugins plugins;
  loadAllPlugins(plugins);
  std::size_t width = 0;
  gslam::Svar list = gslam::Svar::array();
  for (const gslam::DatasetFactory& factory : plugins.registry().datasets()) {
    width = std::max(width, factory.name.size());
    list.push_back(gslam::Svar::object({{"name", factory.name},
                                        {"description", factory.description},
                                        {"parameters", factory.parameters},
                                        {"reads_files", factory.recognizes != nullptr}}));
  }
  if (options.isJson()) {
    std::cout << gslam::printJson(list) << '\n';
    return kSuccess;
  }
  for (const gslam::DatasetFactory& factory : plugins.registry().datasets()) {
    std::cout << factory.name << std::string(width + 2 - factory.name.size(), ' ')
              << factory.description << '\n';
  }
  return kSuccess;
}

}  // namespace app
