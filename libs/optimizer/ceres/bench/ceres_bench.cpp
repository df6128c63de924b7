// What the facade costs over Ceres written by hand: the same bundle adjustment (BAL 49-7776 of
// GSLAM_TEST_DATA), the same number of steps and linear solver, everything from the arrays to the
// result, one thread. By hand: analytic derivatives, angle-axis cameras without a manifold, points
// first. `ratio` is what counts: the facade is to cost no more than 1.05.
#include <benchmark/benchmark.h>
#include <ceres/ceres.h>
#include <gslam/optimizer.h>
#include <gslam/optimizer/files/bal.h>
#include <gslam/optimizer_ceres.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace {

using gslam::Vec2d;
using gslam::Vec3d;

// (rotation vector, translation, f, k1, k2); p = R X + t seen at f g(|m|^2) m, m = p / p_z.
struct HandCamera {
  double values[9];
};

// Free numbers of a camera: all 9, or the 6 of its pose.
template <int Free>
class HandCost : public ceres::SizedCostFunction<2, Free, 3> {
 public:
  HandCost(const Vec2d& pixel, const double* fixed) : u_(pixel[0]), v_(pixel[1]), fixed_(fixed) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const double* const c = parameters[0];
    const double* const lens = Free == 9 ? c + 6 : fixed_;
    const double* const X = parameters[1];
    const double w0 = c[0], w1 = c[1], w2 = c[2];
    const double square = w0 * w0 + w1 * w1 + w2 * w2;
    double a = 1, b = 0.5, d = 1.0 / 6, cosine = 1;  // sin t / t, (1 - cos t) / t^2, ...
    if (square > 1e-16) {
      const double t = std::sqrt(square), sine = std::sin(t);
      cosine = std::cos(t);
      a = sine / t;
      b = (1 - cosine) / square;
      d = (1 - a) / square;
    }
    const double R[9] = {cosine + b * w0 * w0, b * w0 * w1 - a * w2, b * w0 * w2 + a * w1,
                         b * w0 * w1 + a * w2, cosine + b * w1 * w1, b * w1 * w2 - a * w0,
                         b * w0 * w2 - a * w1, b * w1 * w2 + a * w0, cosine + b * w2 * w2};
    const double q[3] = {R[0] * X[0] + R[1] * X[1] + R[2] * X[2],
                         R[3] * X[0] + R[4] * X[1] + R[5] * X[2],
                         R[6] * X[0] + R[7] * X[1] + R[8] * X[2]};
    const double inverse = 1 / (q[2] + c[5]);
    const double x = (q[0] + c[3]) * inverse, y = (q[1] + c[4]) * inverse;
    const double s = x * x + y * y;
    const double f = lens[0], k1 = lens[1], k2 = lens[2];
    const double g = 1 + s * (k1 + s * k2);
    residuals[0] = f * g * x - u_;
    residuals[1] = f * g * y - v_;
    if (jacobians == nullptr) return true;
    const double slope = 2 * (k1 + 2 * k2 * s), mixed = f * slope * x * y;
    const double gx = f * (g + slope * x * x), gy = f * (g + slope * y * y);
    const double P[6] = {gx * inverse,    mixed * inverse, -(gx * x + mixed * y) * inverse,
                         mixed * inverse, gy * inverse,    -(mixed * x + gy * y) * inverse};
    if (jacobians[0] != nullptr) {
      // d (R X) / d w = -hat(R X) J_l, J_l = a I + b hat(w) + d w w^T.
      const double J[9] = {a + d * w0 * w0,      d * w0 * w1 - b * w2, d * w0 * w2 + b * w1,
                           d * w0 * w1 + b * w2, a + d * w1 * w1,      d * w1 * w2 - b * w0,
                           d * w0 * w2 - b * w1, d * w1 * w2 + b * w0, a + d * w2 * w2};
      const double distorted[2] = {x, y};
      for (int r = 0; r < 2; ++r) {
        double* const row = jacobians[0] + Free * r;
        const double* const p = P + 3 * r;
        const double h[3] = {p[2] * q[1] - p[1] * q[2], p[0] * q[2] - p[2] * q[0],
                             p[1] * q[0] - p[0] * q[1]};  // -p^T hat(q)
        for (int i = 0; i < 3; ++i) {
          row[i] = h[0] * J[i] + h[1] * J[3 + i] + h[2] * J[6 + i];
          row[3 + i] = p[i];
        }
        if (Free == 9) {
          double* const by_lens = row + (Free - 3);
          by_lens[0] = g * distorted[r];
          by_lens[1] = f * s * distorted[r];
          by_lens[2] = f * s * s * distorted[r];
        }
      }
    }
    if (jacobians[1] != nullptr) {
      for (int r = 0; r < 2; ++r) {
        for (int i = 0; i < 3; ++i) {
          jacobians[1][3 * r + i] =
              P[3 * r] * R[i] + P[3 * r + 1] * R[3 + i] + P[3 * r + 2] * R[6 + i];
        }
      }
    }
    return true;
  }

 private:
  double u_, v_;
  const double* fixed_;
};

