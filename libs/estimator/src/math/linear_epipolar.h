// Linear estimates of fundamental and essential matrices, and what makes them valid ones.
#ifndef GSLAM_ESTIMATOR_MATH_LINEAR_EPIPOLAR_H
#define GSLAM_ESTIMATOR_MATH_LINEAR_EPIPOLAR_H

#include <gslam/base/span.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// A shift and a scale: x' = scale (x - centre).
struct PointScale {
  double x, y, scale;

  // To the centre 0 and the mean distance sqrt(2) (Hartley 1997). Scale 1 where all are equal.
  static PointScale of(Span<const Vec2d> points) noexcept;
  Vec3d operator()(const Vec2d& p) const noexcept {
    return {{scale * (p[0] - x), scale * (p[1] - y), 1}};
  }
};

// The fundamental matrix for the points themselves of that for scaled ones, with norm 1. False
// where it is not finite or is zero.
bool unscaleFundamental(const double* scaled, const PointScale& first, const PointScale& second,
                        Mat3d& fundamental) noexcept;

// The M of norm 1 with the least sum of (second^T M first)^2 over at least eight pairs.
class LinearEpipolar {
 public:
  // One more pair.
  void add(const Vec3d& first, const Vec3d& second) noexcept;
  // False where it is not finite.
  bool solve(Mat3d& m) noexcept;

 private:
  static constexpr std::size_t kBlock = 8;
  void reduce() noexcept;

  double triangle_[9][9] = {};  // R of a QR decomposition, column by column
  double block_[9][kBlock];     // rows that wait, column by column
  std::size_t waiting_ = 0;
};

// The nearest matrix of rank 2 in Frobenius norm: the least singular value becomes 0.
void makeRankTwo(Mat3d& m) noexcept;

// The essential matrix next to m in Frobenius norm up to scale, with the singular values 1, 1, 0.
// False where m has rank 1 or less or is not finite.
bool makeEssential(Mat3d& m) noexcept;

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_LINEAR_EPIPOLAR_H
