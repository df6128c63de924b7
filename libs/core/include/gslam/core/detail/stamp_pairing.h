// How associate() finds the best pairs.
#ifndef GSLAM_CORE_DETAIL_STAMP_PAIRING_H
#define GSLAM_CORE_DETAIL_STAMP_PAIRING_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {

/// Two measurements that belong together.
struct StampPair {
  std::size_t a;  ///< place in the first list
  std::size_t b;  ///< place in the second list
};

namespace detail {

inline void checkAscending(const char* name, Span<const std::int64_t> stamps) {
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    if (stamps[i - 1] < stamps[i]) continue;
    throw ArgumentError(name, "is not ascending: number " + std::to_string(i) + " is " +
                                  std::to_string(stamps[i]) + ", after " +
                                  std::to_string(stamps[i - 1]));
  }
}

// How good a way to pair is: more pairs first, then less distance.
struct PairingMerit {
  std::size_t pairs = 0;
  double distance = 0;

  bool isBetterThan(const PairingMerit& other) const {
    return pairs != other.pairs ? pairs > other.pairs : distance < other.distance;
  }
};

// The stamps of b within the tolerance of one of a, and the best that can be done with all of a up
// to it and all of b up to each of them.
struct PairingRow {
  std::size_t begin = 0;             // in b
  std::size_t end = 0;               // in b
  std::vector<PairingMerit> merits;  // of b up to begin - 1, begin, ..., end - 1

  const PairingMerit& upTo(std::size_t b_end) const {  // all of b before b_end
    return merits[std::min(b_end, end) - begin];
  }
};

// Dynamic programming over the prefixes of both lists, in a band: stamps of b outside of the
// tolerance of one of a are no partners, and the merit stays what it is.
class StampPairing {
 public:
  using Stamps = Span<const std::int64_t>;
  static constexpr std::size_t kMostSteps = std::size_t(1) << 28;  // bytes, too

  StampPairing(Stamps a, Stamps b, std::uint64_t tolerance) : a_(a), b_(b), tolerance_(tolerance) {
    findBands();
    PairingRow row;
    row.merits.resize(1);
    for (std::size_t i = 0; i < a.size(); ++i) row = nextRow(row, i);
  }

  std::vector<StampPair> pairs() const {
    std::vector<StampPair> result;
    std::size_t b_end = b_.size();
    for (std::size_t i = a_.size(); i-- > 0;) {
      b_end = std::min(b_end, bands_[i].end);
      while (b_end > bands_[i].begin) {
        const Step step = steps_[bands_[i].first_step + (b_end - 1 - bands_[i].begin)];
        if (step == Step::skip_a) break;
        --b_end;
        if (step == Step::skip_b) continue;
        result.push_back({i, b_end});
        break;
      }
    }
    std::reverse(result.begin(), result.end());
    return result;
  }

 private:
  enum class Step : std::uint8_t { skip_a, skip_b, pair };
  struct Band {
    std::size_t begin, end, first_step;
  };

  static std::uint64_t distance(std::int64_t a, std::int64_t b) noexcept {
    return a < b ? std::uint64_t(b) - std::uint64_t(a) : std::uint64_t(a) - std::uint64_t(b);
  }

  void findBands() {
    std::size_t begin = 0, end = 0, steps = 0;
    bands_.reserve(a_.size());
    for (const std::int64_t stamp : a_) {
      while (begin < b_.size() && b_[begin] < stamp && distance(stamp, b_[begin]) > tolerance_) {
        ++begin;
      }
      end = std::max(begin, end);
      while (end < b_.size() && (b_[end] <= stamp || distance(stamp, b_[end]) <= tolerance_)) {
        ++end;
      }
      bands_.push_back({begin, end, steps});
      steps += end - begin;
      if (steps > kMostSteps) {
        throw ArgumentError("tolerance",
                            "has more than 2^28 pairs within it, expected a smaller one");
      }
    }
    steps_.reserve(steps);
  }

  PairingRow nextRow(const PairingRow& before, std::size_t i) {
    PairingRow row;
    row.begin = bands_[i].begin;
    row.end = bands_[i].end;
    row.merits.push_back(before.upTo(row.begin));
    for (std::size_t j = row.begin; j < row.end; ++j) {
      row.merits.push_back(best(before, row.merits.back(), i, j));
    }
    return row;
  }

  PairingMerit best(const PairingRow& before, const PairingMerit& without_b, std::size_t i,
                    std::size_t j) {
    PairingMerit merit = before.upTo(j + 1);
    Step step = Step::skip_a;
    if (without_b.isBetterThan(merit)) {
      merit = without_b;
      step = Step::skip_b;
    }
    const std::uint64_t apart = distance(a_[i], b_[j]);
    PairingMerit paired = before.upTo(j);
    ++paired.pairs;
    paired.distance += double(apart);
    if (apart <= tolerance_ && paired.isBetterThan(merit)) {
      merit = paired;
      step = Step::pair;
    }
    steps_.push_back(step);
    return merit;
  }

  Stamps a_, b_;
  std::uint64_t tolerance_;
  std::vector<Band> bands_;  // one for each of a
  std::vector<Step> steps_;  // for each of a, those of its band
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_STAMP_PAIRING_H
