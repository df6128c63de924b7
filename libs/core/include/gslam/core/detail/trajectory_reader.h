// Text to trajectories. What trajectory_file.h says of reading is done here.
#ifndef GSLAM_CORE_DETAIL_TRAJECTORY_READER_H
#define GSLAM_CORE_DETAIL_TRAJECTORY_READER_H

#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/geometry/nearest_rotation.h>
#include <gslam/svar/detail/json_file.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

inline const char* expectedLine(TrajectoryFormat format) noexcept {
  switch (format) {
    case TrajectoryFormat::tum:
      return "timestamp tx ty tz qx qy qz qw (TUM)";
    case TrajectoryFormat::kitti:
      return "12 numbers, the rows of a 3 x 4 matrix (KITTI)";
    case TrajectoryFormat::euroc:
      return "timestamp,px,py,pz,qw,qx,qy,qz and perhaps more (EuRoC)";
    default:
      return "a line of TUM (8 numbers), KITTI (12) or EuRoC (8 or more, with commas)";
  }
}

/// Poses in the order of the file, and the lines they are from.
struct PoseLines {
  std::vector<StampedPose> poses;
  std::vector<std::size_t> lines;

  void reserve(std::size_t count) {
    poses.reserve(count);
    lines.reserve(count);
  }
  void add(std::int64_t stamp, const SE3d& pose, std::size_t line) {
    poses.push_back(StampedPose{stamp, pose});
    lines.push_back(line);
  }
};

inline SO3d rotationOf(const FieldReader& in, const char* at, double x, double y, double z,
                       double w) {
  const double norm = Vec<double, 4>{{x, y, z, w}}.norm();
  if (!(std::fabs(norm - 1) <= kQuaternionTolerance)) {
    in.fail(at, "the quaternion has the norm " + numberText(norm) + ", expected 1 within " +
                    numberText(kQuaternionTolerance) + "; are these the right columns?");
  }
  return SO3d::fromQuaternion(x, y, z, w);
}

inline Vec3d readPosition(FieldReader& in) {
  const double x = in.number("tx"), y = in.number("ty"), z = in.number("tz");
  return {{x, y, z}};
}

inline void readTumLine(FieldReader& in, StampUnit unit, PoseLines& out) {
  const std::int64_t stamp = in.stamp(stampUnitName(unit), 3 * static_cast<int>(unit));
  const Vec3d t = readPosition(in);
  const char* const at = in.place();
  const double x = in.number("qx"), y = in.number("qy"), z = in.number("qz"), w = in.number("qw");
  in.endLine();
  out.add(stamp, SE3d(rotationOf(in, at, x, y, z, w), t), in.line());
}

/// @param count  how many numbers each line has; 0: not known yet
inline void readEurocLine(FieldReader& in, std::size_t& count, PoseLines& out) {
  const std::int64_t stamp = in.stamp("nanoseconds", 0);
  const Vec3d t = readPosition(in);
  const char* const at = in.place();
  const double w = in.number("qw"), x = in.number("qx"), y = in.number("qy"), z = in.number("qz");
  const SE3d pose(rotationOf(in, at, x, y, z, w), t);
  while (!in.isLineEnd()) (void)in.number("a number after the pose");
  if (count == 0) count = in.count();
  if (count != in.count()) {
    in.fail(in.place(), "the line has " + std::to_string(in.count()) + " numbers, the first one " +
                            std::to_string(count));
  }
  out.add(stamp, pose, in.line());
}

inline SE3d readKittiLine(FieldReader& in) {
  static const char* const kNames[] = {"r11", "r12", "r13", "tx",  "r21", "r22",
                                       "r23", "ty",  "r31", "r32", "r33", "tz"};
  const char* const at = in.place();
  Mat<double, 3, 4> m;
  for (std::size_t i = 0; i < 12; ++i) m.values[i] = in.number(kNames[i]);
  in.endLine();
  const NearestRotation<double> nearest = nearestRotation(m.block<3, 3>(0, 0));
  if (!(nearest.distance <= kMatrixTolerance)) {
    in.fail(at, "the matrix is " + numberText(nearest.distance) +
                    " from the nearest rotation, expected at most " + numberText(kMatrixTolerance));
  }
  return SE3d(nearest.rotation, m.col(3));
}

