#include "session.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <utility>
#include <vector>

#include "command.h"
#include "dataset_option.h"
#include "progress.h"
#include "stdout_guard.h"

namespace app {
namespace {

// --dataset D, or D alone.
std::string datasetOf(const Options& options) {
  const auto named = options.get<std::string>("dataset");
  if (named.empty()) return options.oneWord("a dataset");
  options.noWords();
  return named;
}

gslam::PlayOptions playOptions(const Options& options) {
  gslam::PlayOptions play;
  const bool is_paced = options.get<std::string>("mode") == "real-time";
  play.pace = is_paced ? gslam::Pace::real_time : gslam::Pace::every_frame;
  play.speed = options.get<double>("speed");
  play.first = options.get<std::size_t>("first");
  const auto count = options.get<std::size_t>("count");
  if (count > 0) play.count = count;
  return play;
}

gslam::Svar describePlugin(const gslam::Plugin& plugin) {
  return gslam::Svar::object(
      {{"name", plugin.name}, {"version", plugin.version}, {"path", plugin.path}});
}

template <class Factories>
bool hasName(const Factories& factories, const std::string& name) {
  return std::any_of(factories.begin(), factories.end(),
                     [&name](const auto& factory) { return factory.name == name; });
}

// @{
// The plugin that brought a SLAM system or a kind of dataset, and the file it is in.
gslam::Svar pluginOfSlam(const gslam::Plugins& plugins, const std::string& name) {
  for (const gslam::Plugin& plugin : plugins.loaded()) {
    if (hasName(plugin.factories.slams(), name)) return describePlugin(plugin);
  }
  return nullptr;
}
gslam::Svar pluginOfDataset(const gslam::Plugins& plugins, const std::string& name) {
  for (const gslam::Plugin& plugin : plugins.loaded()) {
    if (hasName(plugin.factories.datasets(), name)) return describePlugin(plugin);
  }
  return nullptr;
}
// @}

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

void checkNeedless(const Options& options) {
  if (!options.get<std::string>("slam").empty()) return;
  if (options.get<gslam::Svar>("set").size() > 0) {
    throw gslam::ConfigError("--set", "is for a SLAM system: say which by --slam");
  }
  if (options.get<bool>("isolate")) {
    throw gslam::ConfigError("--isolate", "is for a SLAM system: say which by --slam");
  }
}

}  // namespace

CallLimits callLimits(const Options& options) {
  using std::chrono::milliseconds;
  const double seconds = options.get<double>("timeout");
  if (seconds == 0) return {milliseconds(120000), milliseconds(60000), milliseconds(600000)};
  const milliseconds all(std::max(1LL, std::llround(1000 * seconds)));
  return {all, all, all};
}

void Session::declare(Options& options, const std::string& slam) {
  options.arg<std::string>("dataset", "", "file, folder, KIND:PATH or KIND://...")
      .shortName("d")
      .group("What");
  options.arg<std::string>("slam", slam, "name or file of the SLAM system")
      .shortName("s")
      .group("What");
  options
      .arg<gslam::Svar>("set", gslam::Svar::object(),
                        "parameters of the SLAM system, as --set NAME=VALUE ...")
      .group("What");
  declareDataset(options);
  options.arg<std::string>("application", "", "one to run beside, such as a viewer")
      .shortName("a")
      .group("What");
  options
      .arg<gslam::Svar>("application-param", gslam::Svar::object(),
                        "its parameters, as --application-param.NAME VALUE")
      .group("What");
  options.arg<bool>("isolate", false, "run the SLAM system in a process of its own").group("How");
  options
      .arg<double>("timeout", 0,
                   "seconds that a call of the SLAM system may take; 0: 60 for a frame, 120 to "
                   "configure, 600 to finish")
      .range(0, 86400)
      .group("How");
  options
      .arg<std::string>("mode", "every-frame",
                        "every-frame: the next waits for this one; real-time: by the stamps, and "
                        "what the system is too late for is dropped")
      .choices({"every-frame", "real-time"})
      .group("How");
  options.arg<double>("speed", 1, "of the clock, in real time").range(0.001, 1000).group("How");
  options.arg<std::size_t>("first", 0, "number of the first frame").group("How");
  options.arg<std::size_t>("count", 0, "most frames that are played; 0: all").group("How");
}

Session::Session(const Options& options) : play_(playOptions(options)) {
  checkNeedless(options);
  const StdoutGuard guard;  // what plugins print
  const std::string name = datasetOf(options);
  const gslam::FoundDataset found = findDataset(plugins_, options, name);
  const gslam::Svar given = completeOption(found.factory.parameters, options, "dataset-param");
  dataset_ = gslam::openDataset(found, given);
  const gslam::DatasetInfo& info = dataset_->info();
  if (info.frame_count > 0 && play_.first >= info.frame_count) {
    throw gslam::ConfigError("--first", "is " + std::to_string(play_.first) + ", but there are " +
                                            std::to_string(info.frame_count) + " frames");
  }
  protocol_ = gslam::Svar::object(
      {{"dataset", gslam::Svar::object({{"given", name},
                                        {"name", info.name},
                                        {"format", info.format},
                                        {"plugin", pluginOfDataset(plugins_, found.factory.name)},
                                        {"parameters", given},
                                        {"frames", info.frame_count},
                                        {"first_stamp", info.first_stamp},
                                        {"last_stamp", info.last_stamp},
                                        {"ground_truth_poses", info.ground_truth.size()}})}});
  for (const char* const option : {"mode", "speed", "first", "count", "timeout"}) {
    protocol_.set(option, options.get<gslam::Svar>(option));
  }
  player_ = std::make_unique<gslam::Player>(*dataset_, messenger_);
}

void Session::findSlam(const Options& options) {
  const StdoutGuard guard;  // what plugins print
  if (!options.get<std::string>("application").empty()) startApplication(options);
  const auto name = options.get<std::string>("slam");
  if (name.empty()) return;
  const bool is_isolated = options.get<bool>("isolate");
  // Should it fail.
  protocol_.set("slam", gslam::Svar::object({{"given", name}, {"isolated", is_isolated}}));
  if (is_isolated) {
    makeIsolatedSlam(options);
  } else {
    factory_ = plugins_.slam(name);
    checkSensors(factory_);
  }
  parameters_ = completeOption(factory_.parameters, options, "set");
  protocol_.set("slam", gslam::Svar::object({{"given", name},
                                             {"name", factory_.name},
                                             {"plugin", pluginOfSlam(plugins_, factory_.name)},
                                             {"parameters", parameters_},
                                             {"isolated", is_isolated}}));
}

void Session::makeSlam() {
  const StdoutGuard guard;
  if (factory_.make != nullptr && isolated_ == nullptr) slam_ = gslam::makeSlam(factory_);
}

// A crash of the other process is a failure like others. Its plugin is not loaded for it in this
// one, but may be there, where all were looked through for the dataset's format.
void Session::makeIsolatedSlam(const Options& options) {
  gslam::IsolationOptions isolation;
  isolation.slam = options.get<std::string>("slam");
  const CallLimits limits = callLimits(options);
  isolation.configure_limit = limits.configure;
  isolation.feed_limit = limits.feed;
  isolation.map_limit = isolation.finish_limit = limits.finish;
  isolated_ = std::make_shared<gslam::IsolatedSlam>(isolation);
  factory_ = isolated_->factory();
  checkSensors(factory_);
  slam_ = isolated_;
}

void Session::startApplication(const Options& options) {
  const gslam::ApplicationFactory factory =
      plugins_.application(options.get<std::string>("application"));
  const gslam::Svar parameters = completeOption(factory.parameters, options, "application-param");
  beside_ = std::make_unique<Beside>(factory, gslam::ApplicationSetup{parameters, messenger_});
}

void Session::checkSensors(const gslam::SlamFactory& factory) const {
  const std::string missing = gslam::missingSensors(factory.needs, dataset_->info().sensors);
  if (missing.empty()) return;
  throw gslam::Error("SLAM system '" + factory.name + "' needs what dataset '" +
                     dataset_->info().name + "' lacks: " + missing);
}

gslam::Svar Session::protocol() const {
  return protocol_.clone();
}

long Session::slamProcess() const {
  return isolated_ == nullptr ? 0 : isolated_->processNumber();
}

void Session::wrap(const WrapSlam& wrapper) {
  slam_ = wrapper(std::move(slam_));
}

void Session::wrap(const WrapDataset& wrapper) {
  player_.reset();  // it knows the old one
  dataset_ = wrapper(std::move(dataset_));
  player_ = std::make_unique<gslam::Player>(*dataset_, messenger_);
}

gslam::RunResult Session::play() {
  const StdoutGuard guard;  // what SLAM systems and applications print
  Progress progress;
  progress.follow(messenger_);
  if (slam_ == nullptr) {
    gslam::RunResult result;
    result.play = player_->play(play_);
    beside_.reset();
    return result;
  }
  gslam::RunSetup setup;
  setup.name = factory_.name;
  setup.parameters = parameters_;
  setup.play = play_;
  gslam::RunResult result = gslam::runSlam(*slam_, *player_, *dataset_, setup, messenger_);
  beside_.reset();  // while what it prints is guarded
  return result;
}

void Session::stop() {
  player_->stop();
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

void printResult(const gslam::Svar& result, bool has_slam) {
  const auto count = [&result](const char* name) { return result.get<std::uint64_t>(name, 0); };
  const auto end = result.get<std::string>("end");
  const std::uint64_t frames = count("frames");
  const double time = result.get<double>("seconds", 0);
  std::cout << end << ": " << frames << " frames in " << seconds(time);
  if (time > 0) std::cout << ", " << int(double(frames) / time) << " a second";
  if (count("dropped") > 0) std::cout << ", " << count("dropped") << " dropped";
  if (count("unreadable") > 0) std::cout << ", " << count("unreadable") << " could not be read";
  std::cout << '\n';
  if (has_slam) {
    std::cout << "poses: " << count("poses") << " of " << frames << " frames, "
              << result.get<double>("length_m", 0) << " m\n";
  }
  if (count("invalid_poses") > 0) {
    std::cout << "poses that were not finite, or of no frame that was fed: "
              << count("invalid_poses") << '\n';
  }
  if (count("wrong_stamps") > 0) {
    std::cout << "poses whose stamp is not their frame's, which counts: " << count("wrong_stamps")
              << '\n';
  }
  std::cout.flush();
}

void printFailure(const gslam::Svar& result) {
  if (result.get<std::string>("end") != endName(gslam::PlayEnd::failed)) return;
  std::cerr << "failed";
  if (result.get<std::uint64_t>("frames", 0) > 0) {
    std::cerr << " at frame " << result.get<std::uint64_t>("last_frame", 0);
  }
  std::cerr << ": " << result.get<std::string>("failure", "") << '\n';
}

}  // namespace app
