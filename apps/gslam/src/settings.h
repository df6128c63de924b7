#ifndef GSLAM_APPS_SETTINGS_H
#define GSLAM_APPS_SETTINGS_H

#include <string>
#include <vector>

namespace app {

/// Makes `--set NAME=VALUE ...` what Config knows: `--set.NAME=VALUE` for each. `--param.NAME`, as
/// it was once called, is the same.
/// @throws ConfigError for a --set without NAME=VALUE behind it
std::vector<std::string> withSettings(const std::vector<std::string>& arguments);

}  // namespace app

#endif  // GSLAM_APPS_SETTINGS_H
