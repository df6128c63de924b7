#include "robust/evidence.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Numbers of places, in the order in which they are first seen.
class Places {
 public:
  explicit Places(std::size_t most) {
    std::size_t slots = 16;
    while (slots < 2 * most) slots *= 2;
    slots_.assign(slots, 0);
    places_.reserve(most);
  }

  // Two places with one hash of 64 bits are taken for one, which happens to none of a billion.
  std::size_t numberOf(std::uint64_t hash) {
    std::size_t slot = hash & (slots_.size() - 1);
    while (slots_[slot] != 0 && places_[slots_[slot] - 1] != hash) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    if (slots_[slot] == 0) {
      places_.push_back(hash);
      slots_[slot] = static_cast<std::uint32_t>(places_.size());
    }
    return slots_[slot] - 1;
  }
  std::size_t size() const { return places_.size(); }

 private:
  std::vector<std::uint32_t> slots_;
  std::vector<std::uint64_t> places_;
};

std::uint64_t hashOf(const Problem& problem, const ModelNumbers& model, double cell,
                     std::size_t i) {
  double place[kMaxPlace];
  const std::size_t count = problem.placeOf(model, i, place);
  std::uint64_t hash = 0x9E3779B97F4A7C15;
  for (std::size_t k = 0; k < count; ++k) {
    const double number = (cell > 0 ? std::floor(place[k] / cell) : place[k]) + 0.0;  // no -0
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof(bits));
    hash = (hash ^ bits) * 0xBF58476D1CE4E5B9;
    hash = (hash ^ (hash >> 29)) * 0x94D049BB133111EB;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace

DistinctCount countDistinct(const Problem& problem, const ModelNumbers& model, double cell,
                            const std::uint8_t* inliers) {
  const std::size_t n = problem.size();
  DistinctCount count;
  Places places(n);
  for (const std::uint8_t wanted : {std::uint8_t{1}, std::uint8_t{0}}) {
    for (std::size_t i = 0; i < n; ++i) {
      if ((inliers[i] != 0) == (wanted != 0)) places.numberOf(hashOf(problem, model, cell, i));
    }
    if (wanted != 0) count.inliers = places.size();
  }
  count.matches = places.size();
  return count;
}

std::size_t weighDistinct(const Problem& problem, const ModelNumbers& model,
                          const std::uint8_t* inliers, std::vector<double>& weights) {
  const std::size_t n = problem.size();
  Places places(n);
  std::vector<std::uint32_t> place(n), count(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (inliers[i] == 0) continue;
    place[i] = static_cast<std::uint32_t>(places.numberOf(hashOf(problem, model, 0, i)));
    ++count[place[i]];
  }
  weights.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (inliers[i] != 0) weights[i] = 1.0 / count[place[i]];
  }
  return places.size();
}

void ShuffledPairs::look(std::size_t trials) {
  const std::size_t n = problem_.size();
  while (trials_ < trials && hasMore()) {
    // Pairs of one shift from the first on; those that were seen are made again.
    const std::size_t count = std::min(n, in_shift_ + trials - trials_);
    squared_.resize(count);
    problem_.squaredResidualsOfPairs(model_, shift_, count, squared_.data());
    for (std::size_t i = in_shift_; i < count; ++i) hits_ += squared_[i] <= limit_ ? 1 : 0;
    trials_ += count - in_shift_;
    in_shift_ = count;
    if (in_shift_ < n) break;
    ++shift_;
    in_shift_ = 0;
  }
}

double ShuffledPairs::upperBound() const {
  if (trials_ == 0) return 0;
  const double hits = static_cast<double>(hits_) + 1;
  return (hits + 3 * std::sqrt(hits)) / static_cast<double>(trials_);
}

// That none was seen does not mean that there is none; but where there are few matches, and all
// pairs were seen, not more than that a place in the image is one of 20'000.
double ShuffledPairs::estimate() const {
  if (trials_ == 0) return 0;
  const std::size_t unseen = hasMore() ? trials_ : kMost;
  return static_cast<double>(hits_) / static_cast<double>(trials_) +
         1 / static_cast<double>(unseen);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
