#ifndef GSLAM_CORE_TRAJECTORY_FILE_H
#define GSLAM_CORE_TRAJECTORY_FILE_H

#include <gslam/core/stamp.h>
#include <gslam/core/trajectory.h>

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

/// @file
/// Files of trajectories.
///
///     tum    timestamp tx ty tz qx qy qz qw                      seconds
///     kitti  r11 r12 r13 tx r21 r22 r23 ty r31 r32 r33 tz        no stamps
///     euroc  timestamp,px,py,pz,qw,qx,qy,qz[,more numbers]       nanoseconds
///
/// One pose a line; lengths are metres, and the pose takes body (KITTI: left camera) to world
/// coordinates. **EuRoC's quaternions begin with w**, and are turned round by what reads and writes
/// them.
///
/// **Stamps** are exact to the nanosecond on both ways: no double stands in between. **Numbers** of
/// TUM and EuRoC files are read back as they were to the bit, but that the norm of a quaternion is
/// mended as by fromText(); those of KITTI files to about 1e-15, because a matrix stands there.
/// Neither depends on the locale.
///
/// **What readers take.** Blanks, tabs or a comma between numbers, also a comma at the end of a
/// line, lines that end in \\n or \\r\\n, a byte order mark, comments from # on, lines without
/// numbers, and poses in any order of time. EuRoC files have the columns after the pose or not, the
/// same in each line.
///
/// **What they refuse**, with a ParseError that names file, line and column, what was found and
/// what was expected: a file without poses, numbers that are missing, too many, not finite or no
/// numbers, quaternions whose norm is not 1 within kQuaternionTolerance, matrices further than
/// kMatrixTolerance from a rotation, stamps beyond the year 2262 (they say which other unit would
/// fit), and a stamp that two poses have (they name both lines).

