// What a common word adds to a score: the same for two bags and for a database, in the same order,
// so that both get the same bits.
#ifndef GSLAM_VOCABULARY_DETAIL_SCORE_TERMS_H
#define GSLAM_VOCABULARY_DETAIL_SCORE_TERMS_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>
#include <gslam/vocabulary/weighting.h>

#include <cmath>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// The same number, which the compiler does not fuse with an addition that follows. It may do so
// with a product (-march=native, arm64), and did in one place but not in another: then the score of
// a database is not that of score(), and the square root of L2 makes 1e-8 of the last bit.
inline double rounded(double product) noexcept {
#if GSLAM_X86
  __asm__("" : "+x"(product));
  return product;
#elif GSLAM_ARM64
  __asm__("" : "+w"(product));
  return product;
#else
  volatile double stored = product;
  return stored;
#endif
}

// own(): what a word of the first bag counts when the second lacks it; the sum over all of the
// first is `alone`. common(): what changes when the second has it. finish(): the score.

// 1 - |v - w| / 2, where |v - w| = 2 + sum(|v - w| - |v| - |w|) over the common words (Nister and
// Stewenius 2006).
struct L1Term {
  static constexpr bool kHasOwn = false;
  static double own(double) noexcept { return 0; }
  static double common(double v, double, double w) noexcept {
    return std::fabs(v - w) - std::fabs(v) - std::fabs(w);
  }
  static double finish(double sum, double) noexcept { return -sum / 2 + 0.0; }  // no -0
};

struct ProductTerm {
  static constexpr bool kHasOwn = false;
  static double own(double) noexcept { return 0; }
  static double common(double v, double, double w) noexcept { return rounded(v * w); }
};
struct L2Term : ProductTerm {
  static double finish(double sum, double) noexcept {
    return sum >= 1 ? 1 : 1 - std::sqrt(1 - sum);  // over 1: by rounding
  }
};
struct DotTerm : ProductTerm {
  static double finish(double sum, double) noexcept { return sum; }
};

struct ChiSquareTerm {
  static constexpr bool kHasOwn = false;
  static double own(double) noexcept { return 0; }
  static double common(double v, double, double w) noexcept {
    return v + w != 0 ? v * w / (v + w) : 0;
  }
  static double finish(double sum, double) noexcept { return 2 * sum; }
};

struct BhattacharyyaTerm {
  static constexpr bool kHasOwn = false;
  static double own(double) noexcept { return 0; }
  static double common(double v, double, double w) noexcept { return std::sqrt(v * w); }
  static double finish(double sum, double) noexcept { return sum; }
};

// A word that the second bag lacks counts as if it had 2^-52 of it, as in DBoW.
struct KlTerm {
  static constexpr bool kHasOwn = true;
  static double own(double v) noexcept {
    return v != 0 ? rounded(v * (std::log(v) + 36.04365338911715)) : 0;  // 52 ln 2
  }
  static double common(double v, double own, double w) noexcept {
    return (v != 0 && w != 0 ? rounded(v * std::log(v / w)) : 0) - own;
  }
  static double finish(double sum, double alone) noexcept { return alone + sum; }
};

// Calls the action with the term of a scoring.
template <class Action>
auto withTerm(Scoring scoring, Action&& action) -> decltype(action(L1Term())) {
  switch (scoring) {
    case Scoring::l1:
      return action(L1Term());
    case Scoring::l2:
      return action(L2Term());
    case Scoring::chi_square:
      return action(ChiSquareTerm());
    case Scoring::kl:
      return action(KlTerm());
    case Scoring::bhattacharyya:
      return action(BhattacharyyaTerm());
    case Scoring::dot:
      return action(DotTerm());
  }
  throw ArgumentError("scoring", "is " + std::to_string(static_cast<int>(scoring)) +
                                     ", expected one of the six of Scoring");
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_SCORE_TERMS_H
