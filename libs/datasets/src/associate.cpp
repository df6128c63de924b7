#include <gslam/base/error.h>
#include <gslam/datasets/associate.h>

#include <algorithm>
#include <string>

namespace gslam {
inline namespace v1 {
namespace {

using Stamps = Span<const std::int64_t>;

void checkAscending(const char* name, Stamps stamps) {
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    if (stamps[i - 1] < stamps[i]) continue;
    throw ArgumentError(name, "is not ascending: number " + std::to_string(i) + " is " +
                                  std::to_string(stamps[i]) + ", after " +
                                  std::to_string(stamps[i - 1]));
  }
}

std::uint64_t distance(std::int64_t a, std::int64_t b) {
  const auto x = static_cast<std::uint64_t>(a), y = static_cast<std::uint64_t>(b);
  return a < b ? y - x : x - y;
}

// How good a way to pair is: more pairs first, then less distance.
struct Merit {
  std::size_t pairs = 0;
  double distance = 0;

  bool isBetterThan(const Merit& other) const {
    return pairs != other.pairs ? pairs > other.pairs : distance < other.distance;
  }
};

// The stamps of b within the tolerance of one of a, and the best that can be done with all of a up
// to it and all of b up to each of them.
struct Row {
  std::size_t begin = 0;      // in b
  std::size_t end = 0;        // in b
  std::vector<Merit> merits;  // of b up to begin - 1, begin, ..., end - 1

  const Merit& upTo(std::size_t b_end) const {  // all of b before b_end
    return merits[std::min(b_end, end) - begin];
  }
};

enum class Step : std::uint8_t { skip_a, skip_b, pair };

// Dynamic programming over the prefixes of both lists, in a band: stamps of b outside of the
// tolerance of one of a are no partners, and the merit stays what it is.
class Pairing {
 public:
  Pairing(Stamps a, Stamps b, std::uint64_t tolerance) : a_(a), b_(b), tolerance_(tolerance) {
    Row row;
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
  struct Band {
    std::size_t begin, end, first_step;
  };

  Row nextRow(const Row& before, std::size_t i) {
    Row row;
    row.begin = before.begin;
    while (row.begin < b_.size() && b_[row.begin] < a_[i] &&
           distance(a_[i], b_[row.begin]) > tolerance_) {
      ++row.begin;
    }
    row.end = std::max(before.end, row.begin);
    while (row.end < b_.size() &&
           (b_[row.end] <= a_[i] || distance(a_[i], b_[row.end]) <= tolerance_)) {
      ++row.end;
    }
    bands_.push_back({row.begin, row.end, steps_.size()});
    row.merits.push_back(before.upTo(row.begin));
    for (std::size_t j = row.begin; j < row.end; ++j) {
      row.merits.push_back(best(before, row.merits.back(), i, j));
    }
    return row;
  }

  Merit best(const Row& before, const Merit& without_b, std::size_t i, std::size_t j) {
    Merit merit = before.upTo(j + 1);
    Step step = Step::skip_a;
    if (without_b.isBetterThan(merit)) {
      merit = without_b;
      step = Step::skip_b;
    }
    const std::uint64_t apart = distance(a_[i], b_[j]);
    Merit paired = before.upTo(j);
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

}  // namespace

std::vector<StampPair> associate(Stamps a, Stamps b, std::int64_t tolerance) {
  checkAscending("a", a);
  checkAscending("b", b);
  if (tolerance < 0) {
    throw ArgumentError("tolerance", "is " + std::to_string(tolerance) + ", expected 0 or more");
  }
  return Pairing(a, b, static_cast<std::uint64_t>(tolerance)).pairs();
}

}  // namespace v1
}  // namespace gslam
