// Rotations between two sets of vectors.
#ifndef GSLAM_ESTIMATOR_MATH_ROTATION_FIT_H
#define GSLAM_ESTIMATOR_MATH_ROTATION_FIT_H

#include <gslam/base/span.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

namespace gslam {
inline namespace v1 {
namespace detail {

// The rotation of a matrix that is one but for rounding.
SO3d rotationOf(const Mat3d& m) noexcept;

// The R with the largest trace of R^T m, for m the sum of b a^T: the one with the least sum of
// |b - R a|^2. `bound` is no less than that trace and best near it: the root of the product of the
// sums of |a|^2 and |b|^2. False where there is no such R, or more than one.
bool fitRotation(const Mat3d& m, double bound, SO3d& rotation);

// The same where the a are in one plane, and the b as well: m is the sum over i and j of
// moment(i, j) b_i a_j^T for two pairs of vectors, and the moment has a determinant above 0.
// False where a pair is collinear.
bool fitPlanarRotation(const Vec3d (&a)[2], const Vec3d (&b)[2], const Mat<double, 2, 2>& moment,
                       SO3d& rotation, double& trace);

// Two sets of three or more points turned onto each other about their means.
struct Alignment {
  // Without weights all points count alike. False where the rotation is not unique.
  bool compute(Span<const Vec3d> first, Span<const Vec3d> second, Span<const double> weights);

  SO3d rotation;  // R_second_first
  Vec3d mean_first{};
  Vec3d mean_second{};
  double trace = 0;         // weighted sum of b^T R a, a and b being points less their means
  double square_first = 0;  // weighted sum of |a|^2

 private:
  bool computeOfThree(const Vec3d* first, const Vec3d* second, const double* weights);
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_ROTATION_FIT_H
