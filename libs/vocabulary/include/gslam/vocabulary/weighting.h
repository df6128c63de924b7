#ifndef GSLAM_VOCABULARY_WEIGHTING_H
#define GSLAM_VOCABULARY_WEIGHTING_H

#include <cstddef>
#include <cstdint>

/// @file
/// How much a word counts, and how bags of words are compared: the choices of DBoW2, with its
/// numbers, which its files have, too.

namespace gslam {
inline namespace v1 {

/// How much a word counts in a bag.
enum class Weighting : std::uint8_t {
  tf_idf,  ///< how often it is in the image, times how rare it is in the images of the training
  tf,      ///< how often it is in the image
  idf,     ///< how rare it is in the images of the training
  binary   ///< whether it is in the image
};

/// How two bags are compared.
enum class Scoring : std::uint8_t {
  l1,          ///< 1 - |v - w| / 2, of bags of L1 norm 1; from 0 to 1
  l2,          ///< 1 - sqrt(1 - v.w), of bags of L2 norm 1; from 0 to 1
  chi_square,  ///< 2 sum(v w / (v + w)), of bags of L1 norm 1; from 0 to 1
  kl,  ///< Kullback-Leibler divergence, of bags of L1 norm 1: 0 for equal ones, more for others
  bhattacharyya,  ///< sum(sqrt(v w)), of bags of L1 norm 1; from 0 to 1
  dot             ///< v.w, of bags that are not normalised
};

/// Its name: "tf-idf", "tf", "idf" or "binary".
inline const char* weightingName(Weighting weighting) noexcept {
  static const char* const names[] = {"tf-idf", "tf", "idf", "binary"};
  const std::size_t i = static_cast<std::size_t>(weighting);
  return i < 4 ? names[i] : "unknown";
}

/// Its name: "l1", "l2", "chi-square", "kl", "bhattacharyya" or "dot".
inline const char* scoringName(Scoring scoring) noexcept {
  static const char* const names[] = {"l1", "l2", "chi-square", "kl", "bhattacharyya", "dot"};
  const std::size_t i = static_cast<std::size_t>(scoring);
  return i < 6 ? names[i] : "unknown";
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_WEIGHTING_H
