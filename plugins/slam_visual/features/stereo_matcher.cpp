#include "features/stereo_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "features/window_search.h"
#include "matching/descriptors.h"

namespace visual {
namespace {

constexpr double kRows = 2;     // pixels of its level that a feature may be off its row
constexpr double kBehind = -1;  // least disparity: what is far may seem farther than far
constexpr double kLeastDisparity = 0.01;
constexpr float kMostDistance = (kStrictDistance + kLooseDistance) / 2;
constexpr double kWorst = 1.5 * 1.4;  // times the median difference of pixels

int rowOf(const gslam::Feature& feature, int rows) {
  return std::clamp(int(std::lround(double(feature.pixel[1]))), 0, rows - 1);
}

}  // namespace

void StereoMatcher::match(const StereoSide& left, const StereoSide& right,
                          std::vector<float>& depth, std::vector<float>& right_u) {
  depth.assign(left.features.size(), 0);
  right_u.assign(left.features.size(), std::numeric_limits<float>::quiet_NaN());
  if (left.features.empty() || right.features.empty()) return;
  sortIntoRows(right);
  found_.clear();
  for (std::size_t i = 0; i < left.features.size(); ++i) {
    const std::uint32_t partner = nearestOf(left, i, right);
    Found found;
    if (partner != Nearest::kNone && refine(left, i, right, partner, found)) {
      found_.push_back(found);
    }
  }
  removeWorst();
  for (const Found& found : found_) {
    const double u = double(left.features[found.feature].pixel[0]);
    depth[found.feature] = float(focal_ * baseline_ / double(found.disparity));
    right_u[found.feature] = float(u - double(found.disparity));
  }
}

void StereoMatcher::sortIntoRows(const StereoSide& right) {
  const int rows = right.pyramid.level(0).rows;
  begin_.assign(std::size_t(rows) + 1, 0);
  for (const gslam::Feature& feature : right.features) ++begin_[std::size_t(rowOf(feature, rows))];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  by_row_.resize(right.features.size());
  for (std::size_t i = right.features.size(); i-- > 0;) {
    by_row_[--begin_[std::size_t(rowOf(right.features[i], rows))]] = std::uint32_t(i);
  }
}

std::uint32_t StereoMatcher::nearestOf(const StereoSide& left, std::size_t feature,
                                       const StereoSide& right) {
  const gslam::Feature& seen = left.features[feature];
  const int rows = int(begin_.size()) - 1;
  const double v = double(seen.pixel[1]), u = double(seen.pixel[0]);
  const double farthest_row = kRows * right.pyramid.levels().factor(seen.octave + 1) + 1;
  const int first = std::clamp(int(std::floor(v - farthest_row)), 0, rows);
  const int last = std::clamp(int(std::ceil(v + farthest_row)), -1, rows - 1);
  const double least_u = u - focal_;  // at the depth of a baseline
  candidates_.clear();
  if (first > last) return Nearest::kNone;
  for (std::uint32_t k = begin_[std::size_t(first)]; k < begin_[std::size_t(last) + 1]; ++k) {
    const gslam::Feature& other = right.features[by_row_[k]];
    if (std::abs(other.octave - seen.octave) > 1) continue;
    const double other_u = double(other.pixel[0]);
    if (other_u > u - kBehind || other_u < least_u) continue;
    const double off = std::fabs(double(other.pixel[1]) - v);
    if (off <= kRows * right.pyramid.levels().factor(other.octave)) {
      candidates_.push_back(by_row_[k]);
    }
  }
  distancesTo(left.descriptors.bytes(int(feature)), right.descriptors, candidates_, distances_);
  Nearest nearest;
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    nearest.offer(candidates_[k], distances_[k]);
  }
  return nearest.distance < kMostDistance ? nearest.row : Nearest::kNone;
}

bool StereoMatcher::refine(const StereoSide& left, std::size_t feature, const StereoSide& right,
                           std::uint32_t partner, Found& found) const {
  const gslam::Feature& seen = left.features[feature];
  const int level = std::clamp<int>(seen.octave, 0, left.pyramid.count() - 1);
  const double ratio_u = left.pyramid.ratioU(level), ratio_v = left.pyramid.ratioV(level);
  const int u = int(std::lround(toLevel(double(seen.pixel[0]), ratio_u)));
  const int v = int(std::lround(toLevel(double(seen.pixel[1]), ratio_v)));
  const double about = double(right.features[partner].pixel[0]);
  const int right_u = int(std::lround(toLevel(about, ratio_u)));
  WindowMatch match{};
  if (!searchWindow(left.pyramid.level(level), u, v, right.pyramid.level(level), right_u, match)) {
    return false;
  }
  const double disparity = (u - (right_u + match.shift)) * ratio_u;
  if (disparity < kBehind || disparity > focal_) return false;
  found.feature = std::uint32_t(feature);
  found.difference = match.difference;
  found.disparity = float(std::max(disparity, kLeastDisparity));
  return true;
}

void StereoMatcher::removeWorst() {
  if (found_.empty()) return;
  differences_.clear();
  for (const Found& found : found_) differences_.push_back(found.difference);
  const auto middle = differences_.begin() + std::ptrdiff_t(differences_.size() / 2);
  std::nth_element(differences_.begin(), middle, differences_.end());
  const double most = kWorst * *middle;
  found_.erase(std::remove_if(found_.begin(), found_.end(),
                              [most](const Found& found) { return found.difference > most; }),
               found_.end());
}

}  // namespace visual
