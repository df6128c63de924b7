#include "interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <mutex>
#include <thread>
#include <utility>

#include "command.h"

namespace app {
namespace {

struct Handler {
  std::mutex mutex;
  std::function<void()> stop;    // empty: none lives, or both were called
  std::function<void()> insist;  // comes next
};

// Is never destroyed, since the thread that uses it ends with the process.
Handler& handler() {
  static Handler* const handler = new Handler;
  return *handler;
}

void handleOne() {
  const std::lock_guard<std::mutex> lock(handler().mutex);
  const std::function<void()> stop =
      std::exchange(handler().stop, std::exchange(handler().insist, nullptr));
  if (!stop) _exit(kInterrupted);
  stop();
}

}  // namespace

void holdInterrupts() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  handler();
  std::thread([set] {
    int signal = 0;
    while (sigwait(&set, &signal) == 0) handleOne();
  }).detach();
}

OnInterrupt::OnInterrupt(std::function<void()> stop, std::function<void()> insist) {
  const std::lock_guard<std::mutex> lock(handler().mutex);
  handler().stop = std::move(stop);
  handler().insist = std::move(insist);
}

OnInterrupt::~OnInterrupt() {
  const std::lock_guard<std::mutex> lock(handler().mutex);
  handler().stop = nullptr;
  handler().insist = nullptr;
}

}  // namespace app
