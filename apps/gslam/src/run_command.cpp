#include <gslam/core/map_file.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/svar/json.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <iostream>

#include "command.h"
#include "interrupt.h"
#include "session.h"

namespace app {
namespace {

// The files of one run in a folder.
class Results {
 public:
  // Makes the folder and those it lies in, and removes the results of a run before.
  explicit Results(std::string folder) : folder_(std::move(folder)) {
    if (folder_.empty()) throw gslam::ConfigError("--out", "is empty, expected a folder");
    makeFolder();
    for (const std::string& file : {trajectory(), map(), report()}) {
      if (std::remove(file.c_str()) != 0 && errno != ENOENT) {
        throw gslam::FileError(file, "of a run before cannot be removed", errno);
      }
    }
  }

  std::string trajectory() const { return folder_ + "/trajectory.txt"; }
  std::string map() const { return folder_ + "/map.gmap"; }
  std::string report() const { return folder_ + "/run.json"; }

  void keepPoses(const gslam::RunResult& result) const {
    gslam::writeTrajectory(trajectory(), result.trajectory);
  }
  // The report first: it is there even where the others cannot be written.
  void keepAll(const gslam::Svar& protocol, const gslam::RunResult& result) const {
    protocol.save(report());
    keepPoses(result);
    if (result.map != nullptr) gslam::saveMap(map(), *result.map);
  }

 private:
  void makeFolder() const {
    for (std::size_t end = folder_.find('/', 1);; end = folder_.find('/', end + 1)) {
      const std::string part = folder_.substr(0, end);
      if (mkdir(part.c_str(), 0777) != 0 && errno != EEXIST) {
        throw gslam::FileError(part, "cannot be made", errno);
      }
      if (end == std::string::npos) break;
    }
    struct stat facts = {};
    if (stat(folder_.c_str(), &facts) != 0 || !S_ISDIR(facts.st_mode)) {
      throw gslam::FileError(folder_, "is no folder");
    }
  }

  std::string folder_;
};

}  // namespace

int runCommand(const std::vector<std::string>& arguments) {
  Options options(
      "gslam run DATASET --slam S --out DIR [options]",
      "Runs a SLAM system on a dataset. Writes DIR/trajectory.txt (TUM format, "
      "T_world_body), DIR/run.json (what ran and how it ended) and, where there is one, "
      "DIR/map.gmap, in place of those of a run before. A run that fails or is stopped "
      "keeps what it has.");
  Session::declare(options);
  options.arg<std::string>("out", "folder for the results").shortName("o").group("What");
  if (!options.read(arguments)) return kSuccess;
  if (options.get<std::string>("slam").empty()) {
    throw gslam::ConfigError("--slam", "must be given: name or file of the SLAM system");
  }
  Session session(options);
  const OnInterrupt interrupt([&session] { session.stop(); });
  const Results results(options.get<std::string>("out"));
  const gslam::RunResult result =
      session.play([&results](const gslam::RunResult& so_far) { results.keepPoses(so_far); });
  gslam::Svar report = session.protocol();
  report.set("gslam", GSLAM_CORE_VERSION);
  report.set("result", describe(result));
  results.keepAll(report, result);
  if (options.isJson()) {
    std::cout << gslam::printJson(report) << '\n';
  } else {
    printResult(result, true);
    std::cout << "results: " << results.trajectory() << ", run.json"
              << (result.map != nullptr ? ", map.gmap" : "") << '\n';
  }
  return statusOf(result.play);
}

}  // namespace app
