#ifndef GSLAM_APPS_SESSION_H
#define GSLAM_APPS_SESSION_H

#include <gslam/core.h>
#include <gslam/core/isolated_slam.h>
#include <gslam/core/open_dataset.h>
#include <gslam/core/plugins.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "beside.h"
#include "options.h"

namespace app {

/// How long a SLAM system may take.
struct CallLimits {
  std::chrono::milliseconds configure, feed, finish;
};
/// As --timeout says.
CallLimits callLimits(const Options& options);

/// A dataset, and a SLAM system for it unless none was asked for: what `run` and `play` share.
class Session {
 public:
  /// Declares the options, before they are read.
  /// @param slam  the system unless the user says another; empty: none
  static void declare(Options& options, const std::string& slam = "");

  /// Opens the dataset. @throws Error
  explicit Session(const Options& options);
  /// Loads the plugin of the SLAM system, checks its parameters, and starts the application; each
  /// where it was asked for. An isolated system is made, too.
  /// @throws Error, also when the dataset lacks a sensor that the system needs
  void findSlam(const Options& options);
  /// Makes the SLAM system that findSlam() found. @throws what its constructor throws
  void makeSlam();

  bool hasSlam() const { return slam_ != nullptr; }            ///< whether there is a system
  gslam::Dataset& dataset() { return *dataset_; }              ///< as opened
  const gslam::PlayOptions& options() const { return play_; }  ///< which frames, how fast

  /// What plays, so that it can be played again: for machines.
  gslam::Svar protocol() const;
  const std::string& slamName() const { return factory_.name; }  ///< as its factory says
  /// Number of the process that the system has for itself; 0: it has none.
  long slamProcess() const;
  const gslam::Messenger& messenger() const { return messenger_; }  ///< that all is published on

  /// @{
  /// Puts something around the system or the dataset. Before play() and stop().
  using WrapSlam = std::function<std::shared_ptr<gslam::Slam>(std::shared_ptr<gslam::Slam>)>;
  using WrapDataset =
      std::function<std::unique_ptr<gslam::Dataset>(std::unique_ptr<gslam::Dataset>)>;
  void wrap(const WrapSlam& wrapper);
  void wrap(const WrapDataset& wrapper);
  /// @}

  /// Plays the dataset, with a line of progress, until the end or stop().
  gslam::RunResult play();

  /// Makes play() end after the frame in work, also if it has not begun. By any thread.
  void stop();

 private:
  void makeIsolatedSlam(const Options& options);
  void startApplication(const Options& options);
  void checkSensors(const gslam::SlamFactory& factory) const;

  const gslam::PlayOptions play_;
  gslam::Svar protocol_;
  gslam::Plugins plugins_;
  std::unique_ptr<gslam::Dataset> dataset_;
  gslam::SlamFactory factory_;
  gslam::Svar parameters_;
  std::shared_ptr<gslam::Slam> slam_;
  std::shared_ptr<gslam::IsolatedSlam> isolated_;  // the innermost, where it is one
  const gslam::Messenger messenger_;
  std::unique_ptr<Beside> beside_;
  std::unique_ptr<gslam::Player> player_;
};

/// The exit status that a run ends with.
int statusOf(const gslam::PlayReport& report);
/// How it went, for machines.
gslam::Svar describe(const gslam::RunResult& result);
/// How that went, for people, on stdout.
void printResult(const gslam::Svar& result, bool has_slam);
/// What failed, on stderr, if it did.
void printFailure(const gslam::Svar& result);

}  // namespace app

#endif  // GSLAM_APPS_SESSION_H
