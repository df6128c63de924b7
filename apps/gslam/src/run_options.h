#ifndef GSLAM_APPS_RUN_OPTIONS_H
#define GSLAM_APPS_RUN_OPTIONS_H

#include <cstdint>
#include <string>
#include <vector>

#include "options.h"

namespace app {

/// The options of `gslam run`.
class RunOptions : public Options {
 public:
  RunOptions();

  /// Takes over the arguments, and tries all that needs neither dataset nor SLAM system.
  /// @return whether the command is to go on
  /// @throws ConfigError
  bool take(const std::vector<std::string>& arguments);

  const std::vector<int>& cpus() const { return cpus_; }  ///< empty: all
  std::uint64_t memory() const { return memory_; }        ///< bytes; 0: no limit
  int repeats() const { return get<int>("repeat"); }      ///< 0: one run, whose files are in DIR

 private:
  std::vector<int> cpus_;
  std::uint64_t memory_ = 0;
};

}  // namespace app

#endif  // GSLAM_APPS_RUN_OPTIONS_H
