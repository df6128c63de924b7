#include "session.h"

#include <gslam/core/isolated_slam.h>
#include <gslam/core/open_dataset.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <utility>

#include "command.h"
#include "interrupt.h"
#include "progress.h"

namespace app {
namespace {

// --dataset D, or D alone.
std::string datasetOf(const Options& options) {
  const auto named = options.get<std::string>("dataset");
  if (named.empty()) return options.oneWord("a dataset");
  options.noWords();
  return named;
}

std::vector<std::string> paces() {
  return {"every_frame", "real_time"};
}

gslam::PlayOptions playOptions(const Options& options) {
  gslam::PlayOptions play;
  const bool is_paced = options.get<std::string>("pace") == "real_time";
  play.pace = is_paced ? gslam::Pace::real_time : gslam::Pace::every_frame;
  play.speed = options.get<double>("speed");
  play.first = options.get<std::size_t>("first");
  const auto count = options.get<std::size_t>("count");
  if (count > 0) play.count = count;
  return play;
}

const char* endName(gslam::PlayEnd end) {
  switch (end) {
    case gslam::PlayEnd::finished:
      return "finished";
    case gslam::PlayEnd::stopped:
      return "stopped";
    default:
      return "failed";
  }
}

std::string seconds(double value) {
  std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 3) + " s";
}

}  // namespace

void Session::declare(Options& options) {
  options
      .arg<std::string>("dataset", "",
                        "file, folder, KIND:PATH or KIND://...; see `gslam datasets`")
      .shortName("d")
      .group("What");
  options.arg<std::string>("slam", "", "name or file of the SLAM system")
      .shortName("s")
      .group("What");
  options
      .arg<gslam::Svar>("param", gslam::Svar::object(),
                        "parameters of the SLAM system, as --param.NAME VALUE")
      .group("What");
  options
      .arg<gslam::Svar>("dataset-param", gslam::Svar::object(),
                        "parameters of the dataset, as --dataset-param.NAME VALUE")
      .group("What");
  options.arg<bool>("isolate", false, "run the SLAM system in a process of its own").group("How");
  options.arg<double>("timeout", 60, "seconds an isolated system may take for a frame")
      .range(0.001, 86400)
      .group("How");
  options.arg<std::string>("pace", "every_frame", "when the next frame goes out")
      .choices(paces())
      .group("How");
  options.arg<double>("speed", 1, "of the clock, in real time").range(0.001, 1000).group("How");
  options.arg<std::size_t>("first", 0, "number of the first frame").group("How");
  options.arg<std::size_t>("count", 0, "most frames that are played; 0: all").group("How");
}

Session::Session(const Options& options)
    : play_(playOptions(options)), given_(datasetOf(options)), plugins_(new gslam::Plugins) {
  dataset_ = gslam::openDataset(*plugins_, given_, options.get<gslam::Svar>("dataset-param"));
  if (!options.get<std::string>("slam").empty()) makeSlam(*plugins_, options);
}

void Session::makeSlam(gslam::Plugins& plugins, const Options& options) {
  const auto name = options.get<std::string>("slam");
  const gslam::SlamFactory factory = plugins.slam(name);
  const std::string missing = gslam::missingSensors(factory.needs, dataset_->info().sensors);
  if (!missing.empty()) {
    throw gslam::Error("SLAM system '" + factory.name + "' needs what dataset '" +
                       dataset_->info().name + "' lacks: " + missing);
  }
  slam_name_ = factory.name;
  parameters_ = gslam::completeParameters(factory.parameters, options.get<gslam::Svar>("param"));
  if (options.get<bool>("isolate")) {
    gslam::IsolationOptions isolation;
    isolation.slam = name;
    isolation.feed_limit =
        std::chrono::milliseconds(static_cast<std::int64_t>(options.get<double>("timeout") * 1000));
    slam_ = std::make_unique<gslam::IsolatedSlam>(isolation);
  } else {
    slam_ = factory.make();
  }
}

gslam::RunResult Session::play() {
  const gslam::Messenger messenger;
  Progress progress;
  progress.follow(messenger);
  gslam::Player player(*dataset_, messenger);
  const OnInterrupt interrupt([&player] { player.stop(); });
  if (slam_ == nullptr) {
    gslam::RunResult result;
    result.play = player.play(play_);
    return result;
  }
  gslam::RunSetup setup;
  setup.name = slam_name_;
  setup.parameters = parameters_;
  setup.play = play_;
  return gslam::runSlam(*slam_, player, *dataset_, setup, messenger);
}

int statusOf(const gslam::PlayReport& report) {
  switch (report.end) {
    case gslam::PlayEnd::finished:
      return kSuccess;
    case gslam::PlayEnd::stopped:
      return kInterrupted;
    default:
      return kFailure;
  }
}

gslam::Svar describe(const gslam::RunResult& result) {
  gslam::Svar report = gslam::Svar::object({{"end", endName(result.play.end)},
                                            {"frames", result.play.played},
                                            {"dropped", result.play.dropped},
                                            {"unreadable", result.play.unreadable},
                                            {"last_frame", result.play.last_frame},
                                            {"seconds", result.play.seconds},
                                            {"poses", result.trajectory.size()},
                                            {"invalid_poses", result.invalid_poses},
                                            {"length_m", result.trajectory.length()}});
  if (!result.play.failure.empty()) report.set("failure", result.play.failure);
  return report;
}

void printResult(const gslam::RunResult& result, bool has_slam) {
  const gslam::PlayReport& play = result.play;
  std::cout << endName(play.end) << ": " << play.played << " frames in " << seconds(play.seconds);
  if (play.seconds > 0) std::cout << ", " << int(double(play.played) / play.seconds) << " a second";
  if (play.dropped > 0) std::cout << ", " << play.dropped << " dropped";
  if (play.unreadable > 0) std::cout << ", " << play.unreadable << " could not be read";
  std::cout << '\n';
  if (has_slam) {
    std::cout << "poses: " << result.trajectory.size() << " of " << play.played << " frames, "
              << result.trajectory.length() << " m\n";
  }
  if (result.invalid_poses > 0) {
    std::cout << "poses that were not finite: " << result.invalid_poses << '\n';
  }
  if (play.end == gslam::PlayEnd::failed) {
    std::cerr << "failed at frame " << play.last_frame << ": " << play.failure << '\n';
  }
}

}  // namespace app
