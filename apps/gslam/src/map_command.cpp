#include <gslam/core/map_file.h>
#include <gslam/core/map_trajectory.h>
#include <gslam/core/ply.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/svar/json.h>

#include <filesystem>
#include <iostream>

#include "command.h"
#include "options.h"

namespace app {
namespace {

gslam::Svar describeMap(const gslam::Map& map) {
  std::size_t features = 0, images = 0;
  for (const auto& keyframe : map.keyframes()) {
    features += keyframe.value.content->features.size();
    images += keyframe.value.content->images.size();
  }
  return gslam::Svar::object({{"cameras", map.rig().cameras.size()},
                              {"keyframes", map.keyframes().size()},
                              {"images", images},
                              {"features", features},
                              {"points", map.points().size()},
                              {"observations", map.observationCount()},
                              {"edges", map.edges().size()},
                              {"length_m", gslam::pathLength(map)}});
}

int printInfo(const Options& options, const std::string& path) {
  const gslam::Svar facts = describeMap(gslam::loadMap(path));
  if (options.isJson()) {
    std::cout << gslam::printJson(facts) << '\n';
    return kSuccess;
  }
  for (const gslam::Svar::Member& fact : facts.members()) {
    std::cout << fact.first << std::string(14 - fact.first.size(), ' ')
              << gslam::printJson(fact.second) << '\n';
  }
  return kSuccess;
}

int convert(const std::string& from, const std::string& to) {
  const gslam::Map map = gslam::loadMap(from);
  const auto extension = std::filesystem::path(to).extension();
  if (extension == ".gmap") {
    gslam::saveMap(to, map);
  } else if (extension == ".ply") {
    gslam::savePly(to, map);
  } else if (extension == ".txt") {
    gslam::writeTrajectory(to, gslam::keyframeTrajectory(map));
  } else {
    throw gslam::ConfigError("'" + to + "'",
                             "expected a name that ends in .gmap, .ply (points) or "
                             ".txt (trajectory of the keyframes, TUM format)");
  }
  return kSuccess;
}

}  // namespace

int mapCommand(const std::vector<std::string>& arguments) {
  Options options("gslam map info FILE | gslam map convert FILE OUT",
                  "Says what is in a map file, or converts it: OUT ends in .gmap (a map), .ply "
                  "(points with colours) or .txt (trajectory of the keyframes, TUM format).");
  if (!options.read(arguments)) return kSuccess;
  const std::vector<std::string>& words = options.words();
  if (words.size() == 2 && words[0] == "info") return printInfo(options, words[1]);
  if (words.size() == 3 && words[0] == "convert") return convert(words[1], words[2]);
  throw gslam::ConfigError("arguments", "expected `info FILE` or `convert FILE OUT`");
}

}  // namespace app
