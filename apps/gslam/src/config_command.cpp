#include <gslam/core/plugins.h>
#include <gslam/svar/json.h>

#include <iostream>

#include "command.h"
#include "options.h"

namespace app {

int configCommand(const std::vector<std::string>& arguments) {
  Options options("gslam config [--slam S] [--dataset D]",
                  "Prints the parameters of a SLAM system and of a kind of dataset as they are "
                  "unless told, as JSON. Change what you like in the file, and give it to `gslam "
                  "run` or `gslam play` with --config.");
  options.arg<std::string>("slam", "", "name or file of the SLAM system").shortName("s");
  options.arg<std::string>("dataset", "", "name of the kind of dataset").shortName("d");
  if (!options.read(arguments)) return kSuccess;
  options.noWords();
  const auto slam = options.get<std::string>("slam");
  const auto dataset = options.get<std::string>("dataset");
  if (slam.empty() && dataset.empty()) {
    throw gslam::ConfigError("--slam or --dataset", "must be given");
  }
  gslam::Plugins plugins;
  gslam::Svar config = gslam::Svar::object();
  const auto put = [&config](const std::string& name, const gslam::Svar& parameters) {
    config.set(name, parameters.isNull() ? gslam::Svar::object() : parameters);
  };
  if (!slam.empty()) put("set", plugins.slam(slam).parameters);
  if (!dataset.empty()) put("dataset-param", plugins.dataset(dataset).parameters);
  std::cout << gslam::printJson(config, 2) << '\n';
  return kSuccess;
}

}  // namespace app
