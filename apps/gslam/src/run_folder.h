#ifndef GSLAM_APPS_RUN_FOLDER_H
#define GSLAM_APPS_RUN_FOLDER_H

#include <gslam/base/error.h>

#include <string>

namespace app {

/// The files of a run.
class RunFolder {
 public:
  explicit RunFolder(std::string path) : path_(std::move(path)) {}

  /// Makes it and those it lies in, and tries whether files can be written to it. Removes the
  /// results of a run before, also those of repeated runs in it.
  /// @throws FileError
  void prepare() const;
  /// Removes the results of a run, and of repeated runs from this number on.
  /// @throws FileError
  void clear(int first_repeat = 1) const;

  const std::string& path() const { return path_; }
  std::string trajectory() const { return path_ + "/trajectory.txt"; }   ///< as published first
  std::string final() const { return path_ + "/trajectory_final.txt"; }  ///< as at the end
  std::string truth() const { return path_ + "/groundtruth.txt"; }       ///< of the dataset
  std::string frames() const { return path_ + "/frames.csv"; }           ///< one line each
  std::string map() const { return path_ + "/map.gmap"; }                ///< at the end
  std::string report() const { return path_ + "/run.json"; }             ///< what ran
  std::string metrics() const { return path_ + "/metrics.json"; }        ///< how good it was
  RunFolder repeat(int number) const { return RunFolder(path_ + "/" + std::to_string(number)); }

 private:
  std::string path_;
};

/// A file that grows by whole lines, each of which is in it when the call returns. What cannot be
/// written is an error of check().
class LineFile {
 public:
  /// Makes it anew. @throws FileError
  explicit LineFile(const std::string& path);
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;
  ~LineFile();

  void append(const std::string& lines) noexcept;
  /// @throws FileError when something could not be written
  void check() const;

 private:
  std::string path_;
  int file_;
  int error_ = 0;
};

}  // namespace app

#endif  // GSLAM_APPS_RUN_FOLDER_H
