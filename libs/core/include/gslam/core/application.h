#ifndef GSLAM_CORE_APPLICATION_H
#define GSLAM_CORE_APPLICATION_H

#include <gslam/messenger/messenger.h>
#include <gslam/svar/svar.h>

/// @file
/// What runs beside a SLAM system: viewers, bridges, tools.

namespace gslam {
inline namespace v1 {

/// What an application is given to run with.
struct ApplicationSetup {
  Svar parameters;      ///< those of ApplicationInfo::parameters, with the values the user wants
  Messenger messenger;  ///< with the topics of the dataset and of the SLAM systems
};

/// Something that runs until it is done or told to stop: a viewer, a bridge to ROS, a tool.
class Application {
 public:
  virtual ~Application() = default;

  /// Runs, in the thread that calls it.
  /// @return the exit status of the process: 0 is success
  /// @throws Error with a reason
  virtual int run(const ApplicationSetup& setup) = 0;

  /// Makes run() return soon. May be called from any thread at any time, also before run(), which
  /// then returns at once, and more than once.
  virtual void stop() = 0;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_APPLICATION_H