constexpr int kSteps = 20;
constexpr int kPairs = 7;

const gslam::Bundle& ladybug() {
  static const gslam::Bundle data = [] {
    const char* const folder = std::getenv("GSLAM_TEST_DATA");
    return gslam::readBal(std::string(folder != nullptr ? folder : "../shared/data") +
                          "/bundle_adjustment/problem-49-7776-pre.txt");
  }();
  return data;
}

std::vector<HandCamera> handCameras(const gslam::Bundle& data) {
  std::vector<HandCamera> cameras;
  for (std::size_t i = 0; i < data.T_world_body.size(); ++i) {
    const gslam::SE3d back = data.T_world_body[i].inverse();
    const Vec3d w = back.rotation().log(), t = back.translation();
    const std::vector<double> lens = data.cameras[i].parameters();
    cameras.push_back({{w[0], w[1], w[2], t[0], t[1], t[2], lens[0], lens[4], lens[5]}});
  }
  return cameras;
}

double solveByHand(const gslam::Bundle& data, std::vector<HandCamera> cameras, bool has_free_lens) {
  std::vector<Vec3d> points = data.points;
  ceres::Problem problem;
  for (std::size_t i = 0; i < data.pixels.size(); ++i) {
    double* const camera = cameras[data.observation_camera[i]].values;
    ceres::CostFunction* cost = nullptr;
    if (has_free_lens) {
      cost = new HandCost<9>(data.pixels[i], nullptr);
    } else {
      cost = new HandCost<6>(data.pixels[i], camera + 6);
    }
    problem.AddResidualBlock(cost, nullptr, camera, points[data.observation_point[i]].data());
  }
  ceres::Solver::Options options;
  options.max_num_iterations = kSteps;
  options.function_tolerance = 0;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.logging_type = ceres::SILENT;
  auto* const ordering = new ceres::ParameterBlockOrdering;
  for (Vec3d& point : points) ordering->AddElementToGroup(point.data(), 0);
  for (HandCamera& camera : cameras) ordering->AddElementToGroup(camera.values, 1);
  options.linear_solver_ordering.reset(ordering);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.final_cost;
}

double solveByFacade(const gslam::Bundle& data, bool has_free_lens) {
  gslam::OptimizerOptions options;
  options.backend = "ceres";
  options.max_iterations = kSteps;
  options.function_tolerance = 0;
  options.linear_solver = gslam::LinearSolverKind::Dense;
  gslam::Bundle copy = data;
  if (!has_free_lens) copy.camera_freedom.clear();
  return gslam::optimizeBundle(copy.problem(), options).final_cost;
}

// Seconds of the processor.
template <class Function>
double secondsOf(const Function& function, double& cost) {
  const std::clock_t start = std::clock();
  cost = function();
  return double(std::clock() - start) / double(CLOCKS_PER_SEC);
}

// Both in turn, so that what else the machine does meets both; the best of each counts.
void pairs(benchmark::State& state, bool has_free_lens) {
  const gslam::Bundle& data = ladybug();
  const std::vector<HandCamera> cameras = handCameras(data);
  double facade = 1e9, hand = 1e9, facade_cost = 0, hand_cost = 0;
  for (auto _ : state) {
    for (int i = 0; i < kPairs; ++i) {
      const auto byHand = [&] { return solveByHand(data, cameras, has_free_lens); };
      const auto byFacade = [&] { return solveByFacade(data, has_free_lens); };
      hand = std::min(hand, secondsOf(byHand, hand_cost));
      facade = std::min(facade, secondsOf(byFacade, facade_cost));
    }
    state.SetIterationTime(facade);
  }
  state.counters["by_hand_ms"] = 1e3 * hand;
  state.counters["facade_ms"] = 1e3 * facade;
  state.counters["ratio"] = facade / hand;
  state.counters["cost_ratio"] = facade_cost / hand_cost;
}

BENCHMARK_CAPTURE(pairs, poses_and_points, false)
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pairs, poses_points_and_lenses, true)
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
