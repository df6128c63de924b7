#ifndef GSLAM_APPS_SESSION_H
#define GSLAM_APPS_SESSION_H

#include <gslam/core.h>
#include <gslam/core/open_dataset.h>
#include <gslam/core/plugins.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "beside.h"
#include "options.h"

namespace app {

/// A dataset, and a SLAM system for it unless none was asked for: what `run` and `play` share.
class Session {
 public:
  /// Declares the options, before they are read.
  static void declare(Options& options);

  /// Opens the dataset and makes the SLAM system.
  /// @throws Error when either fails, or the dataset lacks a sensor that the system needs
  explicit Session(const Options& options);

  bool hasSlam() const { return slam_ != nullptr; }            ///< whether there is a system
  gslam::Dataset& dataset() { return *dataset_; }              ///< as opened
  const gslam::PlayOptions& options() const { return play_; }  ///< which frames, how fast

  /// What plays, so that it can be played again: for machines.
  gslam::Svar protocol() const;

  /// Plays the dataset, with a line of progress, until the end or stop().
  /// @param on_played  see RunSetup
  gslam::RunResult play(const std::function<void(const gslam::RunResult&)>& on_played = nullptr);

  /// Makes play() end after the frame in work, also if it has not begun. By any thread.
  void stop();

 private:
  void makeSlam(const Options& options);
  void makeIsolatedSlam(const Options& options);
  void startApplication(const Options& options);
  void checkSensors(const gslam::SlamFactory& factory) const;

  const gslam::PlayOptions play_;
  gslam::Svar protocol_;
  gslam::Plugins plugins_;
  std::unique_ptr<gslam::Dataset> dataset_;
  gslam::SlamFactory factory_;
  gslam::Svar parameters_;
  std::unique_ptr<gslam::Slam> slam_;
  const gslam::Messenger messenger_;
  std::unique_ptr<Beside> beside_;
  std::unique_ptr<gslam::Player> player_;
};

/// The exit status that a run ends with.
int statusOf(const gslam::PlayReport& report);
/// How it went, for machines.
gslam::Svar describe(const gslam::RunResult& result);
/// How it went, for people, on stdout.
void printResult(const gslam::RunResult& result, bool has_slam);

}  // namespace app

#endif  // GSLAM_APPS_SESSION_H
