#include <gslam/base/error.h>
#include <gslam/evaluation/rpe.h>
#include <gslam/geometry/distance.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <locale>
#include <sstream>

#include "motion.h"

namespace gslam {
inline namespace v1 {
namespace {

constexpr const char* kUnitNames[] = {"f", "m", "s", "deg"};

void checkOptions(const RpeOptions& options, bool is_numbered) {
  if (!(options.delta > 0) || !std::isfinite(options.delta)) {
    throw ArgumentError("delta", "is " + rpeText(options) + ", expected a finite one above 0");
  }
  if (options.unit == DeltaUnit::frames && options.delta != std::floor(options.delta)) {
    throw ArgumentError("delta", "is " + rpeText(options) + ", expected a whole number of frames");
  }
  if (!(options.tolerance >= 0)) {
    throw ArgumentError("tolerance",
                        "is " + std::to_string(options.tolerance) + ", expected 0 or more");
  }
  if (options.unit == DeltaUnit::seconds && is_numbered) {
    throw ArgumentError("delta", "is " + rpeText(options) +
                                     ", but the stamps number frames and are no times; say them by "
                                     "--times, or measure by frames or metres");
  }
}

std::vector<PairRange> rangesOfFrames(std::size_t count, double delta, bool all_pairs) {
  std::vector<PairRange> ranges;
  if (!(delta < double(count))) return ranges;
  const auto frames = static_cast<std::size_t>(delta);
  for (std::size_t i = 0; i + frames < count; i += all_pairs ? 1 : frames) {
    ranges.push_back({i, i + frames});
  }
  return ranges;
}

// How far each pair is on the way of the reference, ascending.
std::vector<double> marksOf(const PosePairs& pairs, DeltaUnit unit) {
  if (unit == DeltaUnit::metres) return evaluation::lengthsOf(pairs);
  std::vector<double> marks(pairs.size(), 0);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    // Ascending, so that the difference fits, however far apart.
    const std::uint64_t step = std::uint64_t(pairs.stamps[i]) - std::uint64_t(pairs.stamps[i - 1]);
    marks[i] =
        marks[i - 1] + (unit == DeltaUnit::seconds
                            ? 1e-9 * double(step)
                            : evaluation::kDegrees * angleBetween(pairs.reference[i - 1].rotation(),
                                                                  pairs.reference[i].rotation()));
  }
  return marks;
}

std::vector<PairRange> consecutiveRanges(const std::vector<double>& marks, double delta) {
  std::vector<PairRange> ranges;
  std::size_t first = 0;
  // Sums of steps that are exact in the file are not exact here.
  const double enough = delta * (1 - 1e-9);
  for (std::size_t i = 1; i < marks.size(); ++i) {
    if (marks[i] - marks[first] < enough) continue;
    ranges.push_back({first, i});
    first = i;
  }
  return ranges;
}

std::vector<PairRange> allRanges(const std::vector<double>& marks, double delta, double slack) {
  std::vector<PairRange> ranges;
  std::size_t j = 1;
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    j = std::max(j, i + 1);
    while (j + 1 < marks.size() && marks[j] - marks[i] < delta) ++j;
    std::size_t nearest = j;
    if (j > i + 1 &&
        std::fabs(marks[j - 1] - marks[i] - delta) <= std::fabs(marks[j] - marks[i] - delta)) {
      nearest = j - 1;
    }
    while (nearest > i + 1 && marks[nearest - 1] == marks[nearest]) --nearest;
    if (std::fabs(marks[nearest] - marks[i] - delta) <= slack) ranges.push_back({i, nearest});
  }
  return ranges;
}

}  // namespace

RpeOptions parseRpe(const std::string& text) {
  RpeOptions options;
  std::string rest = text;
  const std::string all = ":all";
  if (rest.size() > all.size() && rest.compare(rest.size() - all.size(), all.size(), all) == 0) {
    options.all_pairs = true;
    rest.resize(rest.size() - all.size());
  }
  const std::size_t end = rest.find_first_not_of("0123456789.");
  const std::string unit = end == std::string::npos ? "" : rest.substr(end);
  std::istringstream number(rest.substr(0, end));
  number.imbue(std::locale::classic());
  const bool is_number = bool(number >> options.delta) && number.peek() == EOF;
  for (std::uint8_t i = 0; is_number && i < 4; ++i) {
    if (unit != kUnitNames[i]) continue;
    options.unit = static_cast<DeltaUnit>(i);
    checkOptions(options, false);
    return options;
  }
  throw ArgumentError("rpe", "is '" + text +
                                 "', expected a number with a unit f, m, s or deg, and :all for "
                                 "all pairs: 1f, 10f:all, 5m, 2s, 10deg");
}

std::string rpeText(const RpeOptions& options) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  const auto unit = static_cast<std::size_t>(options.unit);
  out << options.delta << (unit < 4 ? kUnitNames[unit] : "?") << (options.all_pairs ? ":all" : "");
  return out.str();
}

std::vector<PairRange> rangesOf(const PosePairs& pairs, const RpeOptions& options) {
  checkOptions(options, pairs.is_numbered);
  if (options.unit == DeltaUnit::frames) {
    return rangesOfFrames(pairs.size(), options.delta, options.all_pairs);
  }
  const std::vector<double> marks = marksOf(pairs, options.unit);
  if (!options.all_pairs) return consecutiveRanges(marks, options.delta);
  return allRanges(marks, options.delta, options.tolerance * options.delta);
}

PoseErrors relativeErrors(const PosePairs& pairs, Span<const PairRange> ranges, double scale) {
  PoseErrors errors;
  errors.translation.reserve(ranges.size());
  errors.rotation.reserve(ranges.size());
  errors.full.reserve(ranges.size());
  for (const PairRange& range : ranges) {
    if (range.first >= pairs.size() || range.last >= pairs.size()) {
      throw ArgumentError("ranges", "have one from " + std::to_string(range.first) + " to " +
                                        std::to_string(range.last) + ", outside of " +
                                        std::to_string(pairs.size()) + " pairs");
    }
    evaluation::addError(evaluation::motionError(pairs, range.first, range.last, scale), errors);
  }
  return errors;
}

}  // namespace v1
}  // namespace gslam
