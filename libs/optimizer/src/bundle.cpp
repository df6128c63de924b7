#include <gslam/optimizer/bundle.h>

namespace gslam {
inline namespace v1 {

BundleProblem Bundle::problem() {
  BundleProblem views;
  views.T_world_body = T_world_body;
  views.pose_fixed = pose_fixed;
  views.points = points;
  views.point_fixed = point_fixed;
  views.cameras = cameras;
  views.camera_freedom = camera_freedom;
  views.T_body_camera = T_body_camera;
  views.observation_pose = observation_pose;
  views.observation_point = observation_point;
  views.observation_camera = observation_camera;
  views.pixels = pixels;
  views.information = information;
  return views;
}

}  // namespace v1
}  // namespace gslam
