#include <gslam/core/map_file.h>
#include <gslam/core/ply.h>
#include <gslam/evaluation.h>
#include <gslam/svar/error.h>
#include <gslam/svar/json.h>

#include <filesystem>
#include <iostream>
#include <sstream>

#include "command.h"
#include "comparison.h"
#include "machine.h"
#include "options.h"
#include "run_folder.h"
#include "trajectory_input.h"
#include "trajectory_plot.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using gslam::ConfigError;
using gslam::Svar;

// What depends on both files.
void finishAssociation(const Options& options, const Input& reference, const Input& estimate,
                       gslam::AssociationOptions& how) {
  const bool reference_counts = isNumbered(reference, options);
  const bool estimate_counts = isNumbered(estimate, options);
  how.is_numbered = reference_counts && estimate_counts;
  if (reference_counts == estimate_counts) return;
  throw ConfigError("--times",
                    "must be given: " + (reference_counts ? reference.path : estimate.path) +
                        " is a KITTI file, which has no times, and the other has some");
}

// What `gslam run` wrote of the run that the file is of; null where it is of none.
Svar reportOf(const Input& input) {
  const fs::path path = input.path;
  const fs::path parent = path.parent_path();
  const RunFolder folder(parent.empty() ? "." : parent.string());
  for (const std::string& own : {folder.trajectory(), folder.final(), folder.map()}) {
    if (path.filename() == fs::path(own).filename()) return folder.ownReport();
  }
  return nullptr;
}

// It says also which poses its two trajectories have.
std::string posesUsed(const Input& input, const Svar& report) {
  if (input.format == "map") return "final, keyframes";
  if (report.isNull()) return "as in the file";
  const fs::path path = input.path;
  if (path.filename() == "trajectory.txt") return "live, all";
  const Svar poses = report.get<Svar>("poses.final", Svar());
  const bool are_keyframes =
      poses.is<std::string>() && poses.as<std::string>().find("keyframes") != std::string::npos;
  return are_keyframes ? "final, keyframes" : "final, all";
}

// Where the estimate lies beside what `gslam run` wrote, that says dataset, SLAM, parameters, seed.
Svar protocolOf(const Input& reference, const Input& estimate) {
  const Svar report = reportOf(estimate);
  Svar protocol = Svar::object({{"reference", describe(reference)},
                                {"estimate", describe(estimate)},
                                {"poses_used", posesUsed(estimate, report)},
                                {"machine", describeMachine()}});
  if (!report.isNull()) protocol.set("run", report);
  return protocol;
}

gslam::EvaluationOptions evaluationOf(const Options& options, const Input& reference,
                                      const Input& estimate) {
  gslam::EvaluationOptions how = comparisonOf(options);
  finishAssociation(options, reference, estimate, how.association);
  how.protocol = protocolOf(reference, estimate);
  const bool are_matrices = reference.format == "kitti" && estimate.format == "kitti";
  if (are_matrices && how.association.method == gslam::AssociationMethod::evo) {
    how.reference_matrices = gslam::readKittiMatrices(reference.path);
    how.estimate_matrices = gslam::readKittiMatrices(estimate.path);
  }
  return how;
}

std::vector<gslam::MapPoint> readCloud(const std::string& path) {
  if (!isMap(contentOf(path))) return gslam::loadPly(path);
  const gslam::Map map = gslam::loadMap(path);
  std::vector<gslam::MapPoint> points;
  for (const auto& item : map.points()) points.push_back(item.value);
  return points;
}

void measureCloud(const Options& options, gslam::Evaluation& evaluation) {
  const std::string reference = options.get<std::string>("ref-cloud");
  const std::string cloud = options.get<std::string>("cloud");
  if (reference.empty() && cloud.empty()) return;
  if (reference.empty() || cloud.empty()) {
    throw ConfigError(reference.empty() ? "--ref-cloud" : "--cloud",
                      "must be given with the other");
  }
  if (!evaluation.alignment.is_valid) return;
  gslam::CloudOptions how;
  how.S_world_cloud = evaluation.alignment.S_world_map;
  how.icp_rounds = std::size_t(options.get<int>("icp"));
  evaluation.cloud = gslam::cloudErrors(readCloud(reference), readCloud(cloud), how);
  evaluation.has_cloud = true;
}

