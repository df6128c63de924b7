#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "fast_reference.h"

namespace fast_reference {
namespace {

using gslam::Camera;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;
using Long = long double;
using Matrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;

void toLocal(const SE3d& pose, const Long* x, Long* local) {
  const double* const q = pose.data();
  const Long n =
      std::sqrt(Long(q[0]) * q[0] + Long(q[1]) * q[1] + Long(q[2]) * q[2] + Long(q[3]) * q[3]);
  const Long a = q[0] / n, b = q[1] / n, c = q[2] / n, w = q[3] / n;
  const Long r[9] = {1 - 2 * (b * b + c * c), 2 * (a * b - c * w),     2 * (a * c + b * w),
                     2 * (a * b + c * w),     1 - 2 * (a * a + c * c), 2 * (b * c - a * w),
                     2 * (a * c - b * w),     2 * (b * c + a * w),     1 - 2 * (a * a + b * b)};
  for (int i = 0; i < 3; ++i) {
    local[i] = 0;
    for (int k = 0; k < 3; ++k) local[i] += r[3 * k + i] * (x[k] - q[4 + k]);
  }
}

void project(const Camera& camera, const Long* p, Long* pixel) {
  const std::vector<double> c = camera.parameters();
  if (camera.modelName() != "pinhole" && camera.modelName() != "radtan") {
    Vec2d seen{};
    camera.project({double(p[0]), double(p[1]), double(p[2])}, seen);
    pixel[0] = seen[0];
    pixel[1] = seen[1];
    return;
  }
  const auto at = [&](std::size_t i) { return i < c.size() ? Long(c[i]) : Long(0); };
  const Long x = p[0] / p[2], y = p[1] / p[2], s = x * x + y * y;
  const Long g = 1 + s * (at(4) + s * (at(5) + s * at(8)));
  pixel[0] = at(0) * (x * g + 2 * at(6) * x * y + at(7) * (s + 2 * x * x)) + at(2);
  pixel[1] = at(1) * (y * g + at(6) * (s + 2 * y * y) + 2 * at(7) * x * y) + at(3);
}

// h += row^T w row, g += row^T w r, for a row with few elements.
void addSparse(const Matrix& row, const Eigen::Matrix<Long, 2, 2>& w,
               const Eigen::Matrix<Long, 2, 1>& r, Matrix& h, Vector& g) {
  std::vector<Eigen::Index> used;
  for (Eigen::Index c = 0; c < row.cols(); ++c) {
    if (row(0, c) != 0 || row(1, c) != 0) used.push_back(c);
  }
  for (const Eigen::Index a : used) {
    const Eigen::Matrix<Long, 1, 2> left = row.col(a).transpose() * w;
    g(a) += left * r;
    for (const Eigen::Index b : used) h(a, b) += left * row.col(b);
  }
}

bool isFree(gslam::Span<const std::uint8_t> fixed, std::size_t i) {
  return fixed.empty() || fixed[i] == 0;
}

SE3d extrinsic(const BundleProblem& problem, std::size_t camera) {
  return problem.T_body_camera.empty() ? SE3d() : problem.T_body_camera[camera];
}

}  // namespace

long double cost(const BundleProblem& problem, const RobustLoss& loss) {
  Long sum = 0;
  for (std::size_t k = 0; k < problem.pixels.size(); ++k) {
    const std::size_t camera = problem.observation_camera[k];
    const Vec3d& point = problem.points[problem.observation_point[k]];
    const Long world[3] = {point[0], point[1], point[2]};
    Long body[3], local[3], pixel[2];
    toLocal(problem.T_world_body[problem.observation_pose[k]], world, body);
    toLocal(extrinsic(problem, camera), body, local);
    project(problem.cameras[camera], local, pixel);
    const Long u = pixel[0] - problem.pixels[k][0], v = pixel[1] - problem.pixels[k][1];
    Long s = u * u + v * v;
    if (!problem.information.empty()) {
      const Vec3d& w = problem.information[k];
      s = w[0] * u * u + 2 * w[1] * u * v + w[2] * v * v;
    }
    sum += loss.kind == gslam::LossKind::Squared ? s
                                                 : Long(gslam::detail::lossAt(loss, double(s)).rho);
  }
  return sum / 2;
}

void takeStep(const BundleProblem& problem, double damping) {
  const bool bal = !problem.camera_freedom.empty();
  const std::size_t d = bal ? 9 : 6, poses = problem.T_world_body.size();
  const auto n = static_cast<Eigen::Index>(d * poses + 3 * problem.points.size());
  Matrix h = Matrix::Zero(n, n);
  Vector g = Vector::Zero(n);
  for (std::size_t k = 0; k < problem.pixels.size(); ++k) {
    const std::size_t camera = problem.observation_camera[k], pose = problem.observation_pose[k];
    const std::size_t point = problem.observation_point[k];
    gslam::detail::ReprojectionObservation seen;
    seen.pixel = problem.pixels[k];
    Vec3d residual;
    gslam::detail::ReprojectionJacobians j;
    ASSERT_TRUE(gslam::detail::reprojectionResidual(
        problem.T_world_body[pose], extrinsic(problem, camera), problem.cameras[camera],
        problem.points[point], seen, residual, &j));
    Eigen::Matrix<Long, 2, 1> r;
    r << residual[0], residual[1];
    Eigen::Matrix<Long, 2, 2> w = Eigen::Matrix<Long, 2, 2>::Identity();
    if (!problem.information.empty()) {
      const Vec3d& i = problem.information[k];
      w << i[0], i[1], i[1], i[2];
    }
    Matrix row = Matrix::Zero(2, n);
    const std::vector<double> c = problem.cameras[camera].parameters();
    for (std::size_t e = 0; e < 2; ++e) {
      const auto er = static_cast<Eigen::Index>(e);
      const auto set = [&](std::size_t column, double value) {
        row(er, static_cast<Eigen::Index>(column)) = value;
      };
      for (std::size_t i = 0; i < 6 && isFree(problem.pose_fixed, pose); ++i) {
        set(d * pose + i, j.by_pose(e, i));
      }
      for (std::size_t i = 0; i < 3 && isFree(problem.point_fixed, point); ++i) {
        set(d * poses + 3 * point + i, j.by_point(e, i));
      }
      const double* const by_camera = j.by_camera + e * c.size();
      if (!bal || problem.camera_freedom[camera].parameters == 0) continue;
      set(d * pose + 6, by_camera[0] + by_camera[1] * c[1] / c[0]);
      set(d * pose + 7, by_camera[4]);
      set(d * pose + 8, by_camera[5]);
    }
    addSparse(row, w, r, h, g);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    h(i, i) += h(i, i) > 0 ? damping * std::max<Long>(h(i, i), 1e-9L) : 1;
  }
  const Vector x = -h.ldlt().solve(g);
  const auto at = [&](std::size_t i) { return double(x(static_cast<Eigen::Index>(i))); };
  for (std::size_t p = 0; p < poses; ++p) {
    const std::size_t i = d * p;
    const SE3d moved = problem.T_world_body[p] *
                       SE3d::exp({at(i), at(i + 1), at(i + 2), at(i + 3), at(i + 4), at(i + 5)});
    const gslam::Span<SE3d> all = problem.T_world_body;
    if (isFree(problem.pose_fixed, p)) all[p] = moved;
    if (!bal || problem.camera_freedom[p].parameters == 0) continue;
    std::vector<double> c = problem.cameras[p].parameters();
    c[1] = (c[0] + at(i + 6)) * c[1] / c[0];
    c[0] += at(i + 6);
    c[4] += at(i + 7);
    c[5] += at(i + 8);
    const gslam::Span<Camera> cameras = problem.cameras;
    cameras[p] = Camera::fromParameters("radtan", 1000, 1000, c);
  }
  const gslam::Span<Vec3d> points = problem.points;
  for (std::size_t p = 0; p < points.size(); ++p) {
    for (std::size_t i = 0; i < 3; ++i) points[p][i] += at(d * poses + 3 * p + i);
  }
}

namespace {

OptimizerOptions oneStep(double damping) {
  OptimizerOptions options;
  options.max_iterations = 1;
  options.initial_damping = damping;
  options.linear_tolerance = 1e-14;
  options.max_linear_iterations = 300;
  return options;
}

// The largest difference of positions and points.
double distance(const Arrays& a, const Arrays& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    most = std::max(most, (a.points[i] - b.points[i]).norm());
  }
  for (std::size_t i = 0; i < a.T_world_body.size(); ++i) {
    most = std::max(most, (a.T_world_body[i].inverse() * b.T_world_body[i]).log().norm());
  }
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    most = std::max(most,
                    std::fabs(a.cameras[i].parameter("fx") - b.cameras[i].parameter("fx")) / 500);
  }
  return most;
}

