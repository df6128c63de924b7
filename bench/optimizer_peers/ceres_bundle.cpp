// Bundles by hand with Ceres, analytic derivatives: angle-axis and translation of the world in the
// camera, f, k1, k2.
#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "measure.h"

namespace {

// d (R(w) x) / d w (Gallego, Yezzi, J. Math. Imaging Vis. 51(3), 2015), row by row.
void rotationSlope(const double* w, const double* x, double* slope) {
  const double square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  double rotation[9], minus_hat[9] = {0, x[2], -x[1], -x[2], 0, x[0], x[1], -x[0], 0};
  if (square < 1e-20) {
    std::copy(minus_hat, minus_hat + 9, slope);
    return;
  }
  ceres::AngleAxisToRotationMatrix(w, ceres::RowMajorAdapter3x3(rotation));
  const double hat[9] = {0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0};
  double inner[9], product[9];
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      inner[3 * r + c] = w[r] * w[c];
      for (int k = 0; k < 3; ++k) {
        inner[3 * r + c] += (rotation[3 * k + r] - (r == k)) * hat[3 * k + c];
      }
    }
  }
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      product[3 * r + c] = 0;
      for (int k = 0; k < 3; ++k) product[3 * r + c] += rotation[3 * r + k] * minus_hat[3 * k + c];
    }
  }
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      slope[3 * r + c] = 0;
      for (int k = 0; k < 3; ++k) slope[3 * r + c] += product[3 * r + k] * inner[3 * k + c];
      slope[3 * r + c] /= square;
    }
  }
}

// kCamera 9: f k1 k2 are variables; 6: they are `fixed`.
template <int kCamera>
class Reprojection : public ceres::SizedCostFunction<2, kCamera, 3> {
 public:
  Reprojection(const gslam::Vec2d& pixel, const std::array<double, 3>& fixed)
      : pixel_(pixel), fixed_(fixed) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const double* const camera = parameters[0];
    const double* const lens = kCamera == 9 ? camera + 6 : fixed_.data();
    double p[3];
    ceres::AngleAxisRotatePoint(camera, parameters[1], p);
    for (int i = 0; i < 3; ++i) p[i] += camera[3 + i];
    const double x = p[0] / p[2], y = p[1] / p[2], r2 = x * x + y * y;
    const double f = lens[0], d = 1 + r2 * (lens[1] + r2 * lens[2]);
    residuals[0] = f * d * x - pixel_[0];
    residuals[1] = f * d * y - pixel_[1];
    if (jacobians == nullptr) return true;
    const double slope = 2 * (lens[1] + 2 * lens[2] * r2);
    const double xx = f * (d + slope * x * x), xy = f * slope * x * y;
    const double yy = f * (d + slope * y * y);
    const double by_p[6] = {xx / p[2], xy / p[2], -(xx * x + xy * y) / p[2],
                            xy / p[2], yy / p[2], -(xy * x + yy * y) / p[2]};
    if (jacobians[0] != nullptr) {
      double by_w[9];
      rotationSlope(camera, parameters[1], by_w);
      for (int r = 0; r < 2; ++r) {
        double* const row = jacobians[0] + r * kCamera;
        for (int c = 0; c < 3; ++c) {
          row[c] = 0;
          for (int k = 0; k < 3; ++k) row[c] += by_p[3 * r + k] * by_w[3 * k + c];
          row[3 + c] = by_p[3 * r + c];
        }
        const double flat = r == 0 ? x : y;
        if (kCamera == 9) {
          row[kCamera - 3] = d * flat;
          row[kCamera - 2] = f * r2 * flat;
          row[kCamera - 1] = f * r2 * r2 * flat;
        }
      }
    }
    if (jacobians[1] != nullptr) {
      double rotation[9];
      ceres::AngleAxisToRotationMatrix(camera, ceres::RowMajorAdapter3x3(rotation));
      for (int r = 0; r < 2; ++r) {
        for (int c = 0; c < 3; ++c) {
          jacobians[1][3 * r + c] = 0;
          for (int k = 0; k < 3; ++k) {
            jacobians[1][3 * r + c] += by_p[3 * r + k] * rotation[3 * k + c];
          }
        }
      }
    }
    return true;
  }

 private:
  gslam::Vec2d pixel_;
  std::array<double, 3> fixed_;
};

// Block sizes of Ceres are known when compiling.
template <int kCamera, ceres::LinearSolverType kSolver>
Course solveWith(BundleArrays& arrays, std::size_t iterations) {
  std::vector<Lens> lenses;
  for (const gslam::Camera& camera : arrays.cameras) lenses.push_back(lensOf(camera));
  std::vector<std::array<double, kCamera>> cameras;
  for (std::size_t i = 0; i < arrays.T_world_body.size(); ++i) {
    const gslam::SE3d back = arrays.T_world_body[i].inverse();
    const gslam::Vec3d w = back.rotation().log();
    std::array<double, kCamera> camera{};
    for (std::size_t k = 0; k < 3; ++k) {
      camera[k] = w[k];
      camera[3 + k] = back.translation()[k];
      if (kCamera == 9) camera[kCamera - 3 + k] = lenses[i].numbers[k];
    }
    cameras.push_back(camera);
  }
  ceres::Problem problem;
  for (std::size_t i = 0; i < arrays.pixels.size(); ++i) {
    const Lens& lens = lenses[arrays.observation_camera[i]];
    problem.AddResidualBlock(
        new Reprojection<kCamera>(arrays.pixels[i] - lens.centre, lens.numbers), nullptr,
        cameras[arrays.observation_pose[i]].data(),
        arrays.points[arrays.observation_point[i]].data());
  }
  for (std::size_t i = 0; i < arrays.pose_fixed.size(); ++i) {
    if (arrays.pose_fixed[i] != 0) problem.SetParameterBlockConstant(cameras[i].data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = kSolver;
  options.preconditioner_type = ceres::SCHUR_JACOBI;
  options.num_threads = arrays.points.size() > 2000 ? static_cast<int>(kThreads) : 1;
  options.max_num_iterations = static_cast<int>(iterations);
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 0;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  Course course;
  for (const ceres::IterationSummary& one : summary.iterations) {
    course.add(one.cost, one.cumulative_time_in_seconds);
  }
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::array<double, kCamera>& c = cameras[i];
    setView(arrays, i, {gslam::SO3d::exp({c[0], c[1], c[2]}), {c[3], c[4], c[5]}},
            {c[kCamera - 3], c[kCamera - 2], c[kCamera - 1]});
  }
  return course;
}

template <ceres::LinearSolverType kSolver>
Course solveBundle(BundleArrays& arrays, std::size_t iterations) {
  return hasFreeLenses(arrays) ? solveWith<9, kSolver>(arrays, iterations)
                               : solveWith<6, kSolver>(arrays, iterations);
}

const bool kRows[] = {addBundleRows("ceres", solveBundle<ceres::SPARSE_SCHUR>),
                      addBundleRows("ceres_dense", solveBundle<ceres::DENSE_SCHUR>),
                      addBundleRows("ceres_iterative", solveBundle<ceres::ITERATIVE_SCHUR>)};

}  // namespace
