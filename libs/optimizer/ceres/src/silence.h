#ifndef GSLAM_OPTIMIZER_CERES_SRC_SILENCE_H
#define GSLAM_OPTIMIZER_CERES_SRC_SILENCE_H

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

// Keeps the warnings of Ceres off stderr while it lives. Ceres is told to be silent, but warns of a
// matrix that cannot be factored all the same, which is an everyday event: a smaller step follows.
//
// glog has one threshold for the whole process. Where the application has called
// google::InitGoogleLogging(), its choices hold and nothing is touched: such warnings then go where
// it sends them. Else nobody reads glog, which would write to stderr: the threshold is raised, and
// put back when the last of these objects dies. Any number of threads may have one.
class SilentGlog {
 public:
  SilentGlog();
  ~SilentGlog();
  SilentGlog(const SilentGlog&) = delete;
  SilentGlog& operator=(const SilentGlog&) = delete;
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_SILENCE_H
