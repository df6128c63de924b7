#include "measure.h"

#include <gslam/geometry/so3.h>

using gslam::Mat3d;
using gslam::Vec2d;
using gslam::Vec3d;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double normOf(const Numbers& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number * number;
  return std::sqrt(sum);
}

double differenceOf(const Numbers& a, double by_a, const Numbers& b, double by_b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = a[i] * by_a - b[i] * by_b;
    sum += difference * difference;
  }
  return std::sqrt(sum);
}

// NaN compares as nothing: it is as wrong as can be.
double finiteOr(double value, double otherwise) {
  return std::isfinite(value) ? value : otherwise;
}

double quantile(std::vector<double>& values, double part) {
  if (values.empty()) return 0;
  const std::size_t at = std::min(
      values.size() - 1, static_cast<std::size_t>(part * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

double degrees(double radians) {
  return radians * 180 / 3.14159265358979323846;
}

// Accurate for small angles, too: from the chord.
double rotationError(const Numbers& model, const gslam::SE3d& truth) {
  const Mat3d r = truth.rotation().matrix();
  double square = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    square += (model[i] - r.values[i]) * (model[i] - r.values[i]);
  }
  return degrees(2 * std::asin(std::min(1.0, std::sqrt(square / 8))));
}

Vec3d translationOf(const Numbers& model) {
  return {model[9], model[10], model[11]};
}

Vec2d mapped(const double* h, const Vec2d& p) {
  const double w = h[6] * p[0] + h[7] * p[1] + h[8];
  return {(h[0] * p[0] + h[1] * p[1] + h[2]) / w, (h[3] * p[0] + h[4] * p[1] + h[5]) / w};
}

// Distance of a point of the second image from its epipolar line.
double epipolarDistance(const double* f, const Vec2d& first, const Vec2d& second) {
  const double a = f[0] * first[0] + f[1] * first[1] + f[2];
  const double b = f[3] * first[0] + f[4] * first[1] + f[5];
  const double c = f[6] * first[0] + f[7] * first[1] + f[8];
  return std::fabs(a * second[0] + b * second[1] + c) / std::hypot(a, b);
}

}  // namespace

double plainDistance(const Numbers& model, const Numbers& truth) {
  return finiteOr(differenceOf(model, 1, truth, 1) / normOf(truth), kInfinity);
}

double scaleFreeDistance(const Numbers& model, const Numbers& truth) {
  const double by_model = 1 / normOf(model), by_truth = 1 / normOf(truth);
  return finiteOr(std::min(differenceOf(model, by_model, truth, by_truth),
                           differenceOf(model, -by_model, truth, by_truth)),
                  kInfinity);
}

double poseDistance(const Numbers& model, const Numbers& truth) {
  Numbers size(truth.begin() + 9, truth.end());
  const double translation = normOf(size);
  Numbers a = model, b = truth;
  for (std::size_t i = 9; i < a.size() && i < 12; ++i) {
    a[i] /= 1 + translation;
    b[i] /= 1 + translation;
  }
  return finiteOr(differenceOf(a, 1, b, 1), kInfinity);
}

void reportErrors(benchmark::State& state, std::vector<double> errors) {
  const auto lost =
      std::count_if(errors.begin(), errors.end(), [](double error) { return !(error <= 1e-6); });
  state.counters["lost"] = 100 * static_cast<double>(lost) / static_cast<double>(errors.size());
  const double most = 1e9;  // without any solution
  state.counters["median"] = std::min(most, quantile(errors, 0.5));
  state.counters["p999"] = std::min(most, quantile(errors, 0.999));
}

Verdict judgeRelativePose(const Numbers& model, const Scene& scene) {
  const double rotation = rotationError(model, scene.pose);
  const Vec3d a = translationOf(model), b = scene.pose.translation();
  const double direction = degrees(std::atan2(a.cross(b).norm(), a.dot(b)));
  return {rotation < 1 && direction < 5, rotation};
}

Verdict judgeAbsolutePose(const Numbers& model, const Scene& scene) {
  const double rotation = rotationError(model, scene.pose);
  // Of the camera's centre: half a degree at the least depth.
  const double distance = (translationOf(model) - scene.pose.translation()).norm();
  return {rotation < 1 && distance < 0.2, rotation};
}

Verdict judgeHomography(const Numbers& model, const Scene& scene) {
  std::vector<double> distances;  // where both cameras look
  for (double u = 20; u < kWidth; u += 40) {
    for (double v = 20; v < kHeight; v += 40) {
      const Vec2d truth = mapped(scene.homography.data(), {u, v});
      if (truth[0] < 0 || truth[0] > kWidth || truth[1] < 0 || truth[1] > kHeight) continue;
      distances.push_back((mapped(model.data(), {u, v}) - truth).norm());
    }
  }
  const double error = quantile(distances, 0.9);
  return {error < 3, error};
}

Verdict judgeFundamental(const Numbers& model, const Scene& scene) {
  // Points of the true geometry at two depths; of the worst one in ten nothing is asked.
  std::vector<double> distances;
  for (double u = 60; u < kWidth; u += 80) {
    for (double v = 60; v < kHeight; v += 80) {
      for (const double depth : {5.0, 9.0}) {
        const Vec3d point = {(u - kCentreX) / kFocal * depth, (v - kCentreY) / kFocal * depth,
                             depth};
        const Vec3d in_second = scene.pose * point;
        if (in_second[2] < 0.5) continue;
        distances.push_back(epipolarDistance(model.data(), {u, v},
                                             {kFocal * in_second[0] / in_second[2] + kCentreX,
                                              kFocal * in_second[1] / in_second[2] + kCentreY}));
      }
    }
  }
  const double error = quantile(distances, 0.9);
  return {error < 3, error};
}

void reportVerdicts(benchmark::State& state, const std::vector<Scene>& all,
                    const std::vector<Found>& found, std::vector<double> seconds, Judge judge) {
  std::size_t right = 0, wrong = 0;
  std::vector<double> errors;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (found[i].model.empty()) continue;  // an honest failure
    const Verdict verdict = judge(found[i].model, all[i]);
    const bool other_is_right = !found[i].other.empty() && judge(found[i].other, all[i]).is_right;
    if (verdict.is_right) errors.push_back(verdict.error);
    ++(verdict.is_right || other_is_right ? right : wrong);
  }
  const double percent = 100 / static_cast<double>(all.size());
  state.counters["right"] = percent * static_cast<double>(right);
  state.counters["wrong"] = percent * static_cast<double>(wrong);
  state.counters["median_ms"] = 1e3 * quantile(seconds, 0.5);
  state.counters["median_error"] = quantile(errors, 0.5);
}
