#ifndef GSLAM_EVALUATION_RPE_H
#define GSLAM_EVALUATION_RPE_H

#include <gslam/base/span.h>
#include <gslam/evaluation/ape.h>
#include <gslam/evaluation/export.h>
#include <gslam/evaluation/pairs.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Relative pose errors: what goes wrong on the way from one pose to a later one.

namespace gslam {
inline namespace v1 {

/// What the way from one pose to the other is measured by; on the reference.
enum class DeltaUnit : std::uint8_t {
  frames,   ///< pairs of poses, in their order
  metres,   ///< length of the way
  seconds,  ///< time
  degrees   ///< sum of the angles from pose to pose
};

/// Which relative errors are measured.
struct RpeOptions {
  double delta = 1;                    ///< length of the way, above 0; frames: a whole number
  DeltaUnit unit = DeltaUnit::frames;  ///< of delta
  bool all_pairs = false;              ///< begin at each pose; otherwise where the last way ended
  double tolerance = 0.1;  ///< of all pairs: most that a way may miss, in parts of delta
};

/// The options of a text: a number, a unit (f, m, s, deg), and `:all` for all pairs: 1f, 10f:all,
/// 5m, 2s, 10deg.
/// @throws ArgumentError when it is none
GSLAM_EVALUATION_EXPORT RpeOptions parseRpe(const std::string& text);
/// The text of options, as parseRpe() takes it.
GSLAM_EVALUATION_EXPORT std::string rpeText(const RpeOptions& options);

/// Two of the pairs, the second after the first.
struct PairRange {
  std::size_t first;  ///< where the way begins
  std::size_t last;   ///< where it ends
};

/// The ways on which relative errors are measured. O(n).
///
/// Frames: i and i + delta, for each i, or for multiples of delta (as evo). Other units, all pairs:
/// for each pose the later one whose distance along the reference is nearest to delta, the first of
/// those, where it misses by the tolerance at most (as evo in metres). Consecutive ones: from the
/// first pose to the first that is delta or more away, and on from there (as evo in degrees; in
/// metres evo leaves out the first way, and goes by the estimate unless told otherwise).
/// @param pairs    poses
/// @param options  what is measured
/// @throws ArgumentError when delta is not above 0 and finite, or in frames not whole; when the
///   tolerance is below 0; and for seconds where stamps are numbers of frames
GSLAM_EVALUATION_EXPORT std::vector<PairRange> rangesOf(const PosePairs& pairs,
                                                        const RpeOptions& options);

/// The relative errors E = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j), with Q of the reference and P of the
/// estimate (Sturm et al. 2012, eq. 1). A rigid alignment does not change them, a scale does. O(n).
/// @param pairs   poses
/// @param ranges  of rangesOf()
/// @param scale   of the alignment
/// @throws ArgumentError when a range is not inside of the pairs
GSLAM_EVALUATION_EXPORT PoseErrors relativeErrors(const PosePairs& pairs,
                                                  Span<const PairRange> ranges, double scale = 1);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_RPE_H
