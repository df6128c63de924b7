#ifndef GSLAM_OPTIMIZER_SRC_CHECK_INPUT_H
#define GSLAM_OPTIMIZER_SRC_CHECK_INPUT_H

#include <gslam/optimizer/alignment_problem.h>
#include <gslam/optimizer/options.h>
#include <gslam/optimizer/pose_problem.h>
#include <gslam/optimizer/two_view_problem.h>

// Options and small problems: these throw at the first thing that is wrong, and allocate nothing
// where there is none.

namespace gslam {
inline namespace v1 {
namespace detail {

// @throws ArgumentError that names the option
void checkOptions(const OptimizerOptions& options);
// @throws ArgumentError that names the part of the loss, such as "loss.scale"
void checkLoss(const RobustLoss& loss, const char* name);
// @throws ArgumentError that names the field
void checkPoseProblem(const PoseProblem& problem, const SE3d& T_world_body);
void checkAlignmentProblem(const AlignmentProblem& problem);
void checkTwoViewProblem(const TwoViewProblem& problem, const SE3d& T_first_second);
// Of a start; 7 or 8 numbers.
void checkStart(const char* name, const double* values, std::size_t count);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_CHECK_INPUT_H
