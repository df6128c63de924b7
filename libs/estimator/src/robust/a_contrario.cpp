#include "robust/a_contrario.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

constexpr double kLog10E = 0.43429448190325182765;

// ln n!, by Stirling's series from 10 on, with an error below 1e-15 of it. (std::lgamma writes a
// global variable.)
double logFactorial(std::size_t n) {
  if (n < 10) {
    double product = 1;
    for (std::size_t i = 2; i <= n; ++i) product *= static_cast<double>(i);
    return std::log(product);
  }
  const double x = static_cast<double>(n) + 1;
  const double r = 1 / (x * x);
  const double series =
      (1.0 / 12 - r * (1.0 / 360 - r * (1.0 / 1260 - r * (1.0 / 1680 - r / 1188)))) / x;
  return (x - 0.5) * std::log(x) - x + 0.91893853320467274178 + series;
}

// ln of the probability that exactly k of n happen, 0 < p < 1.
double logBinomialTerm(std::size_t n, std::size_t k, double p) {
  return logFactorial(n) - logFactorial(k) - logFactorial(n - k) +
         static_cast<double>(k) * std::log(p) + static_cast<double>(n - k) * std::log1p(-p);
}

// The sum of the terms from k on upwards, or downwards, as a multiple of term k. They fall.
double sumOfFallingTerms(std::size_t n, std::size_t k, double odds, bool upwards) {
  double sum = 1, term = 1;
  while (upwards ? k < n : k > 0) {
    const double i = static_cast<double>(k), rest = static_cast<double>(n - k);
    term *= upwards ? rest / (i + 1) * odds : i / (rest + 1) / odds;
    sum += term;
    if (term < 1e-17 * sum) break;
    upwards ? ++k : --k;
  }
  return sum;
}

}  // namespace

double log10Binomial(std::size_t n, std::size_t k) {
  return kLog10E * (logFactorial(n) - logFactorial(k) - logFactorial(n - k));
}

double log10BinomialTail(std::size_t n, std::size_t k, double p) {
  if (k == 0 || p >= 1) return 0;
  if (k > n) return -std::numeric_limits<double>::infinity();
  p = std::max(p, 1e-300);  // NaN and what is negative, too
  if (!(p < 1)) return 0;
  const double odds = p / (1 - p);
  if (static_cast<double>(k) > p * static_cast<double>(n)) {
    return kLog10E * (logBinomialTerm(n, k, p) + std::log(sumOfFallingTerms(n, k, odds, true)));
  }
  // Below the mean it is near 1, and the other end is summed.
  const double below =
      std::exp(logBinomialTerm(n, k - 1, p)) * sumOfFallingTerms(n, k - 1, odds, false);
  return kLog10E * std::log1p(-std::min(below, 1 - 1e-16));
}

double FalseAlarms::log10Expected(std::size_t inliers, double chance) const {
  const std::size_t beyond = inliers > sample_size ? inliers - sample_size : 0;
  return log10Binomial(matches, sample_size) +
         std::log10(static_cast<double>(solutions) * thresholds) +
         log10BinomialTail(matches - sample_size, beyond, chance);
}

std::size_t FalseAlarms::fewestInliers(double chance, double log10_limit) const {
  std::size_t low = sample_size, high = matches + 1;  // the answer is in (low, high]
  if (log10Expected(low, chance) < log10_limit) return low;
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (log10Expected(middle, chance) < log10_limit ? high : low) = middle;
  }
  return high;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
