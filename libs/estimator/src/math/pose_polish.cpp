#include <algorithm>
#include <cmath>

#include "math/pnp_small.h"
#include "math/pose_form.h"
#include "math/quaternion.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pnp {
namespace {

// Normal equations of a pose, R exp-left w and t, at one place.
struct PoseNormal {
  double h[6][6] = {};  // the lower triangle
  double g[6] = {};
  double cost = 0;

  // y = R x; p = y + t - o.
  void add(const double* y, const double* p, const double* b) noexcept {
    // Residuals by cross products: of far points with near-parallel bearings all digits count.
    double c[3], e[3], m[3], ye[3];
    cross3(b, p, c);
    cross3(c, b, e);
    cross3(b, y, m);
    cross3(y, e, ye);
    const double along = dot3(b, p);
    cost += dot3(e, e) + (along < 0 ? along * along : 0);
    const double square = dot3(y, y);
    for (int i = 0; i < 3; ++i) {
      g[i] += ye[i];
      g[3 + i] += e[i];
      for (int k = 0; k <= i; ++k) {
        h[i][k] -= y[i] * y[k] + m[i] * m[k];
        if (k < i) h[3 + i][3 + k] -= b[i] * b[k];
      }
      for (int k = 0; k < 3; ++k) h[3 + i][k] += b[i] * m[k];
      h[i][i] += square;
    }
    // Not 1 - z^2, which has fewer digits.
    const double xx = b[0] * b[0], yy = b[1] * b[1], zz = b[2] * b[2];
    h[3][3] += yy + zz, h[4][4] += xx + zz, h[5][5] += xx + yy;
    h[3][1] += y[2], h[3][2] -= y[1];
    h[4][0] -= y[2], h[4][2] += y[0];
    h[5][0] += y[1], h[5][1] -= y[0];
  }
};

// Calls visit(R x, R x + t - o, b) for every ray.
template <class Visit>
void visitRays(const Rays& rays, const PoseFrame& frame, const FramePose& pose,
               Visit visit) noexcept {
  double r[9];
  columnsOfQuaternion(pose.q, r);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    double x[3], b[3], o[3] = {}, y[3], p[3];
    frame.load(rays, i, x, b, o);
    for (int k = 0; k < 3; ++k) {
      y[k] = r[k] * x[0] + r[3 + k] * x[1] + r[6 + k] * x[2];
      p[k] = y[k] + pose.t[k] - o[k];
    }
    visit(y, p, b);
  }
}

double costOfRays(const Rays& rays, const PoseFrame& frame, const FramePose& pose) noexcept {
  double cost = 0;
  visitRays(rays, frame, pose, [&](const double*, const double* p, const double* b) {
    double c[3], e[3];
    cross3(b, p, c);
    cross3(c, b, e);
    const double along = std::min(0.0, dot3(b, p));
    cost += dot3(e, e) + along * along;
  });
  return cost / static_cast<double>(rays.size());
}

// One step of Gauss-Newton from `pose` to `next`, with the cost of `pose`; gives the square of its
// rotation, or a negative number where there is none.
double stepOnRays(const Rays& rays, const PoseFrame& frame, FramePose& pose,
                  FramePose& next) noexcept {
  PoseNormal normal;
  visitRays(rays, frame, pose,
            [&](const double* y, const double* p, const double* b) { normal.add(y, p, b); });
  pose.cost = normal.cost / static_cast<double>(rays.size());
  double step[1][6];
  for (int i = 0; i < 6; ++i) step[0][i] = -normal.g[i];
  if (!solveSymmetric<6, 1>(normal.h, 0, step)) return -1;
  next = pose;
  if (!turnBy({{step[0][0], step[0][1], step[0][2]}}, next.q)) return -1;
  for (int i = 0; i < 3; ++i) next.t[i] += step[0][3 + i];
  return dot3(step[0], step[0]);
}

}  // namespace

void polish(const Rays& rays, const PoseFrame& frame, FramePose& pose) noexcept {
  for (int pass = 0; pass < 6; ++pass) {
    FramePose next;
    const double square = stepOnRays(rays, frame, pose, next);
    if (square < 0) return;
    next.cost = costOfRays(rays, frame, next);
    if (!(next.cost <= pose.cost * (1 + 1e-12))) return;
    const bool is_done = next.cost > 0.5 * pose.cost || square < 1e-22;
    pose = next;
    if (is_done) return;
  }
}

}  // namespace pnp
}  // namespace detail
}  // namespace v1
}  // namespace gslam
