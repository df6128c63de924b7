#include <gslam/base/error.h>
#include <gslam/optimizer/initialize_poses.h>
#include <gslam/optimizer_pba.h>
#include <gslam/svar/error.h>
#include <gslam/svar/json.h>
#ifdef GSLAM_HAS_OPTIMIZER_CERES
#include <gslam/optimizer_ceres.h>
#endif

#include <atomic>
#include <filesystem>
#include <iostream>

#include "../command.h"
#include "../interrupt.h"
#include "problem_file.h"
#include "scene.h"
#include "scene_page.h"
#include "solver_options.h"
#include "solver_report.h"

namespace app {
namespace {

using gslam::OptimizerSummary;
using gslam::Svar;

constexpr std::size_t kMostPointsOfPage = 150000;  // about 3 MB a scene

void declareProblem(Options& options) {
  std::vector<std::string> formats = problemFormatNames();
  formats.emplace_back("auto");
  options.arg<std::string>("format", "auto", "of FILE").choices(formats).group("Files");
  options.arg<std::string>("out", "", "file or folder for the result").group("Files");
  options
      .arg<std::string>("out-format", "auto",
                        "of --out; auto: by its extension (.bal, .out, .g2o, .graph), a folder is "
                        "COLMAP's, else that of FILE")
      .choices(formats)
      .group("Files");
  options.arg<std::string>("report", "", "HTML file: the problem before and after it, to be turned")
      .group("Files");
  options
      .arg<std::string>("ply", "",
                        "PLY file of the result's points and cameras; beside it NAME.before.ply")
      .group("Files");
  options.arg<std::string>("init", "none", "poses of a pose graph to begin with; none: of the file")
      .choices({"none", "chordal", "tree"})
      .group("Problem");
  options.arg<bool>("fix-intrinsics", false, "keep cameras as they are").group("Problem");
}

// "cloud.ply" as "cloud.before.ply".
std::string pathOfBefore(const std::string& path) {
  std::filesystem::path before = path;
  const std::string extension = before.extension().string();
  before.replace_extension(".before" + extension);
  return before.string();
}

// Said before the work, which may take hours.
void requireFolderOf(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty() || std::filesystem::is_directory(folder)) return;
  throw gslam::FileError(path, "cannot be written: there is no folder " + folder.string());
}

class Optimization {
 public:
  explicit Optimization(const Options& options)
      : options_(options), path_(options.oneWord("FILE")), how_(solverOf(options)) {}

  int run() {
    const ProblemFormat format = inputFormat(path_, text("format"));
    const std::string out = text("out");
    const ProblemFormat out_format =
        out.empty() ? format : outputFormat(out, text("out-format"), format);
    if (out_format != ProblemFormat::Colmap) requireFolderOf(out);  // which is made
    requireFolderOf(text("report"));
    requireFolderOf(text("ply"));
    problem_ = readProblem(path_, format);
    prepare();
    if (!options_.isJson()) std::cout << "problem      " << contentText(problem_) << '\n';
    keepPicture(before_);
    solve();
    keepPicture(after_);
    if (summary_.is_usable && !out.empty()) writeProblem(problem_, out, out_format);
    writePictures();
    report(summary_.is_usable ? out : "");
    if (!summary_.is_usable) {
      std::cerr << "gslam optimize: " << summary_.message << '\n';
      return kFailure;
    }
    return stop_ ? kInterrupted : kSuccess;
  }

 private:
  std::string text(const char* name) const { return options_.get<std::string>(name); }
  bool hasPictures() const { return !text("report").empty() || !text("ply").empty(); }

  void prepare() {
    const std::string init = text("init");
    if (std::holds_alternative<gslam::Bundle>(problem_)) {
      if (init != "none") throw gslam::ConfigError("--init", "is for pose graphs, not for bundles");
      if (options_.get<bool>("fix-intrinsics")) {
        std::get<gslam::Bundle>(problem_).camera_freedom.clear();
      }
      return;
    }
    if (options_.get<bool>("fix-intrinsics")) {
      throw gslam::ConfigError("--fix-intrinsics", "is for bundles, not for pose graphs");
    }
    if (init == "none") return;
    const auto kind = init == "tree" ? gslam::PoseInitialization::SpanningTree
                                     : gslam::PoseInitialization::Chordal;
    std::visit([&](auto& graph) { gslam::initializePoses(graph.problem(), kind); },
               std::get<1>(problem_));
  }

  void solve() {
    const OnInterrupt on_interrupt([this] { stop_ = true; });
    if (!options_.isJson()) printIterationHead();
    how_.progress = [this](const gslam::OptimizerIteration& iteration) {
      if (!options_.isJson()) printIteration(iteration);
      return !stop_;
    };
    if (std::holds_alternative<gslam::Bundle>(problem_)) {
      summary_ = gslam::optimizeBundle(std::get<gslam::Bundle>(problem_).problem(), how_);
      return;
    }
    const gslam::PoseGraphResidual residual = residualOf(options_);
    summary_ = std::visit(
        [&](auto& graph) { return gslam::optimizePoseGraph(graph.problem(residual), how_); },
        std::get<1>(problem_));
  }

  // Both scenes are seen as the start is.
  void keepPicture(Scene& scene) {
    if (!hasPictures()) return;
    if (&scene == &before_) view_ = viewOf(problem_);
    scene = sceneOf(problem_, view_);
  }

  void writePictures() {
    const std::string ply = text("ply"), page_path = text("report");
    if (!ply.empty()) {
      writeScenePly(before_, pathOfBefore(ply));
      writeScenePly(after_, ply);
    }
    if (page_path.empty()) return;
    ScenePage page;
    page.title = std::filesystem::path(path_).filename().string() + ": " + contentText(problem_);
    const std::string init = text("init");
    page.start = init == "none" ? "before" : "before, begun by --init " + init;
    page.before = thinned(std::move(before_), kMostPointsOfPage);
    page.after = thinned(std::move(after_), kMostPointsOfPage);
    page.view = view_;
    page.summary = summary_;
    writeScenePage(page, page_path);
  }

  void report(const std::string& out) const {
    if (!options_.isJson()) {
      print(summary_);
      for (const std::string& path : {out, text("report"), text("ply")}) {
        if (!path.empty()) std::cout << "written to   " << path << '\n';
      }
      return;
    }
    Svar facts = describe(summary_);
    facts.set("file", path_);
    facts.set("problem", describe(problem_));
    if (!out.empty()) facts.set("out", out);
    std::cout << gslam::printJson(facts) << '\n';
  }

  const Options& options_;
  const std::string path_;
  gslam::OptimizerOptions how_;
  Problem problem_;
  SceneView view_;
  Scene before_, after_;
  OptimizerSummary summary_;
  std::atomic<bool> stop_{false};
};

}  // namespace

int optimizeCommand(const std::vector<std::string>& arguments) {
  Options options("gslam optimize [options] FILE",
                  "Adjusts a bundle (BAL, Bundler, COLMAP as text) or a pose graph (g2o, TORO). "
                  "Ctrl-C ends it and keeps the best result so far.");
  declareProblem(options);
  declareSolver(options);
  if (!options.read(arguments)) return kSuccess;
  return Optimization(options).run();
}

}  // namespace app
