#ifndef GSLAM_APPS_RUN_FOLDER_H
#define GSLAM_APPS_RUN_FOLDER_H

#include <gslam/base/error.h>
#include <gslam/svar/svar.h>

#include <string>

namespace app {

/// The member "program" of each run.json that is written here: by it a folder is known to have
/// results, which the next run may replace.
constexpr const char* kRunProgram = "gslam run";

/// The files of a run, or of repeated runs in folders 1, 2, ... Whatever else lies there stays.
class RunFolder {
 public:
  explicit RunFolder(std::string path) : path_(std::move(path)) {}

  /// @throws FileError where there is something that no run wrote: a folder for results is new,
  ///   empty, or has those of a run before
  void check() const;
  /// Makes it and those it lies in, and tries whether files can be written to it. Removes the
  /// results of a run before, also those of repeated runs in it, but run.json, by which it stays
  /// known until that is written anew.
  /// @throws FileError, also as check()
  void prepare() const;
  /// Removes the results of a single run, but run.json, and of repeated ones from a number on.
  /// @throws FileError
  void clear(int first_repeat) const;
  /// What is in run.json; null where that is none, or not of `gslam run`.
  gslam::Svar ownReport() const;

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
  bool isOwn() const;
  void removeResults() const;

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
