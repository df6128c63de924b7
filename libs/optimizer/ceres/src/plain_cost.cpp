#include "plain_cost.h"

#include <cmath>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

// Of a unit quaternion x y z w.
inline Mat3d rotationOf(const double* q) {
  const double xx = 2 * q[0] * q[0], yy = 2 * q[1] * q[1], zz = 2 * q[2] * q[2];
  const double xy = 2 * q[0] * q[1], xz = 2 * q[0] * q[2], yz = 2 * q[1] * q[2];
  const double xw = 2 * q[0] * q[3], yw = 2 * q[1] * q[3], zw = 2 * q[2] * q[3];
  return {1 - yy - zz, xy - zw,     xz + yw,  //
          xy + zw,     1 - xx - zz, yz - xw,  //
          xz - yw,     yz + xw,     1 - xx - yy};
}

inline Vec3d timesTransposed(const Mat3d& m, const Vec3d& v) {
  return {m(0, 0) * v[0] + m(1, 0) * v[1] + m(2, 0) * v[2],
          m(0, 1) * v[0] + m(1, 1) * v[1] + m(2, 1) * v[2],
          m(0, 2) * v[0] + m(1, 2) * v[1] + m(2, 2) * v[2]};
}

// The derivative by a number of the lens: where it is in the image, and by the coefficients.
inline Vec2d byNumber(const PlainLens& lens, const Vec2d& image,
                      const Mat<double, 2, 5>& by_coefficients, std::size_t number) {
  switch (number) {
    case 0:
      return {image[0], lens.aspect * image[1]};
    case 1:
      return {0, image[1]};
    case 2:
      return {1, 0};
    case 3:
      return {0, 1};
    default:
      return {lens.focal[0] * by_coefficients(0, number - 4),
              lens.focal[1] * by_coefficients(1, number - 4)};
  }
}

}  // namespace

bool isPlain(const BundleVariables& variables, std::size_t index, const ObservationBlocks& blocks) {
  const BundleProblem& problem = variables.problem();
  const bool has_right = !problem.right_u.empty() && !std::isnan(problem.right_u[index]);
  return variables.lens(variables.cameraOf(index)).is_plain && !has_right && blocks.pose == 0 &&
         blocks.point == 1 && blocks.blocks[1].ambient == 3 && blocks.extrinsic < 0;
}

void PlainCost::set(const BundleVariables& variables, std::size_t index,
                    const ObservationBlocks& blocks) {
  const BundleProblem& problem = variables.problem();
  lens_ = &variables.lens(variables.cameraOf(index));
  pixel_ = problem.pixels[index];
  if (!problem.information.empty()) information_ = &problem.information[index];
  pose_size_ = blocks.blocks[0].ambient;
  set_num_residuals(2);
  std::vector<std::int32_t>& sizes = *mutable_parameter_block_sizes();
  sizes.resize(static_cast<std::size_t>(blocks.count));
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = blocks.blocks[i].ambient;
}

// What residuals and derivatives have in common.
struct PlainCost::Seen {
  Mat3d rotation;  // of the pose
  Vec3d in_body{};
  double inverse = 0;  // of the depth in the camera
  Vec2d flat{}, image{};
  Mat2d by_flat;
  Mat<double, 2, 5> by_coefficients;
  PixelRoot root;
};

inline bool PlainCost::see(const double* pose, const double* x, bool wants_slope,
                           Seen& seen) const {
  const PlainLens& lens = *lens_;
  seen.rotation = rotationOf(pose);
  seen.in_body = timesTransposed(seen.rotation, {x[0] - pose[4], x[1] - pose[5], x[2] - pose[6]});
  const Vec3d in_camera =
      lens.is_at_body ? seen.in_body : lens.rotation_back * seen.in_body + lens.translation_back;
  if (!lens.is_possible || !(in_camera[2] != 0)) return false;
  seen.inverse = 1 / in_camera[2];
  seen.flat = {in_camera[0] * seen.inverse, in_camera[1] * seen.inverse};
  const bool wants_lens = wants_slope && lens.column_count > 0;
  return distortEverywhere(lens.coefficients, seen.flat, seen.image,
                           wants_slope ? &seen.by_flat : nullptr,
                           wants_lens ? &seen.by_coefficients : nullptr);
}

inline void PlainCost::setByPoseAndPoint(const Seen& seen, double* by_pose,
                                         double* by_point) const {
  const PlainLens& lens = *lens_;
  const double fx = lens.focal[0] * seen.inverse, fy = lens.focal[1] * seen.inverse;
  Mat<double, 2, 3> slope;  // by the point in the camera, then in the body
  for (std::size_t i = 0; i < 2; ++i) {
    slope(0, i) = fx * seen.by_flat(0, i);
    slope(1, i) = fy * seen.by_flat(1, i);
    seen.root.apply(slope(0, i), slope(1, i));
  }
  slope(0, 2) = -(slope(0, 0) * seen.flat[0] + slope(0, 1) * seen.flat[1]);
  slope(1, 2) = -(slope(1, 0) * seen.flat[0] + slope(1, 1) * seen.flat[1]);
  if (!lens.is_at_body) slope = slope * lens.rotation_back;
  const Vec3d& p = seen.in_body;
  const auto width = static_cast<std::size_t>(pose_size_);
  for (std::size_t r = 0; r < 2; ++r) {
    const double a = slope(r, 0), b = slope(r, 1), c = slope(r, 2);
    if (by_pose != nullptr) {
      double* const row = by_pose + r * width;
      row[0] = -a;
      row[1] = -b;
      row[2] = -c;
      row[3] = b * p[2] - c * p[1];
      row[4] = c * p[0] - a * p[2];
      row[5] = a * p[1] - b * p[0];
      row[width - 1] = 0;
    }
    for (std::size_t i = 0; i < 3 && by_point != nullptr; ++i) {
      by_point[3 * r + i] =
          a * seen.rotation(i, 0) + b * seen.rotation(i, 1) + c * seen.rotation(i, 2);
    }
  }
}

inline void PlainCost::setByLens(const Seen& seen, double* to, std::size_t stride) const {
  for (std::size_t i = 0; i < lens_->column_count; ++i) {
    Vec2d by_number = byNumber(*lens_, seen.image, seen.by_coefficients, lens_->columns[i]);
    seen.root.apply(by_number[0], by_number[1]);
    to[i] = by_number[0];
    to[stride + i] = by_number[1];
  }
}

bool PlainCost::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  const PlainLens& lens = *lens_;
  Seen seen;
  if (!see(parameters[0], parameters[1], jacobians != nullptr, seen)) return false;
  residuals[0] = lens.focal[0] * seen.image[0] + lens.focal[2] - pixel_[0];
  residuals[1] = lens.focal[1] * seen.image[1] + lens.focal[3] - pixel_[1];
  if (information_ != nullptr) {
    seen.root = PixelRoot(*information_);
    seen.root.apply(residuals[0], residuals[1]);
  }
  if (!(std::isfinite(residuals[0]) && std::isfinite(residuals[1]))) return false;
  if (jacobians == nullptr) return true;
  setByPoseAndPoint(seen, jacobians[0], jacobians[1]);
  if (lens.column_count == 0) return true;
  // Intrinsics stand behind the pose, or in a block of their own.
  if (pose_size_ > ambientSize<SE3d>()) {
    const auto width = static_cast<std::size_t>(pose_size_);
    if (jacobians[0] != nullptr) setByLens(seen, jacobians[0] + 6, width);
  } else if (jacobians[2] != nullptr) {
    setByLens(seen, jacobians[2], lens.column_count);
  }
  return true;
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
