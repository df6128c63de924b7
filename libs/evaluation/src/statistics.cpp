#include <gslam/base/error.h>
#include <gslam/evaluation/statistics.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace gslam {
inline namespace v1 {
namespace {

// Reorders the values; those before `from` must be the least already. Percentiles that are asked
// for in ascending order so take less and less time.
double takePercentile(std::vector<double>& values, double part, std::size_t from) {
  const double place = part * double(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto first = values.begin();
  const auto at = first + std::ptrdiff_t(below);
  std::nth_element(first + std::ptrdiff_t(from), at, values.end());
  const double rest = place - double(below);
  if (rest == 0) return *at;
  const double above = *std::min_element(at + 1, values.end());
  return *at + rest * (above - *at);
}

std::size_t placeBelow(const std::vector<double>& values, double part) {
  return static_cast<std::size_t>(part * double(values.size() - 1));
}

void checkFinite(const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    throw ArgumentError("values", "have number " + std::to_string(i) + " that is not finite");
  }
}

}  // namespace

Statistics statisticsOf(std::vector<double> values) {
  checkFinite(values);
  Statistics result;
  result.count = values.size();
  if (values.empty()) return result;
  const double count = double(values.size());
  double sum = 0;
  for (const double value : values) {
    sum += value;
    result.sse += value * value;
  }
  result.mean = sum / count;
  result.rmse = std::sqrt(result.sse / count);
  double variance = 0;
  for (const double value : values) variance += (value - result.mean) * (value - result.mean);
  result.std = std::sqrt(variance / count);
  const auto ends = std::minmax_element(values.begin(), values.end());
  result.min = *ends.first;
  result.max = *ends.second;
  result.median = takePercentile(values, 0.5, 0);
  result.p90 = takePercentile(values, 0.9, placeBelow(values, 0.5));
  result.p95 = takePercentile(values, 0.95, placeBelow(values, 0.9));
  result.p99 = takePercentile(values, 0.99, placeBelow(values, 0.95));
  return result;
}

double percentile(std::vector<double> values, double part) {
  if (values.empty()) throw ArgumentError("values", "are none, expected one at least");
  if (!(part >= 0 && part <= 1)) {
    throw ArgumentError("part", "is " + std::to_string(part) + ", expected 0 to 1");
  }
  return takePercentile(values, part, 0);
}

}  // namespace v1
}  // namespace gslam
