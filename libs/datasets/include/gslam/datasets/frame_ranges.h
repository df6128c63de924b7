#ifndef GSLAM_DATASETS_FRAME_RANGES_H
#define GSLAM_DATASETS_FRAME_RANGES_H

#include <gslam/datasets/export.h>
#include <gslam/svar/svar.h>

#include <string>
#include <vector>

/// @file
/// Parts of a sequence.

namespace gslam {
inline namespace v1 {

/// Frames from the first to the last, both included.
struct FrameRange {
  int first;  ///< from 0
  int last;   ///< not before the first
};

/// Parts of a sequence. As text `100-119,300`: ranges and single frames with commas between them;
/// nothing for none.
struct GSLAM_DATASETS_EXPORT FrameRanges {
  std::vector<FrameRange> ranges;  ///< in any order

  /// Whether one of them has this frame.
  bool contains(int frame) const noexcept;
  /// As text, such as `100-119,300`.
  std::string text() const;
  /// From text.
  /// @throws ArgumentError that names the part that is no range
  static FrameRanges fromText(const std::string& text);
};

/// As text.
template <>
struct SvarTraits<FrameRanges> {
  /// Its text.
  static Svar toSvar(const FrameRanges& from) { return from.text(); }
  /// @throws SvarError where it is no text of ranges
  static FrameRanges fromSvar(const Svar& value) {
    return FrameRanges::fromText(value.as<std::string>());
  }
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_FRAME_RANGES_H
