#ifndef GSLAM_SVAR_ERROR_H
#define GSLAM_SVAR_ERROR_H

#include <gslam/base/error.h>

#include <memory>
#include <string>
#include <utility>

/// @file
/// The exceptions of Svar.

namespace gslam {
inline namespace v1 {

/// A value that is missing, has another type than asked for, or may not stand where it was put.
class GSLAM_PUBLIC SvarError : public Error {
 public:
  /// The message reads `path: problem`, or just the problem where there is no path.
  /// @param path     the whole path as the caller wrote it, e.g. "camera.0.fx"; may be empty
  /// @param problem  what was expected and what was found
  SvarError(const std::string& path, const std::string& problem)
      : Error(path.empty() ? problem : path + ": " + problem),
        parts_(std::make_shared<std::pair<std::string, std::string>>(path, problem)) {}

  /// The path (or the one name or index) that was asked for; empty where there was none.
  const std::string& path() const noexcept { return parts_->first; }
  /// The message without the path.
  const std::string& problem() const noexcept { return parts_->second; }

 private:
  // shared, so that copying never throws
  std::shared_ptr<const std::pair<std::string, std::string>> parts_;
};

/// A parameter that was given on the command line, in the environment or in a file, and is wrong.
class GSLAM_PUBLIC ConfigError : public Error {
 public:
  /// The message reads `place: problem`.
  /// @param place    where it was given, as its author knows it: "--fps", "GSLAM_FPS", "a.json"
  /// @param problem  what was expected and what was found
  ConfigError(const std::string& place, const std::string& problem)
      : Error(place + ": " + problem), place_(std::make_shared<std::string>(place)) {}

  /// Where it was given.
  const std::string& place() const noexcept { return *place_; }

 private:
  std::shared_ptr<const std::string> place_;  // shared, so that copying never throws
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_ERROR_H
