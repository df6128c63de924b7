#include "comparison.h"

#include <gslam/base/error.h>
#include <gslam/core/stamp.h>
#include <gslam/svar/error.h>

#include <cstddef>

namespace app {
namespace {

using gslam::ConfigError;

// What an option's text means; what is wrong with it is wrong use of the command.
template <class Parse>
auto parsed(const std::string& option, const std::string& text, const Parse& parse) {
  try {
    return parse(text);
  } catch (const gslam::Error& error) {
    throw ConfigError(option, "'" + text + "': " + error.what());
  }
}

std::int64_t nanosecondsOf(const std::string& seconds) {
  return gslam::parseStamp(seconds);
}

gslam::AssociationOptions associationOf(const Options& options) {
  gslam::AssociationOptions how;
  how.method =
      parsed("--association", options.get<std::string>("association"), gslam::associationMethod);
  how.max_dt = parsed("--max-dt", options.get<std::string>("max-dt"), nanosecondsOf);
  if (how.max_dt < 0) throw ConfigError("--max-dt", "expected 0 or more");
  const std::string offset = options.get<std::string>("time-offset");
  how.finds_offset = offset == "auto";
  if (!how.finds_offset) how.time_offset = parsed("--time-offset", offset, nanosecondsOf);
  return how;
}

}  // namespace

void declareComparison(Options& options) {
  options
      .arg<std::string>("association", "one-to-one",
                        "which poses are compared: one-to-one, interpolate or evo")
      .group("Comparison");
  options.arg<std::string>("max-dt", "0.01", "most seconds between the two poses of a pair")
      .group("Comparison");
  options
      .arg<std::string>("time-offset", "0",
                        "seconds to add to stamps of the estimate, or auto to find it")
      .group("Comparison");
  options
      .arg<std::string>(
          "align", "se3",
          "none, origin, se3, sim3, scale, yaw, or first:N (se3 of the first N pairs)")
      .group("Comparison");
  options
      .arg<double>("lost-after", 0,
                   "seconds without a pose that are a loss; 0: 5 median steps, 0.5 at least")
      .range(0, 1e9)
      .group("Comparison");
  options
      .arg<std::vector<std::string>>(
          "rpe", {},
          "relative errors over 1f (frames), 5m, 2s or 10deg; 10f:all for "
          "all pairs; may be repeated")
      .group("Figures");
  options.arg<bool>("kitti", false, "the figures of KITTI's odometry benchmark").group("Figures");
  options.arg<std::vector<double>>("segments", {}, "errors over parts of these lengths, metres")
      .group("Figures");
}

gslam::EvaluationOptions comparisonOf(const Options& options) {
  gslam::EvaluationOptions how;
  how.association = associationOf(options);
  how.alignment = parsed("--align", options.get<std::string>("align"), gslam::parseAlignment);
  for (const std::string& rpe : options.get<std::vector<std::string>>("rpe")) {
    how.rpe.push_back(parsed("--rpe", rpe, gslam::parseRpe));
  }
  how.has_kitti = options.get<bool>("kitti");
  how.segments = options.get<std::vector<double>>("segments");
  for (const double length : how.segments) {
    if (!(length > 0)) throw ConfigError("--segments", "expected lengths above 0, in metres");
  }
  how.lost_after = std::int64_t(1e9 * options.get<double>("lost-after"));
  return how;
}

std::vector<std::string> withOneRpe(const std::vector<std::string>& arguments) {
  std::vector<std::string> rest;
  std::string list;
  const auto add = [&list](const std::string& one) { list += (list.empty() ? "" : ",") + one; };
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--") {
      rest.insert(rest.end(), arguments.begin() + std::ptrdiff_t(i), arguments.end());
      break;
    }
    if (argument == "--rpe" && i + 1 < arguments.size()) {
      add(arguments[++i]);
    } else if (argument.compare(0, 6, "--rpe=") == 0) {
      add(argument.substr(6));
    } else {
      rest.push_back(argument);
    }
  }
  if (!list.empty()) rest.insert(rest.begin(), "--rpe=" + list);
  return rest;
}

}  // namespace app
