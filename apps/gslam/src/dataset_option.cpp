#include "dataset_option.h"

#include <gslam/core/parameters.h>

namespace app {

void declareDataset(Options& options) {
  options
      .arg<std::string>("format", "",
                        "kind of the dataset, such as kitti, where it is not to be found out")
      .shortName("f")
      .group("What");
  options
      .arg<gslam::Svar>("dataset-param", gslam::Svar::object(),
                        "parameters of the dataset, as --dataset-param.NAME VALUE")
      .group("What");
}

gslam::Svar completeOption(const gslam::Svar& defaults, const Options& options,
                           const char* option) {
  const auto given = options.get<gslam::Svar>(option);
  try {
    return gslam::completeParameters(defaults, given);
  } catch (const gslam::SvarError& error) {
    // As it is given: --set NAME=VALUE, --dataset-param.NAME VALUE.
    const std::string between = std::string(option) == "set" ? " " : ".";
    const std::string name = error.path().empty() ? "" : between + error.path();
    throw gslam::ConfigError(std::string("--") + option + name, error.problem());
  }
}

gslam::FoundDataset findDataset(gslam::Plugins& plugins, const Options& options,
                                const std::string& name) {
  const auto format = options.get<std::string>("format");
  return gslam::findDataset(plugins, format.empty() ? name : format + ":" + name);
}

std::unique_ptr<gslam::Dataset> openDataset(gslam::Plugins& plugins, const Options& options,
                                            const std::string& name) {
  const gslam::FoundDataset found = findDataset(plugins, options, name);
  return gslam::openDataset(found,
                            completeOption(found.factory.parameters, options, "dataset-param"));
}

}  // namespace app
