#ifndef GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_PLACE_SEARCH_H
#define GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_PLACE_SEARCH_H

#include <gslam/core.h>

#include <cstddef>
#include <vector>

#include "matching/matcher.h"
#include "matching/pose_fitter.h"

namespace visual {

/// A keyframe and those that see most of what it sees: a place.
std::vector<gslam::KeyframeId> placeAround(const Scene& scene, gslam::KeyframeId keyframe,
                                           std::size_t most);

/// All points that some keyframes see, each once.
std::vector<gslam::PointId> pointsOf(const Scene& scene,
                                     gslam::Span<const gslam::KeyframeId> keyframes);

/// Looks for the points of a place where they should be, in a wide window and then in a narrow one,
/// and refines the pose by what it finds.
/// @param matches       result: all that fit the pose
/// @param T_world_body  of the view; start and result
/// @return whether there is a pose
bool searchPlace(const View& view, const Scene& scene, gslam::Span<const gslam::PointId> points,
                 ProjectionMatcher& projector, PoseFitter& fitter, std::vector<Match>& matches,
                 gslam::SE3d& T_world_body);

/// In how many of the 36 parts of the image there are matches: those of one thing, such as a poster
/// that hangs elsewhere, too, are in few.
int partsOfImage(const View& view, const Eye& eye, const std::vector<Match>& matches);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_PLACE_SEARCH_H
