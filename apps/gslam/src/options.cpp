#include "options.h"

#include <gslam/base/log.h>
#include <gslam/svar/error.h>

#include <iostream>

namespace app {
namespace {

const std::vector<std::string> kLevels = {"debug", "info", "warning", "error", "off"};

void setUpLog(const std::string& level) {
  if (level == "off") return;
  gslam::LogLevel least = gslam::LogLevel::error;
  if (level == "debug") least = gslam::LogLevel::debug;
  if (level == "info") least = gslam::LogLevel::info;
  if (level == "warning") least = gslam::LogLevel::warning;
  gslam::setLogSink(gslam::streamLogSink(std::cerr), least);
}

}  // namespace

Options::Options(const std::string& usage, const std::string& about) : Config(usage, about) {
  arg<bool>("json", false, "print for machines").group("Output");
  arg<std::string>("log", "warning", "least important messages that are printed")
      .choices(kLevels)
      .group("Output");
}

bool Options::read(const std::vector<std::string>& arguments) {
  const gslam::CommandLine line = parse(arguments);
  words_ = line.rest;
  if (!line.answer.empty()) {
    std::cout << line.answer;
    return false;
  }
  setUpLog(get<std::string>("log"));
  return true;
}

const std::string& Options::oneWord(const std::string& what) const {
  if (words_.size() == 1) return words_[0];
  if (words_.empty()) throw gslam::ConfigError(what, "must be given");
  throw gslam::ConfigError("'" + words_[1] + "'", "is one argument too many");
}

void Options::noWords() const {
  if (!words_.empty()) throw gslam::ConfigError("'" + words_[0] + "'", "is not expected here");
}

void loadAllPlugins(gslam::Plugins& plugins) {
  for (const gslam::RefusedPlugin& refused : plugins.loadAll()) {
    GSLAM_LOG(warning) << refused.path << ": " << refused.reason;
  }
}

}  // namespace app
