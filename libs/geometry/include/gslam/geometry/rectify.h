#ifndef GSLAM_GEOMETRY_RECTIFY_H
#define GSLAM_GEOMETRY_RECTIFY_H

#include <gslam/base/error.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <string>

/// @file
/// Two cameras side by side, turned so that a point has the same row in both images.

namespace gslam {
inline namespace v1 {

/// What rectifyStereo() is asked for.
struct RectifyOptions {
  int width = 0;   ///< columns of the rectified images; 0: as the left camera
  int height = 0;  ///< rows of the rectified images; 0: as the left camera
  /// Focal length of the rectified camera in pixels; 0: the smallest one at which all pixels of
  /// both rectified images are seen
  double focal = 0;
};

/// What rectifyStereo() finds.
struct StereoRectification {
  Mat3d R_rectified_left;   ///< takes left camera to rectified coordinates
  Mat3d R_rectified_right;  ///< takes right camera to rectified coordinates
  /// Pinhole, the same for both images. A point at depth z (along the rectified axis) has the
  /// disparity u_left - u_right = fx baseline / z (v_left - v_right for cameras above each other).
  Camera camera;
  double baseline;   ///< metres: x of the right camera seen from the left one, rectified; y of it
                     ///< where is_vertical; negative where it is on the other side
  bool is_vertical;  ///< the cameras stand above each other: points have the same column
};

namespace detail {

// The rotation half way to R, and from there the shortest one that takes t to its largest axis.
struct RectifyRotations {
  SO3<double> left, right;
  double baseline;
  bool is_vertical;

  RectifyRotations(const SO3<double>& R_left_right, const Vec3d& t_left_right) {
    const SO3<double> R_half_left = SO3<double>::exp(R_left_right.log() * -0.5);
    const Vec3d t = R_half_left * t_left_right;
    is_vertical = std::fabs(t[1]) > std::fabs(t[0]);
    const double along = is_vertical ? t[1] : t[0];
    baseline = std::copysign(t.norm(), along);
    const Vec3d axis = is_vertical ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
    const Vec3d to = baseline < 0 ? -axis : axis;
    const Vec3d turn = t.cross(to);
    const double sine = turn.norm();
    const double angle = std::atan2(sine, t.dot(to));
    const SO3<double> align =
        sine > 0 ? SO3<double>::exp(turn * (angle / sine)) : SO3<double>::identity();
    left = align * R_half_left;
    right = left * R_left_right;
  }
};

// Where a rectified camera must look, and how wide it may.
class RectifiedView {
 public:
  RectifiedView(const Camera& left, const Camera& right, const StereoRectification& result,
                int width, int height)
      : cameras_{&left, &right},
        R_camera_rectified_{result.R_rectified_left.transpose(),
                            result.R_rectified_right.transpose()},
        size_{double(width), double(height)} {
    Vec2d sum = {0, 0};
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec2d middle = {(cameras_[i]->width() - 1) * 0.5, (cameras_[i]->height() - 1) * 0.5};
      Vec3d bearing;
      if (!cameras_[i]->unproject(middle, bearing)) fail("has no direction for its middle pixel");
      bearing = R_camera_rectified_[i].transpose() * bearing;
      if (!(bearing[2] > 0.1)) fail("looks away from the common axis");
      sum += Vec2d{bearing[0] / bearing[2], bearing[1] / bearing[2]};
    }
    middle_ = sum * 0.5;
  }

  // The pinhole camera that has the mean of both middles in the middle of its image.
  Camera camera(double focal) const {
    const Vec4d parameters = {focal, focal, (size_[0] - 1) * 0.5 - focal * middle_[0],
                              (size_[1] - 1) * 0.5 - focal * middle_[1]};
    return Camera(static_cast<int>(size_[0]), static_cast<int>(size_[1]),
                  PinholeCamera<double>(parameters));
  }

  // The smallest focal length at which the border of the image is seen by both cameras.
  double smallestFocal() const {
    double seen = 1;
    while (!isSeen(camera(seen))) {
      seen *= 2;
      if (seen > 1e9) fail("sees nothing that the other one sees, too");
    }
    double unseen = seen / 2;
    if (isSeen(camera(unseen))) return seen;  // both see half a sphere
    while (seen - unseen > 1e-9 * seen) {
      const double middle = (seen + unseen) / 2;
      (isSeen(camera(middle)) ? seen : unseen) = middle;
    }
    return seen;
  }

 private:
  [[noreturn]] static void fail(const std::string& problem) {
    throw ArgumentError("camera", problem);
  }

  bool isSeen(const Camera& rectified) const {
    const double right = size_[0] - 1, bottom = size_[1] - 1;
    constexpr int kSteps = 64;
    for (int i = 0; i <= kSteps; ++i) {
      const double u = right * i / kSteps, v = bottom * i / kSteps;
      const Vec2d border[] = {{u, 0}, {u, bottom}, {0, v}, {right, v}};
      for (const Vec2d& pixel : border) {
        if (!isSeen(rectified, pixel)) return false;
      }
    }
    return true;
  }

  bool isSeen(const Camera& rectified, const Vec2d& pixel) const {
    Vec3d bearing;
    if (!rectified.unproject(pixel, bearing)) return false;
    for (std::size_t i = 0; i < 2; ++i) {
      Vec2d at;
      if (!cameras_[i]->project(R_camera_rectified_[i] * bearing, at)) return false;
      if (!(at[0] >= 0 && at[0] <= cameras_[i]->width() - 1)) return false;
      if (!(at[1] >= 0 && at[1] <= cameras_[i]->height() - 1)) return false;
    }
    return true;
  }

  const Camera* cameras_[2];
  Mat3d R_camera_rectified_[2];
  Vec2d size_;
  Vec2d middle_;  // on the plane z = 1 of rectified coordinates
};

}  // namespace detail

/// Finds how to turn two cameras of any model, by as little as possible and each by half of it, so
/// that their image planes are one and their rows (or columns) are parallel to the baseline. Then
/// a point has the same row in both. Undistorter makes the images:
///
///     const StereoRectification r = rectifyStereo(left, right, R_left_right, t_left_right);
///     const Undistorter of_left(left, r.camera, r.R_rectified_left.transpose());
///     const Undistorter of_right(right, r.camera, r.R_rectified_right.transpose());
///
/// @param left          left (or upper) camera
/// @param right         right (or lower) camera; the other side is understood, too
/// @param R_left_right  rotation from right to left camera coordinates
/// @param t_left_right  the right camera in left camera coordinates, metres
/// @param options       size and focal length of the result
/// @throws ArgumentError when a camera is none, the baseline is zero or not finite, or the cameras
///   do not look into one direction, across the baseline
///
/// A. Fusiello, E. Trucco, A. Verri, "A compact algorithm for rectification of stereo pairs",
/// Machine Vision and Applications 12, 2000, for the conditions; the rotations are Bouguet's, which
/// share the turn between the cameras, as in OpenCV's stereoRectify.
inline StereoRectification rectifyStereo(const Camera& left, const Camera& right,
                                         const SO3d& R_left_right, const Vec3d& t_left_right,
                                         const RectifyOptions& options = RectifyOptions()) {
  if (!left.isValid()) throw ArgumentError("left", "is no camera");
  if (!right.isValid()) throw ArgumentError("right", "is no camera");
  const double length = t_left_right.norm();
  detail::checkParameter(length > 0 && length <= 1e100, "t_left_right", length,
                         "a baseline with a length above 0");
  detail::checkParameter(options.focal >= 0 && options.focal <= 1e9, "focal", options.focal,
                         "0, or a positive number of pixels");
  const detail::RectifyRotations rotations(R_left_right, t_left_right);
  StereoRectification result;
  result.R_rectified_left = rotations.left.matrix();
  result.R_rectified_right = rotations.right.matrix();
  result.baseline = rotations.baseline;
  result.is_vertical = rotations.is_vertical;
  const int width = options.width != 0 ? options.width : left.width();
  const int height = options.height != 0 ? options.height : left.height();
  const detail::RectifiedView view(left, right, result, width, height);
  result.camera = view.camera(options.focal > 0 ? options.focal : view.smallestFocal());
  return result;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_RECTIFY_H
