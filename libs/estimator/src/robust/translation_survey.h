// Whether other directions of translation explain the matches as well as the one that was found.
#ifndef GSLAM_ESTIMATOR_ROBUST_TRANSLATION_SURVEY_H
#define GSLAM_ESTIMATOR_ROBUST_TRANSLATION_SURVEY_H

#include <cstdint>
#include <vector>

#include "robust/essential_problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// The matches that do not move by more than most: inliers that move more, and are no more than
// chance explains, are wrong matches that lie on their epipolar line. Where the camera hardly
// moved, one of them says more of the translation than all others, and what it says is wrong.
std::vector<std::uint32_t> withoutChanceParallax(const EpipolarMatches& matches,
                                                 const SO3d& rotation, const std::uint8_t* inliers,
                                                 double chance);

struct CostOfModel {
  ModelNumbers model{};
  double cost = 0;  // truncated, over all matches of the problem
};

// Minima of the truncated cost from directions of translation all over the half sphere, whose
// rotation begins with that of the model; the first one, with the lowest cost, may be the model.
std::vector<CostOfModel> surveyTranslations(const EpipolarMatches& matches,
                                            const ModelNumbers& model, double threshold);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_TRANSLATION_SURVEY_H
