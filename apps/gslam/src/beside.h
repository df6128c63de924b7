#ifndef GSLAM_APPS_BESIDE_H
#define GSLAM_APPS_BESIDE_H

#include <gslam/core/application.h>
#include <gslam/core/registry.h>

#include <memory>
#include <string>
#include <thread>

namespace app {

/// Runs an application, such as a viewer, in a thread of its own for as long as this lives.
class Beside {
 public:
  /// @throws Error when the factory makes none
  Beside(const gslam::ApplicationFactory& factory, const gslam::ApplicationSetup& setup);
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  /// Tells it to stop, and waits for it. The log gets its failure.
  ~Beside();

 private:
  const std::string name_;
  const std::unique_ptr<gslam::Application> application_;
  std::thread thread_;
};

}  // namespace app

#endif  // GSLAM_APPS_BESIDE_H
