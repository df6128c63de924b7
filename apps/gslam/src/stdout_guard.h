#ifndef GSLAM_APPS_STDOUT_GUARD_H
#define GSLAM_APPS_STDOUT_GUARD_H

namespace app {

/// While it lives, what anybody prints to stdout goes to stderr: stdout is for results, and SLAM
/// systems print what they like.
class StdoutGuard {
 public:
  StdoutGuard();
  StdoutGuard(const StdoutGuard&) = delete;
  StdoutGuard& operator=(const StdoutGuard&) = delete;
  ~StdoutGuard();

 private:
  int stdout_;  // a copy; -1: there is none
};

}  // namespace app

#endif  // GSLAM_APPS_STDOUT_GUARD_H
