// What tests switch off.
#ifndef GSLAM_ESTIMATOR_ROBUST_LOOP_TUNING_H
#define GSLAM_ESTIMATOR_ROBUST_LOOP_TUNING_H

namespace gslam {
inline namespace v1 {
namespace detail {

struct LoopTuning {
  bool exact_bound = true;       // leave a model as soon as it cannot win any more
  bool statistical_test = true;  // leave it as soon as it most likely will not
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_LOOP_TUNING_H
