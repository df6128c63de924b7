// Ends and forks of processes: one scenario a run, named by the argument. Exit status 0 is good, 77
// says that it cannot be tried.
#include <gslam/messenger.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <thread>

namespace {

using gslam::defaultMessenger;
using gslam::inOwnThread;
using gslam::Messenger;
using gslam::Publisher;
using gslam::Subscriber;

// Of sanitizers that do not follow a fork(): the thread sanitizer loses track of threads, and the
// allocator of the address sanitizer stays locked in a child if another thread held it (GCC 14 and
// LLVM 17 mended that).
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr bool kForks = false;
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer)
constexpr bool kForks = false;
#else
constexpr bool kForks = true;
#endif
#else
constexpr bool kForks = true;
#endif

// What a child gives back that runs `body`, which must end it.
template <class Body>
int statusOfChild(Body body) {
  if (!kForks) std::_Exit(77);
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    body();
    std::_Exit(99);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Whether messages are handled in a thread of their own.
bool works(const Messenger& messenger) {
  std::atomic<int> sum{0};
  Subscriber subscriber =
      messenger.subscribe<int>("n", inOwnThread().drainAtEnd(), [&](const int& n) { sum += n; });
  for (int i = 0; i < 1000; ++i) messenger.publish<int>("n", 1);
  subscriber.unsubscribe();
  return sum == 1000;
}

// --- fork()

// Static destructors run in the child. The parent loses nothing.
bool childLeavesMessengersAlone() {
  const Messenger messenger;
  const Subscriber queued = messenger.subscribe<int>("n", inOwnThread(), [](const int&) {});
  defaultMessenger().subscribe<int>("n", inOwnThread(), [](const int&) {}).keep();
  return statusOfChild([] { std::exit(7); }) == 7 && works(messenger) && works(defaultMessenger());
}

bool childMakesItsOwn() {
  const Messenger parents;
  const Subscriber queued = parents.subscribe<int>("n", inOwnThread(), [](const int&) {});
  return statusOfChild([] { std::_Exit(works(Messenger()) ? 7 : 1); }) == 7;
}

bool childHasADefaultOfItsOwn() {
  int parents = 0;
  const Subscriber here = defaultMessenger().subscribe<int>("n", [&](const int&) { ++parents; });
  defaultMessenger().subscribe<int>("n", inOwnThread(), [](const int&) {}).keep();
  const auto child = [&] { std::exit(works(defaultMessenger()) && parents == 0 ? 7 : 1); };
  return statusOfChild(child) == 7 && works(defaultMessenger()) && parents == 1000;
}

// The other thread is in defaultMessenger() again and again when children are made.
bool childLeavesWhatOthersHoldAlone() {
  defaultMessenger();
  std::atomic<bool> stop{false};
  std::thread other([&] {
    while (!stop) defaultMessenger();
  });
  bool good = true;
  for (int i = 0; i < 50 && good; ++i) {
    good = statusOfChild([] {
             alarm(10);
             std::exit(7);
           }) == 7;
  }
  stop = true;
  other.join();
  return good;
}

// --- static destruction, in any order

int received = 0;

void count(const int& n) {
  received += n;
}

// Publishes when it goes, and ends the process with what came of it.
struct LastWord {
  ~LastWord() {
    defaultMessenger().publish<int>("n", 1);
    publisher.publish(10);
    std::_Exit(received == expected ? 0 : 1);
  }
  int expected;
  Publisher<int> publisher;
};

// Made first, so it goes when all others are gone.
bool lateOneSpeaksToNobody() {
  static LastWord word = {0, {}};
  word.publisher = defaultMessenger().advertise<int>("n");
  static const Subscriber subscriber = defaultMessenger().subscribe<int>("n", count);
  defaultMessenger().subscribe<int>("n", count).keep();
  return true;
}

bool earlyOneIsHeard() {
  defaultMessenger().subscribe<int>("n", count).keep();
  static const LastWord word = {11, defaultMessenger().advertise<int>("n")};
  return true;
}

bool subscribersOutliveTheDefaultMessenger() {
  static Subscriber queued;  // made before, goes after it, and after the pool
  static Subscriber pooled;
  static const auto pool = std::make_shared<gslam::ThreadPool>(1);
  queued = defaultMessenger().subscribe<int>("n", inOwnThread(), count);
  pooled = defaultMessenger().subscribe<int>("n", gslam::onExecutor(pool), [](const int&) {});
  for (int i = 0; i < 1000; ++i) defaultMessenger().publish<int>("n", i);
  return true;
}

bool subscribersOutliveTheirMessenger() {
  static Subscriber queued;
  static const Messenger messenger;
  queued = messenger.subscribe<int>("n", inOwnThread().drainAtEnd(), count);
  for (int i = 0; i < 1000; ++i) messenger.publish<int>("n", i);
  return true;
}

struct Scenario {
  const char* name;
  bool (*run)();
};
constexpr Scenario kScenarios[] = {
    {"child_leaves_messengers_alone", childLeavesMessengersAlone},
    {"child_makes_its_own", childMakesItsOwn},
    {"child_leaves_what_others_hold_alone", childLeavesWhatOthersHoldAlone},
    {"child_has_a_default_of_its_own", childHasADefaultOfItsOwn},
    {"late_one_speaks_to_nobody", lateOneSpeaksToNobody},
    {"early_one_is_heard", earlyOneIsHeard},
    {"subscribers_outlive_the_default_messenger", subscribersOutliveTheDefaultMessenger},
    {"subscribers_outlive_their_messenger", subscribersOutliveTheirMessenger},
};

}  // namespace

int main(int argc, char** argv) {
  for (const Scenario& scenario : kScenarios) {
    if (argc == 2 && std::strcmp(argv[1], scenario.name) == 0) return scenario.run() ? 0 : 1;
  }
  return 2;
}
