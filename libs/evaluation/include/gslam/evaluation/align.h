#ifndef GSLAM_EVALUATION_ALIGN_H
#define GSLAM_EVALUATION_ALIGN_H

#include <gslam/base/span.h>
#include <gslam/evaluation/export.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <cstdint>
#include <string>

/// @file
/// The transform that lays an estimate over the reference.

namespace gslam {
inline namespace v1 {

/// What may be changed of an estimate before it is compared.
enum class AlignmentMethod : std::uint8_t {
  none,    ///< nothing: both are in the same world
  origin,  ///< the first pose of the pairs is laid on its partner, with its rotation
  se3,     ///< rotation and translation, by least squares over positions
  sim3,    ///< the same and a scale
  scale,   ///< a scale about the origin of the map; the one that sim3 finds (as evo's
           ///< --correct_scale without --align)
  yaw      ///< rotation about the vertical and translation, where gravity is known
};

/// Its name, such as "se3"; "unknown" for a number that is no method.
GSLAM_EVALUATION_EXPORT const char* alignmentMethodName(AlignmentMethod method) noexcept;

/// How align() works.
struct AlignmentOptions {
  AlignmentMethod method = AlignmentMethod::se3;  ///< see there
  std::size_t first = 0;                          ///< only so many pairs are used; 0: all
  Vec3d up = {{0, 0, 1}};                         ///< vertical of both worlds, for `yaw`
};

/// The options of a text: none, origin, se3, sim3, scale, yaw, or first:N (se3 of the first N).
/// @throws ArgumentError when it is none of these
GSLAM_EVALUATION_EXPORT AlignmentOptions parseAlignment(const std::string& text);
/// The text of options, as parseAlignment() takes it; of others it adds the number, "sim3, first
/// 20".
GSLAM_EVALUATION_EXPORT std::string alignmentText(const AlignmentOptions& options);

/// What align() found.
///
/// Thread-safety: plain data.
struct Alignment {
  bool is_valid = false;     ///< whether there is one
  std::string reason;        ///< why not, and what to do; empty where there is one
  SIM3d S_world_map;         ///< takes the estimate to the world of the reference
  bool is_mirrored = false;  ///< whether a reflection would fit clearly better: an axis of one of
                             ///< the two is turned round
};

/// Aligns an estimate with the reference.
///
/// se3, sim3 and scale are those of S. Umeyama, "Least-squares estimation of transformation
/// parameters between two point patterns", IEEE T-PAMI 13(4), 1991, equations 40 to 43, with the
/// rotation by nearestRotation() (Horn 1987), which is the same and never a reflection. yaw is the
/// best rotation about one axis (Z. Zhang, D. Scaramuzza, "A tutorial on quantitative trajectory
/// evaluation for visual(-inertial) odometry", IROS 2018, section V).
///
/// Refused, with a reason: se3 and sim3 of fewer than 3 pairs or of positions that coincide or lie
/// on a line (the rotation about it is anybody's), and of mirrored ones that leave several
/// rotations as good; yaw of positions that coincide as seen from above; scale of positions that
/// coincide. none and origin always work.
/// @param pairs    one at least
/// @param options  how
/// @throws ArgumentError when there are no pairs, or `up` has no length
GSLAM_EVALUATION_EXPORT Alignment align(const PosePairs& pairs,
                                        const AlignmentOptions& options = {});

/// The same from positions alone; `origin` and `none` are not for them.
/// @param reference  positions in the world, metres
/// @param estimate   the same in the map, as many
/// @param options    how; `first` counts, too
/// @throws ArgumentError when there are none, or not as many of both, or one is not finite
GSLAM_EVALUATION_EXPORT Alignment alignPositions(Span<const Vec3d> reference,
                                                 Span<const Vec3d> estimate,
                                                 const AlignmentOptions& options = {});

/// A pose of the estimate in the world of the reference: rotated, scaled and moved; a pose has no
/// scale itself.
/// @param S_world_map  of an alignment
/// @param T_map_body   pose of the estimate
inline SE3d aligned(const SIM3d& S_world_map, const SE3d& T_map_body) noexcept {
  return SE3d(S_world_map.rotation() * T_map_body.rotation(),
              S_world_map * T_map_body.translation());
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_ALIGN_H
