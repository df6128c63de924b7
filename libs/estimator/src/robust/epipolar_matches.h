// Matches of two views, and how far they are from what a matrix or a homography says.
#ifndef GSLAM_ESTIMATOR_ROBUST_EPIPOLAR_MATCHES_H
#define GSLAM_ESTIMATOR_ROBUST_EPIPOLAR_MATCHES_H

#include <gslam/base/span.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "robust/kernels.h"
#include "robust/random_order.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// The matches, in the robust loop's order and in coordinates of their own: on planes these are
// pixels, shifted and divided by a common length, otherwise unit bearings. A matrix in these
// coordinates is `second^-1 M first` or, of lines, `second F first` of one between rays; the
// diagonals are all 1 but for pinhole cameras. Immutable.
class EpipolarMatches {
 public:
  EpipolarMatches(EpipolarMatches&&) = default;
  EpipolarMatches(const EpipolarMatches&) = delete;  // column_starts_ point into columns_
  EpipolarMatches& operator=(const EpipolarMatches&) = delete;

  // Points of unknown cameras.
  static EpipolarMatches fromPoints(Span<const Vec2d> first, Span<const Vec2d> second,
                                    const RandomOrder& order);
  // Unit bearings.
  static EpipolarMatches fromBearings(Span<const Vec3d> first, Span<const Vec3d> second,
                                      const RandomOrder& order);
  // Pixels of pinhole cameras, whose images are planes.
  static EpipolarMatches fromPinholes(Span<const Vec2d> first, Span<const Vec2d> second,
                                      const Camera& first_camera, const Camera& second_camera,
                                      const RandomOrder& order);
  // Unit bearings with their derivatives by the pixel.
  static EpipolarMatches fromFrames(Span<const Vec3d> first, Span<const Vec3d> second,
                                    Span<const Mat<double, 3, 2>> first_by_pixel,
                                    Span<const Mat<double, 3, 2>> second_by_pixel,
                                    const RandomOrder& order);

  // Some of the matches, in this order.
  EpipolarMatches picked(const std::vector<std::uint32_t>& indices) const;

  std::size_t size() const { return size_; }
  EpipolarKind kind() const { return kind_; }

  // Of Sampson's error, x2^T F x1 over the norm of its derivative by both observations.
  void squaredFloat(const double* matrix, std::size_t first, std::size_t count,
                    float* squared) const;
  double squared(const double* matrix, std::size_t i) const { return squared(matrix, i, i); }
  // Of the first point of match i and the second one of match j.
  double squared(const double* matrix, std::size_t i, std::size_t j) const;
  void squaredOfPairs(const double* matrix, std::size_t shift, std::size_t count,
                      double* squared) const;
  // Problem::placeOf().
  std::size_t placeOf(std::size_t i, double* place) const;
  // Normal equations by the nine elements of the matrix, of those of the first `count` matches
  // whose weight is positive.
  EpipolarSums sums(const double* matrix, const double* weights, std::size_t count) const;

  // A ray of match i, in the coordinates of the matches.
  Vec3d first(std::size_t i) const;
  Vec3d second(std::size_t i) const;
  // Squared error of x2 ~ H x1, comparable to Sampson's: as if both had been corrected. Infinite
  // where a ray is taken to the other side.
  double transferSquared(const Mat3d& homography, const Mat3d& inverse, std::size_t i) const;

  // Of x2 - H x1 in the second view only, in pixels or radians: up to three numbers, the others 0.
  bool transferResidual(const Mat3d& homography, std::size_t i, double* residual) const;

  // From the coordinates of rays to those of matches.
  Mat3d linesOf(const Mat3d& matrix) const;              // second F first
  Mat3d homographyOf(const Mat3d& matrix) const;         // second^-1 M first
  Mat3d inverseHomographyOf(const Mat3d& matrix) const;  // first^-1 M second
  Vec3d epipoleOf(const Vec3d& direction) const;         // second^-1 t
  // And back: rays of any length.
  Vec3d firstRay(const Vec3d& first) const;
  Vec3d secondRay(const Vec3d& second) const;
  const Vec3d& firstDiagonal() const { return first_; }
  const Vec3d& secondDiagonal() const { return second_; }

  // Of points of unknown cameras: x = (pixel - shift) / length.
  double length() const { return length_; }
  const Vec2d& firstShift() const { return first_shift_; }
  const Vec2d& secondShift() const { return second_shift_; }

  // Probability that two unrelated points are within a threshold of an epipolar line each.
  double chance(double threshold) const;

 private:
  EpipolarMatches(EpipolarKind kind, std::size_t size);
  double* row(std::size_t i) { return rows_.data() + i * width_; }
  const double* row(std::size_t i) const { return rows_.data() + i * width_; }
  void finish();  // once the rows are there

  EpipolarKind kind_;
  std::size_t size_;
  std::size_t width_;  // numbers of a match
  double length_ = 1;  // pixels
  Vec2d first_shift_{}, second_shift_{};
  Vec3d first_{1, 1, 1}, second_{1, 1, 1};
  double chance_per_unit_ = 0;
  std::vector<double> rows_;
  std::vector<float> columns_;
  std::vector<const float*> column_starts_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_EPIPOLAR_MATCHES_H
