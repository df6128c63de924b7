#ifndef GSLAM_APPS_SESSION_H
#define GSLAM_APPS_SESSION_H

#include <gslam/core.h>
#include <gslam/core/plugins.h>

#include <memory>
#include <string>

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

  /// Whether there is a SLAM system.
  bool hasSlam() const { return slam_ != nullptr; }
  gslam::Dataset& dataset() { return *dataset_; }                ///< as opened
  const std::string& given() const { return given_; }            ///< what the user called it
  const std::string& slamName() const { return slam_name_; }     ///< as its plugin has it
  const gslam::Svar& parameters() const { return parameters_; }  ///< of the system, all

  const gslam::PlayOptions& options() const { return play_; }  ///< which frames, how fast

  /// Plays the dataset, with a line of progress, until the end or Ctrl-C.
  gslam::RunResult play();

 private:
  void makeSlam(gslam::Plugins& plugins, const Options& options);

  gslam::PlayOptions play_;
  std::string given_;
  std::unique_ptr<gslam::Plugins> plugins_;
  std::unique_ptr<gslam::Dataset> dataset_;
  std::string slam_name_;
  gslam::Svar parameters_;
  std::unique_ptr<gslam::Slam> slam_;
};

/// The exit status that a run ends with.
int statusOf(const gslam::PlayReport& report);
/// How it went, for machines.
gslam::Svar describe(const gslam::RunResult& result);
/// How it went, for people, on stdout.
void printResult(const gslam::RunResult& result, bool has_slam);

}  // namespace app

#endif  // GSLAM_APPS_SESSION_H