void declareClouds(Options& options) {
  options.arg<std::string>("ref-cloud", "", "PLY or map file with the true surface's points")
      .group("Files");
  options.arg<std::string>("cloud", "", "PLY or map file whose points are measured").group("Files");
  options.arg<int>("icp", 0, "most rounds that refine the alignment of --cloud")
      .range(0, 10000)
      .group("Figures");
}

std::string plotFile(const Options& options) {
  const auto file = options.get<std::string>("plot");
  if (!file.empty() && fs::path(file).extension() != ".png") {
    throw ConfigError("--plot", "'" + file + "' is no name of a PNG file, such as plot.png");
  }
  return file;
}

std::string plotTitle(const gslam::Evaluation& evaluation) {
  std::ostringstream title;
  title << "ATE " << lengthText(evaluation.ape.translation.rmse) << " rmse ("
        << gslam::alignmentText(evaluation.options.alignment) << "), coverage "
        << numberText(100 * evaluation.coverage.frames, 0.1) << " % of the frames";
  return title.str();
}

// Of the estimate that is drawn which was measured: the poses that have a partner.
TrajectoryPlot plotOf(const Input& reference, const Input& estimate,
                      const gslam::Evaluation& evaluation) {
  TrajectoryPlot plot;
  plot.title = plotTitle(evaluation);
  plot.subtitle = estimate.path + " over " + reference.path;
  plot.lost_after = std::int64_t(1e9 * evaluation.coverage.lost_after);
  for (const gslam::StampedPose& pose : reference.trajectory) {
    plot.truth.push_back({pose.stamp, pose.pose.translation(), 0});
  }
  const gslam::PosePairs& pairs = evaluation.pairs;
  const gslam::SIM3d& S_world_map = evaluation.alignment.S_world_map;
  const std::vector<double> errors = gslam::absoluteErrors(pairs, S_world_map).translation;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const gslam::SE3d pose = gslam::aligned(S_world_map, pairs.estimate[i]);
    plot.estimate.push_back({pairs.stamps[i], pose.translation(), errors[i]});
  }
  return plot;
}

// Writes the picture. @return the plot for the terminal; empty where none is wanted, or possible
std::string drawPlot(const std::string& file, const Input& reference, const Input& estimate,
                     const gslam::Evaluation& evaluation) {
  if (file.empty() || !evaluation.alignment.is_valid) return "";
  const TrajectoryPlot plot = plotOf(reference, estimate, evaluation);
  writePlot(plot, file);
  return plotText(plot, isUtf8Environment()) + "plot         " + file + '\n';
}

}  // namespace

int evalCommand(const std::vector<std::string>& arguments) {
  Options options("gslam eval --ref GT --est EST [options]",
                  "Measures a trajectory against ground truth: association, coverage, alignment, "
                  "absolute and relative errors.");
  declareInputs(options);
  declareClouds(options);
  declareComparison(options);
  options
      .arg<std::string>(
          "plot", "", "PNG file to draw the estimate over ground truth in; a small one is printed")
      .group("Output");
  if (!options.read(withOneRpe(arguments))) return kSuccess;
  options.noWords();
  const std::string plot_file = plotFile(options);
  const Input reference = readInput(options, "ref"), estimate = readInput(options, "est");
  const gslam::EvaluationOptions how = evaluationOf(options, reference, estimate);
  gslam::Evaluation evaluation = gslam::evaluate(reference.trajectory, estimate.trajectory, how);
  measureCloud(options, evaluation);
  const std::string plot = drawPlot(plot_file, reference, estimate, evaluation);
  if (options.isJson()) {
    std::cout << gslam::printJson(gslam::evaluationToSvar(evaluation)) << '\n';
  } else {
    printInput("reference", reference);
    printInput("estimate", estimate);
    std::cout << gslam::evaluationText(evaluation) << plot;
  }
  if (evaluation.alignment.is_valid) return kSuccess;
  std::cerr << "gslam eval: --align " << gslam::alignmentText(how.alignment)
            << " is not possible: " << evaluation.alignment.reason << '\n';
  if (!plot_file.empty()) std::cerr << plot_file << ": was not drawn\n";
  return kFailure;
}

}  // namespace app