namespace gslam {
inline namespace v1 {

/// Formats of trajectories.
enum class TrajectoryFormat : std::uint8_t {
  tum,    ///< of the TUM RGB-D benchmark
  kitti,  ///< of KITTI's odometry benchmark
  euroc,  ///< of EuRoC and others in the ASL layout
  any     ///< what the content shows; not for writing
};

/// Its name, such as "tum"; "unknown" for a number that is no format.
inline const char* trajectoryFormatName(TrajectoryFormat format) noexcept {
  static const char* const kNames[] = {"tum", "kitti", "euroc", "any"};
  const std::size_t i = static_cast<std::size_t>(format);
  return i < 4 ? kNames[i] : "unknown";
}

/// What a reader makes of a stamp that two poses have.
enum class DuplicateStamps : std::uint8_t {
  refuse,      ///< a ParseError
  keep_first,  ///< the first in the file counts; files with rounded stamps, such as fr2/desk's,
               ///< need
  keep_last    ///< the last in the file counts
};

/// How trajectories are read.
struct TrajectoryFileOptions {
  TrajectoryFormat format = TrajectoryFormat::any;       ///< what the file should be
  StampUnit tum_stamps = StampUnit::seconds;             ///< ORB-SLAM3 writes nanoseconds, too
  DuplicateStamps duplicates = DuplicateStamps::refuse;  ///< see there
  bool may_be_empty = false;                             ///< whether a file may have no pose
};

/// How far the norm of a quaternion in a file may be from 1; files with two decimals are nearer.
constexpr double kQuaternionTolerance = 0.02;
/// How far a matrix in a file may be from a rotation, in Frobenius norm; KITTI's are within 1e-6.
/// The nearest rotation is taken.
constexpr double kMatrixTolerance = 1e-3;

/// @{
/// Reads a trajectory.
///
/// The format is found by the first line with numbers: 12 are KITTI (but EuRoC where they have
/// commas and the first is a whole number of 1e15 or more), 8 without commas are TUM, 9 or more
/// with commas are EuRoC. 8 with commas are EuRoC where the stamp is 1e15 or more or a comment has
/// "ns", TUM where the stamp has a point, and else refused, as they are without a point where
/// TrajectoryFileOptions::tum_stamps are not seconds: nobody should guess which number is w.
///
/// KITTI files have no stamps: each pose gets the number of its frame, from 0 on, **which is no
/// time**; readKittiTrajectory() gives them times.
/// @param path     the file
/// @param options  as said there
/// @throws FileError when it cannot be read
/// @throws ParseError as said above
inline Trajectory readTrajectory(const std::string& path,
                                 const TrajectoryFileOptions& options = TrajectoryFileOptions());
/// The same from a stream.
/// @param in       the stream, read to its end
/// @param source   what errors call it
/// @param options  as said there
/// @throws ParseError as said above
inline Trajectory readTrajectory(std::istream& in, const std::string& source,
                                 const TrajectoryFileOptions& options = TrajectoryFileOptions());
/// The same from a text.
/// @param text     all of a file
/// @param source   what errors call it
/// @param options  as said there
/// @throws ParseError as said above
inline Trajectory parseTrajectory(const std::string& text, const std::string& source,
                                  const TrajectoryFileOptions& options = TrajectoryFileOptions());
/// @}

/// The format of a trajectory, as readTrajectory() finds it.
/// @param text, source  as above
/// @throws ParseError when it is none, or cannot be told
inline TrajectoryFormat detectTrajectoryFormat(const std::string& text, const std::string& source);

/// @{
/// Reads a file of one format.
/// @throws FileError, ParseError as above
inline Trajectory readTumTrajectory(const std::string& path, StampUnit unit = StampUnit::seconds);
inline Trajectory readEurocTrajectory(const std::string& path);
/// KITTI's poses with their times.
/// @param path        the poses
/// @param times_path  the times: one a line, in seconds
/// @throws ParseError also when there are more poses than times or fewer
inline Trajectory readKittiTrajectory(const std::string& path, const std::string& times_path);
/// KITTI's poses with given stamps, nanoseconds.
/// @throws ParseError also when there are more poses than stamps or fewer
inline Trajectory readKittiTrajectory(const std::string& path,
                                      const std::vector<std::int64_t>& stamps);
/// @}

/// Reads stamps in seconds, the first number of each line: KITTI's times.txt, or the first column
/// of TUM's rgb.txt.
/// @return nanoseconds, in the order of the file
/// @throws FileError, ParseError as above
inline std::vector<std::int64_t> readStamps(const std::string& path);

/// @{
/// Writes a trajectory. A file appears under its name when it is whole: it is written beside it,
/// and renamed. Links stay, and lead to the new content; pipes and devices are written to.
/// @param path        the file
/// @param trajectory  may be empty
/// @param format      not `any`; KITTI's leaves out the stamps, see writeStamps()
/// @throws FileError when it cannot be written
/// @throws ArgumentError when a pose is not finite
inline void writeTrajectory(const std::string& path, const Trajectory& trajectory,
                            TrajectoryFormat format = TrajectoryFormat::tum);
/// The same into a stream.
/// @param out         the stream
/// @param trajectory  may be empty
/// @param format      as above
/// @throws FileError when it cannot be written, ArgumentError when a pose is not finite
inline void writeTrajectory(std::ostream& out, const Trajectory& trajectory,
                            TrajectoryFormat format = TrajectoryFormat::tum);
/// The same as a text.
/// @param trajectory  may be empty
/// @param format      as above
/// @throws ArgumentError when a pose is not finite
inline std::string printTrajectory(const Trajectory& trajectory,
                                   TrajectoryFormat format = TrajectoryFormat::tum);
/// @}

/// Writes the stamps in seconds, one a line, as KITTI's times.txt.
/// @throws FileError when it cannot be written
inline void writeStamps(const std::string& path, const Trajectory& trajectory);

}  // namespace v1
}  // namespace gslam

#include <gslam/core/detail/trajectory_reader.h>
#include <gslam/core/detail/trajectory_writer.h>

#endif  // GSLAM_CORE_TRAJECTORY_FILE_H
