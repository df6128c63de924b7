// Datasets of several sequences, whose frames are numbered.
#ifndef GSLAM_DATASETS_SRC_FORMATS_SEQUENCES_H
#define GSLAM_DATASETS_SRC_FORMATS_SEQUENCES_H

#include <gslam/core/frame.h>
#include <gslam/svar/svar.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "../reading/decode.h"
#include "../reading/file_tree.h"
#include "../reading/second.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// The folder of the sequence that a user means, of those of a format's Layout.
/// @param parameters     `sequence`: its path below the root, its name, or the number in that ("6"
///   is "06" and "seq-06"); null or "": the only one that there is
/// @param expected       what a sequence has, for errors
/// @param number_behind  what stands before the number in a name
/// @throws FileError when there is none, ArgumentError when several are meant, which it lists, or
///   there is none of that name
std::string chooseSequence(const FileTree& tree, const std::string& format, const Svar& parameters,
                           const std::string& expected, const std::string& number_behind = "");

/// The first number in a name: 42 of "frame-000042.pose.txt".
/// @return whether there is one, of at most nine digits
bool numberIn(const std::string& name, std::size_t& number);

/// Stamp of a frame where only the rate is known, nanoseconds.
/// @param rate  frames a second
constexpr std::int64_t stampAtRate(std::size_t frame, std::int64_t rate) {
  return (static_cast<std::int64_t>(frame) * kSecond + rate / 2) / rate;
}

/// What an image file is like. Reads it.
ImageShape shapeOfFile(const FileTree& tree, const std::string& file);

/// A camera of that name, whose images a file is one of.
CameraSensor cameraOf(const std::string& name, const Camera& camera);

/// "1 image", "2 images".
std::string countText(std::size_t count, const std::string& thing);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_SEQUENCES_H