/// How many lines the text may have, by the length of the one that begins at `line`.
inline std::size_t guessLines(const std::string& text, const char* line) {
  const std::size_t begin = static_cast<std::size_t>(line - text.data());
  const std::size_t end = std::min(text.find('\n', begin), text.size());
  return (text.size() - begin) / (end - begin + 1) + 1;
}

inline PoseLines readLines(const std::string& text, const std::string& source,
                           TrajectoryFormat format, StampUnit unit) {
  FieldReader in(text, source, expectedLine(format));
  PoseLines out;
  std::size_t count = 0;
  while (in.nextLine()) {
    if (out.poses.empty()) out.reserve(guessLines(text, in.place()));
    if (format == TrajectoryFormat::tum) {
      readTumLine(in, unit, out);
    } else if (format == TrajectoryFormat::euroc) {
      readEurocLine(in, count, out);
    } else {
      const std::int64_t frame = static_cast<std::int64_t>(out.poses.size());
      out.add(frame, readKittiLine(in), in.line());
    }
  }
  return out;
}

[[noreturn]] inline void refuseTwins(const std::string& source, const PoseLines& in, std::size_t a,
                                     std::size_t b) {
  throw ParseError(source, std::max(in.lines[a], in.lines[b]), 1,
                   "has the stamp " + secondsText(in.poses[a].stamp) + " s, as line " +
                       std::to_string(std::min(in.lines[a], in.lines[b])) +
                       " has, expected each stamp once");
}

/// Poses in any order become a trajectory.
inline Trajectory ordered(const std::string& source, PoseLines in, DuplicateStamps duplicates) {
  const auto isNotBefore = [](const StampedPose& a, const StampedPose& b) {
    return a.stamp >= b.stamp;
  };
  const bool is_ordered =
      std::adjacent_find(in.poses.begin(), in.poses.end(), isNotBefore) == in.poses.end();
  if (is_ordered) return Trajectory(std::move(in.poses));
  std::vector<std::size_t> order(in.poses.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&in](std::size_t a, std::size_t b) {
    return in.poses[a].stamp < in.poses[b].stamp;
  });
  std::vector<StampedPose> poses;
  poses.reserve(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const StampedPose& pose = in.poses[order[i]];
    if (poses.empty() || poses.back().stamp != pose.stamp) {
      poses.push_back(pose);
    } else if (duplicates == DuplicateStamps::refuse) {
      refuseTwins(source, in, order[i - 1], order[i]);
    } else if (duplicates == DuplicateStamps::keep_last) {
      poses.back() = pose;
    }
  }
  return Trajectory(std::move(poses));
}

/// Whether one of the comments before the first line of numbers speaks of nanoseconds.
inline bool mentionsNanoseconds(const std::string& text, const char* first_line) {
  const std::string head(text.data(), first_line);
  return head.find("[ns]") != std::string::npos || head.find("(ns)") != std::string::npos ||
         head.find("nanosec") != std::string::npos;
}

/// Whether a word is a stamp that can only be in nanoseconds where seconds are the other choice.
inline bool isInNanoseconds(const std::string& stamp) {
  const ParsedStamp whole = parseStamp(stamp.data(), stamp.data() + stamp.size(), 0);
  return whole.status == StampStatus::ok && whole.value >= 1000000000000000;
}

/// Of a line of eight numbers with commas, which both TUM and EuRoC may be.
inline TrajectoryFormat formatOfEight(const FieldReader& in, const std::string& stamp,
                                      StampUnit unit, bool mentions_nanoseconds) {
  const bool is_euroc = isInNanoseconds(stamp) || mentions_nanoseconds;
  if (!is_euroc && stamp.find('.') != std::string::npos) return TrajectoryFormat::tum;
  if (unit != StampUnit::seconds) {
    in.fail(in.place(), std::string("the line may be TUM in ") + stampUnitName(unit) +
                            " (w is the last number) or EuRoC (w is the fifth): say which format "
                            "it is");
  }
  if (is_euroc) return TrajectoryFormat::euroc;
  in.fail(in.place(), "the stamp " + quotedText(stamp) +
                          " may be in seconds (TUM, w is the last number) or nanoseconds (EuRoC, w "
                          "is the fifth): say which format it is");
}

