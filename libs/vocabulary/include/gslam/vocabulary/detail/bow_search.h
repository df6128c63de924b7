// A query of a database: sums over inverted lists, and the best of them.
#ifndef GSLAM_VOCABULARY_DETAIL_BOW_SEARCH_H
#define GSLAM_VOCABULARY_DETAIL_BOW_SEARCH_H

#include <gslam/vocabulary/detail/bow_segment.h>
#include <gslam/vocabulary/detail/bow_store.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// What queries need beside their results. The sums are zeros between queries.
struct BowScratch {
  std::vector<BowSum> sums;
  std::vector<double> own;
};

// Those that no query uses now: there are never more than there were queries at once.
class BowScratches {
 public:
  std::unique_ptr<BowScratch> take() {
    std::lock_guard<std::mutex> lock(mutex_);
    if (free_.empty()) {
      free_.reserve(++made_);  // so that give() has room
      return std::unique_ptr<BowScratch>(new BowScratch);
    }
    std::unique_ptr<BowScratch> scratch = std::move(free_.back());
    free_.pop_back();
    return scratch;
  }
  void give(std::unique_ptr<BowScratch> scratch) {
    std::lock_guard<std::mutex> lock(mutex_);
    free_.push_back(std::move(scratch));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<BowScratch>> free_;
  std::size_t made_ = 0;
};

// The best results of those that come in the order of their ids.
template <class Result>
class BestResults {
 public:
  BestResults(std::vector<Result>& results, std::size_t count, bool is_lower_better)
      : results_(results), count_(count), better_{is_lower_better} {
    results_.clear();
  }

  // Where scores are the same, the lower id is better.
  bool wants(double score) const noexcept {
    return count_ == 0 || results_.size() < count_ || better_.of(score, results_.front().score);
  }
  void add(const Result& result) {
    if (count_ == 0) {
      results_.push_back(result);
      return;
    }
    if (results_.size() == count_) {  // the worst is in front
      std::pop_heap(results_.begin(), results_.end(), better_);
      results_.back() = result;
    } else {
      results_.push_back(result);
    }
    std::push_heap(results_.begin(), results_.end(), better_);
  }
  void sort() { std::sort(results_.begin(), results_.end(), better_); }

 private:
  struct Better {
    bool is_lower;

    bool of(double a, double b) const noexcept { return is_lower ? a < b : a > b; }
    bool operator()(const Result& a, const Result& b) const noexcept {
      if (a.score == b.score) return a.id < b.id;
      return of(a.score, b.score);
    }
  };

  std::vector<Result>& results_;
  std::size_t count_;
  Better better_;
};

// One query with one scoring.
template <class Options, class Result>
struct BowSearch {
  const BowStore& store;
  BowScratch& scratch;
  const BowVector& bow;
  const Options& options;
  std::vector<Result>& results;

  template <class Term>
  void operator()(Term) const {
    const double alone = prepare<Term>();
    BestResults<Result> best(results, options.count, Term::kHasOwn);
    const std::shared_ptr<const BowSegments> segments = store.view();
    for (const BowSegmentView& part : *segments) {
      if (part.first_id >= options.before_id) break;
      const std::uint32_t limit =
          part.segment->lowerBound(options.before_id, part.table->entries());
      if (scratch.sums.size() < limit) scratch.sums.resize(limit, BowSum{0, 0});
      part.segment->template addUp<Term>(*part.table, BowQuery{&bow, scratch.own.data()}, limit,
                                         scratch.sums.data());
      collect<Term>(*part.segment, limit, alone, best);
    }
    best.sort();
  }

 private:
  template <class Term>
  double prepare() const {
    double alone = 0;
    if (!Term::kHasOwn) return alone;
    scratch.own.clear();
    for (const double value : bow.values) {
      scratch.own.push_back(Term::own(value));
      alone += scratch.own.back();
    }
    return alone;
  }

  template <class Term>
  void collect(const BowSegment& segment, std::uint32_t limit, double alone,
               BestResults<Result>& best) const {
    for (std::uint32_t i = 0; i < limit; ++i) {
      const BowSum sum = scratch.sums[i];
      if (sum.common_words == 0) continue;
      scratch.sums[i] = BowSum{0, 0};
      if (sum.common_words < options.min_common_words) continue;
      const double score = Term::finish(sum.sum, alone);
      if (std::isnan(score) || !isGoodEnough<Term>(score) || !best.wants(score)) continue;
      const BowRecord& record = segment.record(i);
      if (record.is_erased.load(std::memory_order_acquire)) continue;
      best.add(Result{record.id, score, sum.common_words});
    }
  }
  template <class Term>
  bool isGoodEnough(double score) const noexcept {
    return !(Term::kHasOwn ? score > options.worst_score : score < options.worst_score);
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_BOW_SEARCH_H
