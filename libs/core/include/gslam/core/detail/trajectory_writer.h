// Trajectories to text. What trajectory_file.h says of writing is done here.
#ifndef GSLAM_CORE_DETAIL_TRAJECTORY_WRITER_H
#define GSLAM_CORE_DETAIL_TRAJECTORY_WRITER_H

#include <gslam/base/detail/new_file.h>
#include <gslam/base/error.h>
#include <gslam/core/detail/stamp_text.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/svar/detail/print_number.h>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Joins numbers to lines.
class LineWriter {
 public:
  /// @param separator  what stands between two numbers
  explicit LineWriter(char separator) : separator_(separator) {}

  void seconds(std::int64_t stamp) {
    char text[kStampRoom];
    field(text, printSeconds(stamp, text));
  }
  void nanoseconds(std::int64_t stamp) {
    char text[kStampRoom];
    field(text, printInt64(stamp, text));
  }
  /// False, with nothing written, for what is not finite.
  bool number(double value) {
    char text[32];
    const std::size_t size = printDouble(value, text);
    if (size != 0) field(text, size);
    return size != 0;
  }
  bool numbers(const Vec3d& v) { return number(v[0]) && number(v[1]) && number(v[2]); }
  void endLine() {
    text_ += '\n';
    is_first_ = true;
  }
  void line(const char* text) {
    text_ += text;
    endLine();
  }

  std::string take() { return std::move(text_); }

 private:
  void field(const char* text, std::size_t size) {
    if (!is_first_) text_ += separator_;
    is_first_ = false;
    text_.append(text, size);
  }

  std::string text_;
  char separator_;
  bool is_first_ = true;
};

inline bool writeTumLine(LineWriter& out, const StampedPose& p) {
  out.seconds(p.stamp);
  const Vec<double, 4>& q = p.pose.rotation().quaternion();
  return out.numbers(p.pose.translation()) && out.numbers(q.segment<3>(0)) && out.number(q[3]);
}

inline bool writeEurocLine(LineWriter& out, const StampedPose& p) {
  out.nanoseconds(p.stamp);
  const Vec<double, 4>& q = p.pose.rotation().quaternion();
  return out.numbers(p.pose.translation()) && out.number(q[3]) && out.numbers(q.segment<3>(0));
}

inline bool writeKittiLine(LineWriter& out, const StampedPose& p) {
  const Mat3d r = p.pose.rotation().matrix();
  const Vec3d t = p.pose.translation();
  for (std::size_t i = 0; i < 3; ++i) {
    if (!out.numbers(r.row(i)) || !out.number(t[i])) return false;
  }
  return true;
}

using WriteLine = bool (*)(LineWriter&, const StampedPose&);

inline std::string printLines(const Trajectory& trajectory, char separator, const char* head,
                              WriteLine write) {
  LineWriter out(separator);
  if (head != nullptr) out.line(head);
  for (const StampedPose& p : trajectory) {
    if (!write(out, p)) {
      throw ArgumentError("trajectory",
                          "has a pose that is not finite at " + std::to_string(p.stamp) + " ns");
    }
    out.endLine();
  }
  return out.take();
}

}  // namespace detail

inline std::string printTrajectory(const Trajectory& trajectory, TrajectoryFormat format) {
  switch (format) {
    case TrajectoryFormat::tum:
      return detail::printLines(trajectory, ' ', "# timestamp tx ty tz qx qy qz qw",
                                &detail::writeTumLine);
    case TrajectoryFormat::kitti:
      return detail::printLines(trajectory, ' ', nullptr, &detail::writeKittiLine);
    case TrajectoryFormat::euroc:
      return detail::printLines(trajectory, ',',
                                "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],"
                                "q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []",
                                &detail::writeEurocLine);
    default:
      throw ArgumentError("format", std::string("is ") + trajectoryFormatName(format) +
                                        ", expected tum, kitti or euroc");
  }
}

inline void writeTrajectory(const std::string& path, const Trajectory& trajectory,
                            TrajectoryFormat format) {
  detail::writeTextFile(path, printTrajectory(trajectory, format));
}

inline void writeTrajectory(std::ostream& out, const Trajectory& trajectory,
                            TrajectoryFormat format) {
  const std::string text = printTrajectory(trajectory, format);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!out) throw FileError("stream", "cannot be written");
}

inline void writeStamps(const std::string& path, const Trajectory& trajectory) {
  detail::LineWriter out(' ');
  for (const StampedPose& p : trajectory) {
    out.seconds(p.stamp);
    out.endLine();
  }
  detail::writeTextFile(path, out.take());
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_TRAJECTORY_WRITER_H
