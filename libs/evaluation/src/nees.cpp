#include <gslam/base/error.h>
#include <gslam/evaluation/align.h>
#include <gslam/evaluation/nees.h>

#include <cmath>

namespace gslam {
inline namespace v1 {
namespace {

using Vec6 = Vec<double, 6>;

// Wilson and Hilferty 1931: the cube root of chi-square is nearly normal.
double chiSquareQuantile(double freedom, double normal_quantile) {
  const double a = 2 / (9 * freedom);
  const double root = 1 - a + normal_quantile * std::sqrt(a);
  return freedom * root * root * root;
}

constexpr double kNormal975 = 1.959963984540054;

// d^T S^-1 d by Cholesky's decomposition; false where S is not positive definite. Rows and columns
// are divided by the standard deviations first, so that units do not matter.
bool squaredError(PoseCovariance s, Vec6 d, double& value) {
  Vec6 deviations;
  for (std::size_t i = 0; i < 6; ++i) {
    if (!(s(i, i) > 0)) return false;
    deviations[i] = std::sqrt(s(i, i));
    d[i] /= deviations[i];
  }
  value = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t c = k; c < 6; ++c) {
      double sum = s(k, c) / (deviations[k] * deviations[c]);
      for (std::size_t i = 0; i < k; ++i) sum -= s(c, i) * s(k, i);  // of the factor, below
      if (c == k && !(sum > 1e-12)) return false;
      s(c, k) = c == k ? std::sqrt(sum) : sum / s(k, k);
    }
  }
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t i = 0; i < k; ++i) d[k] -= s(k, i) * d[i];
    d[k] /= s(k, k);
    value += d[k] * d[k];
  }
  return true;
}

PoseCovariance scaled(PoseCovariance s, double scale) {
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < 6; ++c) {
      if (!std::isfinite(s(r, c))) {
        throw ArgumentError("covariances", "have an element that is not finite");
      }
      s(r, c) *= (r < 3 ? scale : 1) * (c < 3 ? scale : 1);
    }
  }
  return s;
}

void finish(Nees& result) {
  if (result.values.empty()) {
    result.reason = result.singular > 0 ? "no covariance can be inverted" : "there are no poses";
    return;
  }
  const double least = chiSquareQuantile(6, -kNormal975), most = chiSquareQuantile(6, kNormal975);
  std::size_t inside = 0;
  for (const double value : result.values) {
    result.mean += value;
    if (value >= least && value <= most) ++inside;
  }
  const double count = double(result.values.size());
  result.mean /= count;
  result.inside_percent = 100 * double(inside) / count;
  result.least_mean = chiSquareQuantile(6 * count, -kNormal975) / count;
  result.most_mean = chiSquareQuantile(6 * count, kNormal975) / count;
}

}  // namespace

Nees neesOf(const PosePairs& pairs, Span<const PoseCovariance> covariances,
            const SIM3d& S_world_map) {
  if (covariances.size() != pairs.size()) {
    throw ArgumentError("covariances", "are " + std::to_string(covariances.size()) +
                                           ", expected one for each of " +
                                           std::to_string(pairs.size()) + " pairs");
  }
  Nees result;
  result.values.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const SE3d pose = aligned(S_world_map, pairs.estimate[i]);
    const Vec6 error = (pose.inverse() * pairs.reference[i]).log();
    double value = 0;
    if (squaredError(scaled(covariances[i], S_world_map.scale()), error, value)) {
      result.values.push_back(value);
    } else {
      ++result.singular;
    }
  }
  finish(result);
  return result;
}

}  // namespace v1
}  // namespace gslam
