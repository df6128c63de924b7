#include "fault.h"

#include <csignal>
#include <cstdlib>
#include <thread>

namespace replay {

namespace {

void fail(FaultOptions::Kind kind) {
  switch (kind) {
    case FaultOptions::Kind::none:
      return;
    case FaultOptions::Kind::signal:
      std::raise(SIGSEGV);
      return;
    case FaultOptions::Kind::abort:
      std::abort();
    case FaultOptions::Kind::exit:
      std::exit(kExitStatus);
    case FaultOptions::Kind::exception:
      throw gslam::Error("fails, as 'fault' asks for");
    case FaultOptions::Kind::hang:
      while (true) std::this_thread::sleep_for(std::chrono::hours(1));
  }
}

}  // namespace

void failInConstructor() {
  const char* const name = std::getenv("GSLAM_REPLAY_FAULT");
  if (name != nullptr) fail(faultCalled("GSLAM_REPLAY_FAULT", name));
}

void failIfAsked(const FaultOptions& fault, FaultOptions::Call call, std::uint64_t frame) {
  if (call != fault.call) return;
  if (call == FaultOptions::Call::feed && frame < fault.frame) return;
  fail(fault.kind);
}

}  // namespace replay
