#include "math/triangle_pose.h"

#include <cmath>

#include "math/solve_linear.h"
#include "math/tangents.h"

namespace gslam {
inline namespace v1 {
namespace detail {
// The three distances of nearly collinear points say next to nothing of the turn about their line:
// its error is epsilon / h^2, h the height of the triangle. That the points lie on their rays says
// it to epsilon / h. So Newton's method on those equations, in the rotation and the depth of corner
// 0: tangents_i . (R side_i + depth ray_0 + offset_i) = 0 for the corners 1 and 2.
bool FlatTriangle::refine(Quaternion& q, double& depth) const {
  Vec3d tangents[2][2];
  for (std::size_t i = 0; i < 2; ++i) tangentsOf(rays[i + 1], tangents[i][0], tangents[i][1]);
  double last = 1;
  for (int step = 0; step < 8; ++step) {
    double m[4][5];
    double error = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3d side = turned(q, sides[i]);
      const Vec3d p = mixOf(1, mixOf(1, side, depth, rays[0]), 1, offsets[i]);
      for (std::size_t j = 0; j < 2; ++j) {
        const Vec3d turn = side.cross(tangents[i][j]);  // tangent . (w x side) = w . turn
        double(&row)[5] = m[2 * i + j];
        for (std::size_t k = 0; k < 3; ++k) row[k] = turn[k];
        row[3] = tangents[i][j].dot(rays[0]);
        row[4] = -tangents[i][j].dot(p);
        error += std::fabs(row[4]);
      }
    }
    double x[4];
    // What rounding leaves of the points' coordinates.
    const bool is_met = error < 1e-12 * (1 + std::fabs(depth));
    if (!solveLinear(m, x)) return is_met;
    const double length = std::fabs(x[0]) + std::fabs(x[1]) + std::fabs(x[2]) + std::fabs(x[3]);
    if (!(length < last)) return is_met;  // it no longer converges
    last = length;
    if (!turnBy({{x[0], x[1], x[2]}}, q)) return false;
    depth += x[3];
    if (length < 1e-9) return true;  // the square of it is below rounding
  }
  return false;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