/// For lines of a number of numbers.
/// @param unit  that of stamps where it is TUM
inline TrajectoryFormat formatOf(FieldReader& in, const std::string& text, StampUnit unit) {
  const char* const line = in.place();
  const std::string stamp = in.word();
  const char* const line_end = std::find(line, text.data() + text.size(), '\n');
  const bool has_commas = std::find(line, line_end, ',') != line_end;
  FieldReader words = in;
  while (!words.isLineEnd()) words.skipWord();
  const std::size_t count = words.count();
  if (count == 12 && has_commas && isInNanoseconds(stamp)) return TrajectoryFormat::euroc;
  if (count == 12) return TrajectoryFormat::kitti;
  if (count == 8 && !has_commas) return TrajectoryFormat::tum;
  if (count == 8) return formatOfEight(in, stamp, unit, mentionsNanoseconds(text, line));
  if (count > 8 && has_commas) return TrajectoryFormat::euroc;
  (void)in.number("the first word");
  in.fail(line, "the line has " + std::to_string(count) + (count == 1 ? " number" : " numbers") +
                    ", expected " + expectedLine(TrajectoryFormat::any));
}

[[noreturn]] inline void refuseEmpty(const std::string& source, TrajectoryFormat format) {
  throw ParseError(source, 0, 0, std::string("has no poses, expected ") + expectedLine(format));
}

inline std::string textOf(std::istream& in, const std::string& source) {
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) throw FileError(source, "cannot be read");
  return text;
}

inline Trajectory kittiWith(const std::vector<std::int64_t>& stamps, const std::string& path,
                            const std::string& stamps_source) {
  PoseLines in = readLines(readFile(path), path, TrajectoryFormat::kitti, StampUnit::seconds);
  if (in.poses.empty()) refuseEmpty(path, TrajectoryFormat::kitti);
  if (in.poses.size() != stamps.size()) {
    throw ParseError(path, 0, 0,
                     "has " + std::to_string(in.poses.size()) + " poses, but " + stamps_source +
                         " has " + std::to_string(stamps.size()) + " times, expected as many");
  }
  for (std::size_t i = 0; i < stamps.size(); ++i) in.poses[i].stamp = stamps[i];
  return ordered(path, std::move(in), DuplicateStamps::refuse);
}

}  // namespace detail

inline TrajectoryFormat detectTrajectoryFormat(const std::string& text, const std::string& source) {
  detail::FieldReader in(text, source, detail::expectedLine(TrajectoryFormat::any));
  if (!in.nextLine()) detail::refuseEmpty(source, TrajectoryFormat::any);
  return detail::formatOf(in, text, StampUnit::seconds);
}

inline Trajectory parseTrajectory(const std::string& text, const std::string& source,
                                  const TrajectoryFileOptions& options) {
  TrajectoryFormat format = options.format;
  if (format == TrajectoryFormat::any) {
    detail::FieldReader in(text, source, detail::expectedLine(format));
    if (in.nextLine()) format = detail::formatOf(in, text, options.tum_stamps);
  }
  detail::PoseLines lines = detail::readLines(text, source, format, options.tum_stamps);
  if (lines.poses.empty() && !options.may_be_empty) detail::refuseEmpty(source, options.format);
  return detail::ordered(source, std::move(lines), options.duplicates);
}

inline Trajectory readTrajectory(const std::string& path, const TrajectoryFileOptions& options) {
  return parseTrajectory(detail::readFile(path), path, options);
}

inline Trajectory readTrajectory(std::istream& in, const std::string& source,
                                 const TrajectoryFileOptions& options) {
  return parseTrajectory(detail::textOf(in, source), source, options);
}

inline Trajectory readTumTrajectory(const std::string& path, StampUnit unit) {
  TrajectoryFileOptions options;
  options.format = TrajectoryFormat::tum;
  options.tum_stamps = unit;
  return readTrajectory(path, options);
}

inline Trajectory readEurocTrajectory(const std::string& path) {
  TrajectoryFileOptions options;
  options.format = TrajectoryFormat::euroc;
  return readTrajectory(path, options);
}

inline Trajectory readKittiTrajectory(const std::string& path, const std::string& times_path) {
  return detail::kittiWith(readStamps(times_path), path, times_path);
}

inline Trajectory readKittiTrajectory(const std::string& path,
                                      const std::vector<std::int64_t>& stamps) {
  return detail::kittiWith(stamps, path, "the caller");
}

inline std::vector<std::int64_t> readStamps(const std::string& path) {
  const std::string text = detail::readFile(path);
  detail::FieldReader in(text, path, "a time in seconds");
  std::vector<std::int64_t> stamps;
  while (in.nextLine()) stamps.push_back(in.stamp("seconds", 9));
  return stamps;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_TRAJECTORY_READER_H