void expectStep(const Arrays& start, const Arrays& expected, const OptimizerOptions& options,
                double tolerance) {
  Arrays found = start;
  const OptimizerSummary summary = solve(found, options);
  ASSERT_EQ(summary.iterations.size(), 2U);
  ASSERT_TRUE(summary.iterations[1].is_successful) << summary.message;
  EXPECT_LT(distance(found, expected), tolerance) << summary.linear_solver;
}

void expectSteps(const Arrays& start) {
  using gslam::LinearSolverKind;
  using gslam::PreconditionerKind;
  Arrays expected = start;
  takeStep(expected.problem(), 1e-2);
  for (const auto precision : {gslam::PrecisionKind::Double, gslam::PrecisionKind::Mixed}) {
    const double tolerance = precision == gslam::PrecisionKind::Double ? 1e-7 : 2e-3;
    OptimizerOptions options = oneStep(1e-2);
    options.precision = precision;
    for (const auto kind : {LinearSolverKind::Dense, LinearSolverKind::Sparse}) {
      options.linear_solver = kind;
      expectStep(start, expected, options, tolerance);
    }
    options.linear_solver = LinearSolverKind::Iterative;
    for (const auto schur : {gslam::SchurKind::Explicit, gslam::SchurKind::Implicit}) {
      for (const auto preconditioner :
           {PreconditionerKind::BlockJacobi, PreconditionerKind::SchurJacobi,
            PreconditionerKind::PowerSeries}) {
        options.schur = schur;
        options.preconditioner = preconditioner;
        expectStep(start, expected, options, tolerance);
      }
    }
  }
}

TEST(fast_step, is_that_of_dense_normal_equations_with_six_variables) {
  expectSteps(synthetic_bundle::make(tiny(false)));
}

TEST(fast_step, is_that_of_dense_normal_equations_with_nine_variables) {
  expectSteps(synthetic_bundle::make(tiny(true)));
}

}  // namespace
}  // namespace fast_reference
