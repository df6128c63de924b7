#ifndef GSLAM_VOCABULARY_SCORE_H
#define GSLAM_VOCABULARY_SCORE_H

#include <gslam/vocabulary/bow_vector.h>
#include <gslam/vocabulary/detail/check_bow.h>
#include <gslam/vocabulary/detail/common_words.h>
#include <gslam/vocabulary/detail/score_terms.h>
#include <gslam/vocabulary/weighting.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

/// @file
/// How alike two bags of words are.
///
/// Sources: D. Nister, H. Stewenius, "Scalable Recognition with a Vocabulary Tree", CVPR 2006; D.
/// Galvez-Lopez, J. D. Tardos, "Bags of Binary Words for Fast Place Recognition in Image
/// Sequences", IEEE Transactions on Robotics 28(5), 2012, and what their DBoW2 does.

namespace gslam {
inline namespace v1 {

/// The length of bags.
enum class BowNorm : std::uint8_t {
  none,  ///< any
  l1,    ///< the magnitudes of the values add up to 1
  l2     ///< the squares of the values add up to 1
};

/// The length that bags must have for a scoring.
inline BowNorm normFor(Scoring scoring) noexcept {
  if (scoring == Scoring::dot) return BowNorm::none;
  return scoring == Scoring::l2 ? BowNorm::l2 : BowNorm::l1;
}

/// Gives a bag the length that a scoring needs. One that is empty or all zeros stays as it is.
inline void normalize(BowVector& bow, Scoring scoring) noexcept {
  const BowNorm norm = normFor(scoring);
  if (norm == BowNorm::none) return;
  double length = 0;
  for (const double value : bow.values) {
    length += norm == BowNorm::l1 ? std::fabs(value) : detail::rounded(value * value);
  }
  if (norm == BowNorm::l2) length = std::sqrt(length);
  if (!(length > 0)) return;
  for (double& value : bow.values) value /= length;
}

/// Whether a score says more likeness than another one: the lower one of Scoring::kl, else the
/// higher one.
inline bool isBetter(Scoring scoring, double score, double other) noexcept {
  return scoring == Scoring::kl ? score < other : score > other;
}

namespace detail {

struct ScoreAction {
  const BowVector& v;
  const BowVector& w;

  template <class Term>
  double operator()(Term) const {
    double alone = 0;
    if (Term::kHasOwn) {
      for (const double value : v.values) alone += Term::own(value);
    }
    WordLists lists = {v.words.data(), v.size(), w.words.data(), w.size(), 0, 0};
    const FindCommon find = findCommonKernel().active();
    CommonWords found;
    double sum = 0;
    while (!lists.areDone()) {
      const std::size_t count = find(lists, found);
      for (std::size_t i = 0; i < count; ++i) {
        const double value = v.values[found.in_a[i]];
        sum += Term::common(value, Term::own(value), w.values[found.in_b[i]]);
      }
    }
    return Term::finish(sum, alone);
  }
};

}  // namespace detail

/// How alike two bags are: what DBoW2 and DBoW3 say, to the last bit, but for Scoring::kl, which
/// agrees to 1e-12. Only words that are in both count. Scoring::kl alone takes a word that `w`
/// lacks as one of 2^-52, and so depends on the order of the bags.
///
/// Bags should have the length of normFor(): others give what the formulas of Scoring say.
/// The same on all machines and SIMD variants, as far as std::log() is the same and the compiler is
/// not told to be careless (-ffast-math).
///
/// Thread-safety: as far as the bags are not changed meanwhile.
///
/// @param scoring  the formula
/// @param v        one bag: of the query
/// @param w        another bag: of what is asked for
/// @throws ArgumentError when a bag has not one value for each word, or there is no such scoring
inline double score(Scoring scoring, const BowVector& v, const BowVector& w) {
  detail::checkSizes("v", v);
  detail::checkSizes("w", w);
  return detail::withTerm(scoring, detail::ScoreAction{v, w});
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_SCORE_H
