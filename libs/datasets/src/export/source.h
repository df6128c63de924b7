// What the layouts have in common: which camera is which, and what is to be told of it.
#ifndef GSLAM_DATASETS_SRC_EXPORT_SOURCE_H
#define GSLAM_DATASETS_SRC_EXPORT_SOURCE_H

#include <gslam/core/dataset.h>
#include <gslam/datasets/export_dataset.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace exporting {

/// Collects sentences for a report. Those that count come out once, with their number.
class Notes {
 public:
  void leftOut(const std::string& sentence) { add(left_out_, sentence); }
  void remark(const std::string& sentence) { add(remarks_, sentence); }
  /// Of `things`, such as "frames", left out for a reason.
  void count(const std::string& things, const std::string& reason, std::size_t n = 1) {
    if (n > 0) counts_[{things, reason}] += n;
  }
  void moveTo(ExportReport& report) const;

 private:
  static void add(std::vector<std::string>& list, const std::string& sentence);

  std::vector<std::string> left_out_, remarks_;
  std::map<std::pair<std::string, std::string>, std::size_t> counts_;
};

/// A dataset as a layout sees it.
class Source {
 public:
  /// @throws ArgumentError when no camera takes pictures, or the sequence is no file name
  Source(const DatasetInfo& info, const std::string& format, const ExportOptions& options);

  const DatasetInfo& info() const noexcept { return info_; }
  const SensorRig& rig() const noexcept { return info_.sensors; }
  const std::string& format() const noexcept { return format_; }
  /// ExportOptions::sequence, or else the default.
  std::string sequence(const std::string& otherwise) const;
  /// For comments in files.
  std::string title() const;

  /// Those for brightness and colour, as places in rig().cameras.
  const std::vector<std::size_t>& cameras() const noexcept { return cameras_; }
  const CameraSensor& camera(std::size_t i) const { return rig().cameras[cameras_[i]]; }
  /// The depth camera; null for none.
  const CameraSensor* depth() const noexcept;

  /// Of the camera i in a frame; null where there is none.
  const CameraImage* image(const Frame& frame, std::size_t i) const;
  const CameraImage* depthImage(const Frame& frame) const;

  /// @{
  /// Says that a layout keeps no more cameras than this, no depth, no inertial samples, no
  /// positions of satellites.
  void keepCameras(std::size_t most);
  void dropDepth();
  void dropImu();
  void dropGnss();
  /// @}

  /// @throws ArgumentError when the camera i has no model
  void needModel(std::size_t i) const;
  /// @throws ArgumentError always: that the layout has no such model
  [[noreturn]] void failModel(std::size_t i, const std::string& possible) const;

  /// The ground truth of what is at T_body_x; poses that are not finite are left out and counted.
  std::vector<StampedPose> groundTruth(const SE3d& T_body_x);
  /// Where x was; false where the ground truth does not say.
  bool poseAt(std::int64_t stamp, const SE3d& T_body_x, SE3d& T_world_x) const;

  Notes notes;

 private:
  const CameraImage* imageAt(const Frame& frame, std::size_t place) const;

  const DatasetInfo& info_;
  std::string format_;
  std::string sequence_;
  std::vector<std::size_t> cameras_;
  std::size_t depth_;
};

/// Nanoseconds from one stamp to a later one; a double holds them only after this.
inline std::uint64_t nanosecondsBetween(std::int64_t from, std::int64_t to) noexcept {
  return static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
}

bool isFinite(const SE3d& pose) noexcept;
bool isFinite(const Vec3d& v) noexcept;

/// A layout on its way to disk. The constructor of each checks that the dataset fits.
class Layout {
 public:
  explicit Layout(Source& from) : source(from) {}
  Layout(const Layout&) = delete;
  Layout& operator=(const Layout&) = delete;
  virtual ~Layout() = default;

  /// Writes what is known before the first frame.
  virtual void begin(class ExportFolder& folder) = 0;
  /// Writes what other sensors measured.
  virtual void writeSamples(const Frame&) {}
  /// Makes the files of a frame in memory.
  /// @throws Error when it cannot be written in this layout
  virtual void prepare(const Frame& frame) = 0;
  /// Writes them.
  virtual void commit() = 0;
  /// Writes what is known after the last frame.
  virtual void finish() {}

 protected:
  Source& source;
};

}  // namespace exporting
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_EXPORT_SOURCE_H
