#include "options.h"

#include <gslam/optimizer/backend.h>

#include <initializer_list>
#include <sstream>

namespace visual {
namespace {

using gslam::ArgumentError;
using gslam::Svar;

std::string textOf(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

double number(const Svar& parameters, const char* name, double least, double most) {
  const double value = parameters.get<double>(name);
  if (value >= least && value <= most) return value;
  throw ArgumentError(
      name, "is " + textOf(value) + ", expected " + textOf(least) + " to " + textOf(most));
}

int count(const Svar& parameters, const char* name, int least, int most) {
  return int(number(parameters, name, least, most));
}

std::string choice(const Svar& parameters, const char* name,
                   std::initializer_list<const char*> choices) {
  auto given = parameters.get<std::string>(name);
  std::string all;
  for (const char* one : choices) {
    if (given == one) return given;
    all += (all.empty() ? "" : ", ") + std::string(one);
  }
  throw ArgumentError(name, "is '" + given + "', expected one of " + all);
}

// Said when the run begins, not when the first map is adjusted.
std::string backend(const Svar& parameters) {
  auto given = parameters.get<std::string>("backend");
  if (given.empty()) return given;
  std::string all;
  for (const std::string& one : gslam::optimizerBackends()) {
    if (given == one) return given;
    all += (all.empty() ? "" : ", ") + one;
  }
  throw ArgumentError("backend", "is '" + given + "', expected one of " + all);
}

}  // namespace

Svar defaultParameters() {
  const Options o;
  return Svar::object({{"sensor", o.sensor},
                       {"threaded", o.threaded},
                       {"workers", o.workers},
                       {"seed", std::int64_t(o.seed)},
                       {"depth_baseline", o.depth_baseline},
                       {"detector", o.features.detector},
                       {"features", o.features.count},
                       {"scale", o.features.scale},
                       {"levels", o.features.levels},
                       {"corner", o.features.threshold},
                       {"least_corner", o.features.least_threshold},
                       {"window", o.tracking.window},
                       {"least_inliers", o.tracking.least_inliers},
                       {"keyframe_ratio", o.tracking.keyframe_ratio},
                       {"keyframe_gap", o.tracking.keyframe_gap},
                       {"most_gap", o.tracking.most_gap},
                       {"backend", o.mapping.backend},
                       {"neighbours", o.mapping.neighbours},
                       {"bundle", o.mapping.window},
                       {"far_baselines", o.mapping.far_baselines},
                       {"loops", o.loop.enabled},
                       {"adjust_all", o.loop.adjust_all},
                       {"vocabulary", o.loop.vocabulary},
                       {"loop_matches", o.loop.least_matches},
                       {"loop_consistent", o.loop.consistent}});
}

Svar parameterHelp() {
  return Svar::object(
      {{"sensor", "mono, stereo, rgbd; auto: depth, else a pair, else one camera"},
       {"threaded", "tracking, mapping and loops in threads of their own"},
       {"workers", "threads that share the work of one frame; 0: all"},
       {"seed", "of samples"},
       {"depth_baseline", "of the second camera that stands for depth, metres"},
       {"detector", "orb, sift, akaze, brisk, kaze"},
       {"features", "wanted in an image"},
       {"scale", "from one level of the pyramid to the next"},
       {"levels", "of the pyramid"},
       {"corner", "contrast of a corner, grey levels"},
       {"least_corner", "contrast where there is no corner otherwise, grey levels"},
       {"window", "around the predicted pixel, pixels"},
       {"least_inliers", "of a pose that counts"},
       {"keyframe_ratio", "a keyframe is due below this part of the reference's points"},
       {"keyframe_gap", "frames between two keyframes, at least"},
       {"most_gap", "frames between two keyframes, at most"},
       {"backend", "of the optimizer; empty: its choice"},
       {"neighbours", "keyframes in which points are searched"},
       {"bundle", "keyframes that a local bundle adjustment moves"},
       {"far_baselines", "depth beyond so many baselines is no position"},
       {"loops", "whether loops are closed"},
       {"adjust_all", "whether all is adjusted after a loop"},
       {"vocabulary", "a file; empty: trained on the first keyframes"},
       {"loop_matches", "points of a loop, at least"},
       {"loop_consistent", "keyframes in a row that see a loop"}});
}

Options readOptions(const Svar& p) {
  Options o;
  o.sensor = choice(p, "sensor", {"auto", "mono", "stereo", "rgbd"});
  o.threaded = p.get<bool>("threaded");
  o.workers = count(p, "workers", 0, 256);
  o.seed = std::uint64_t(number(p, "seed", 0, 1e15));
  o.depth_baseline = number(p, "depth_baseline", 1e-3, 10);
  o.features.detector = p.get<std::string>("detector");
  o.features.count = count(p, "features", 100, 20000);
  o.features.scale = number(p, "scale", 1.05, 2);
  o.features.levels = count(p, "levels", 1, 16);
  o.features.threshold = count(p, "corner", 1, 200);
  o.features.least_threshold = count(p, "least_corner", 1, o.features.threshold);
  o.tracking.window = number(p, "window", 1, 200);
  o.tracking.least_inliers = count(p, "least_inliers", 10, 1000);
  o.tracking.keyframe_ratio = number(p, "keyframe_ratio", 0.1, 1);
  o.tracking.keyframe_gap = count(p, "keyframe_gap", 0, 1000);
  o.tracking.most_gap = count(p, "most_gap", 1, 100000);
  o.mapping.backend = backend(p);
  o.mapping.neighbours = count(p, "neighbours", 1, 100);
  o.mapping.window = count(p, "bundle", 2, 500);
  o.mapping.far_baselines = number(p, "far_baselines", 1, 1e4);
  o.loop.enabled = p.get<bool>("loops");
  o.loop.adjust_all = p.get<bool>("adjust_all");
  o.loop.vocabulary = p.get<std::string>("vocabulary");
  o.loop.least_matches = count(p, "loop_matches", 10, 10000);
  o.loop.consistent = count(p, "loop_consistent", 1, 100);
  return o;
}

}  // namespace visual
