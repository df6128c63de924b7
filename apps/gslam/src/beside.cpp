#include "beside.h"

#include <gslam/base/log.h>
#include <gslam/core/detail/exception_text.h>

namespace app {

Beside::Beside(const gslam::ApplicationFactory& factory, const gslam::ApplicationSetup& setup)
    : name_(factory.name), application_(factory.make()) {
  if (application_ == nullptr) {
    throw gslam::Error("the factory of application '" + name_ + "' made none");
  }
  thread_ = std::thread([this, setup] {
    try {
      const int status = application_->run(setup);
      if (status == 0) return;
      GSLAM_LOG(error) << "application '" << name_ << "' ended with status " << status;
    } catch (...) {
      GSLAM_LOG(error) << "application '" << name_ << "': " << gslam::detail::exceptionText();
    }
  });
}

Beside::~Beside() {
  application_->stop();
  thread_.join();
}

}  // namespace app
