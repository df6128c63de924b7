#include <gslam/core/map_file.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/svar/json.h>
#include <sys/stat.h>

#include <cerrno>
#include <iostream>

#include "command.h"
#include "session.h"

namespace app {
namespace {

// Makes a folder and those it lies in.
void makeFolder(const std::string& path) {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    if (mkdir(part.c_str(), 0777) != 0 && errno != EEXIST) {
      throw gslam::FileError(part, "cannot be made", errno);
    }
    if (end == std::string::npos) break;
  }
  struct stat facts = {};
  if (stat(path.c_str(), &facts) != 0 || !S_ISDIR(facts.st_mode)) {
    throw gslam::FileError(path, "is no folder");
  }
}

// What ran, so that it can be run again.
gslam::Svar protocol(const Options& options, Session& session, const gslam::RunResult& result) {
  const gslam::DatasetInfo& info = session.dataset().info();
  return gslam::Svar::object(
      {{"gslam", GSLAM_CORE_VERSION},
       {"dataset",
        gslam::Svar::object({{"given", session.given()},
                             {"name", info.name},
                             {"format", info.format},
                             {"parameters", options.get<gslam::Svar>("dataset-param")}})},
       {"slam", gslam::Svar::object({{"given", options.get<std::string>("slam")},
                                     {"name", session.slamName()},
                                     {"parameters", session.parameters()},
                                     {"isolated", options.get<bool>("isolate")}})},
       {"pace", options.get<std::string>("pace")},
       {"speed", options.get<double>("speed")},
       {"first", options.get<std::size_t>("first")},
       {"count", options.get<std::size_t>("count")},
       {"result", describe(result)}});
}

void keep(const std::string& folder, const gslam::Svar& protocol, const gslam::RunResult& result) {
  gslam::writeTrajectory(folder + "/trajectory.txt", result.trajectory);
  if (result.map != nullptr) gslam::saveMap(folder + "/map.gmap", *result.map);
  protocol.save(folder + "/run.json");
}

}  // namespace

int runCommand(const std::vector<std::string>& arguments) {
  Options options(
      "gslam run DATASET --slam S --out DIR [options]",
      "Runs a SLAM system on a dataset. Writes DIR/trajectory.txt (TUM format, "
      "T_world_body), DIR/run.json (what ran and how it ended) and, where there is one, "
      "DIR/map.gmap. A run that fails or is stopped keeps what it has.");
  Session::declare(options);
  options.arg<std::string>("out", "folder for the results").shortName("o").group("What");
  if (!options.read(arguments)) return kSuccess;
  if (options.get<std::string>("slam").empty()) {
    throw gslam::ConfigError("--slam", "must be given: name or file of the SLAM system");
  }
  Session session(options);
  const auto folder = options.get<std::string>("out");
  makeFolder(folder);
  const gslam::RunResult result = session.play();
  const gslam::Svar report = protocol(options, session, result);
  keep(folder, report, result);
  if (options.isJson()) {
    std::cout << gslam::printJson(report) << '\n';
  } else {
    printResult(result, true);
    std::cout << "results: " << folder << "/trajectory.txt, run.json"
              << (result.map != nullptr ? ", map.gmap" : "") << '\n';
  }
  return statusOf(result.play);
}

}  // namespace app
