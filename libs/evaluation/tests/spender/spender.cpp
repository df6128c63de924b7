// A program whose cost is known:
//
//   spender blocks N SIZE T   makes N blocks on each of T threads, and frees half of them
//   spender burn SECONDS T    CPU time, on each of T threads
//   spender touch MB          writes to so much memory
//   spender children N S      starts N processes, one after the other, that burn S seconds each
//   spender ignored N S       the same, but is not told of their ends
//   spender orphan S          a child's child that burns S seconds and lives on without its parent
//   spender switch N          waits N times
//   spender affinity          prints the cores that it may run on
//   spender kinds             counts each way to get memory, and says what is expected
//   spender fork N            makes N blocks in a forked child, and prints what that counted
//   spender many N C          C children, one after the other, each of which makes N blocks
//   spender forks N           makes N blocks in a child of a child, and in a spender that one
//   starts spender crowd T N         T threads at once, each of which makes and frees N blocks
//   spender spawn N           has another spender make N blocks
//   spender demand MB         prints whether it gets so much memory
//
// It says "ready" and waits for a line, spends, and says "done" with what its own count of
// allocations is, and waits for the end of its input. An isolation worker, it has a SLAM system
// "spender" that spends on each frame what its parameters say.
#include <fcntl.h>
#include <gslam/core/isolation_worker.h>
#include <gslam/evaluation/allocation_counts.h>
#include <gslam/evaluation/limits.h>
#include <gslam/evaluation/process_usage.h>
#include <malloc.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace {

double threadSeconds() {
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

void burn(double seconds) {
  const double end = threadSeconds() + seconds;
  volatile double sum = 0;
  while (threadSeconds() < end) {
    for (int i = 0; i < 1000; ++i) sum = sum + 1.0 / (i + 1);
  }
}

// The blocks stand in memory that is no block, so that their number is all there is to count.
constexpr int kMostBlocks = 1 << 20;
void* blocks[kMostBlocks];

void makeBlocks(int begin, int count, std::size_t size) {
  for (int i = begin; i < begin + count; ++i) {
    blocks[i] = std::malloc(size);
    static_cast<volatile char*>(blocks[i])[0] = 1;
  }
  for (int i = begin; i < begin + count; i += 2) std::free(blocks[i]);
}

void onThreads(int count, const std::function<void(int)>& work) {
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i) threads.emplace_back(work, i);
  for (std::thread& thread : threads) thread.join();
}

void childrenThatBurn(int count, double seconds) {
  for (int i = 0; i < count; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      burn(seconds);
      _exit(0);
    }
    while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
}

void orphan(double seconds) {
  int ends[2];
  if (pipe(ends) != 0) return;
  const pid_t child = fork();
  if (child == 0) {
    if (fork() == 0) {
      usleep(300000);  // until somebody saw it
      burn(seconds);
      usleep(300000);
      _exit(0);
    }
    usleep(200000);
    _exit(0);
  }
  close(ends[1]);
  waitpid(child, nullptr, 0);
  char byte = 0;
  while (read(ends[0], &byte, 1) < 0) {  // until the child's child has ended, too
  }
}

// What one way to get memory counts. The compiler may not leave out what looks useless.
void count(const char* name, int calls, int frees, int bytes, void (*function)()) {
  const gslam::AllocationCounts before = gslam::allocationCounts();
  function();
  const gslam::AllocationCounts done = gslam::allocatedBetween(before, gslam::allocationCounts());
  std::printf("%s %d %d %d expected %d %d %d\n", name, int(done.calls), int(done.frees),
              int(done.bytes), calls, frees, bytes);
}

void* volatile kept;

void countKinds() {
  struct alignas(128) Aligned {
    char bytes[256];
  };
  count("malloc", 1, 1, 10, [] {
    kept = std::malloc(10);
    std::free(kept);
  });
  count("malloc_of_0", 1, 1, 0, [] {
    kept = std::malloc(0);
    std::free(kept);
  });
  count("free_of_null", 0, 0, 0, [] {
    kept = nullptr;
    std::free(kept);
  });
  count("calloc", 1, 1, 60, [] {
    kept = std::calloc(3, 20);
    if (static_cast<char*>(kept)[59] != 0) std::abort();
    std::free(kept);
  });
  count("realloc", 3, 3, 10 + 10000 + 5, [] {
    kept = std::realloc(nullptr, 10);
    kept = std::realloc(kept, 10000);
    kept = std::realloc(kept, 5);
    std::free(kept);
  });
  count("realloc_to_0", 1, 1, 10, [] {
    kept = std::malloc(10);
    kept = std::realloc(kept, 0);
    if (kept != nullptr) std::abort();
  });
  count("too_much", 1, 1, 10, [] {
    volatile std::size_t size = std::size_t(1) << 62;
    kept = std::malloc(size);
    if (kept != nullptr) std::abort();
    kept = std::calloc(size, 16);
    if (kept != nullptr) std::abort();
    void* volatile block = std::malloc(10);
    kept = std::realloc(block, size);
    if (kept != nullptr) std::abort();
    std::free(block);  // is still there
  });
  count("aligned_alloc", 1, 1, 4096, [] {
    kept = std::aligned_alloc(1024, 4096);
    if (reinterpret_cast<std::uintptr_t>(kept) % 1024 != 0) std::abort();
    std::free(kept);
  });
  count("aligned_to_3", 0, 0, 0, [] {
    volatile std::size_t three = 3;
    kept = std::aligned_alloc(three, 300);
    if (kept != nullptr || errno != EINVAL) std::abort();
  });
  count("posix_memalign", 1, 1, 100, [] {
    void* block = nullptr;
    if (posix_memalign(&block, 64, 100) != 0) std::abort();
    if (posix_memalign(&block, 4, 100) != EINVAL) std::abort();
    kept = block;
    if (reinterpret_cast<std::uintptr_t>(kept) % 64 != 0) std::abort();
    std::free(kept);
  });
  count("memalign", 1, 1, 100, [] {
    kept = memalign(256, 100);
    std::free(kept);
  });
  count("valloc", 1, 1, 100, [] {
    kept = valloc(100);
    std::free(kept);
  });
  count("pvalloc", 1, 1, 100, [] {
    kept = pvalloc(100);
    std::free(kept);
  });
  count("reallocarray", 1, 1, 600, [] {
    kept = reallocarray(nullptr, 30, 20);
    std::free(kept);
  });
  count("strdup", 1, 1, 6, [] {
    kept = strdup("hello");
    std::free(kept);
  });
  count("new", 1, 1, 400, [] {
    kept = new int[100];
    delete[] static_cast<int*>(kept);
  });
  count("new_aligned", 1, 1, 256, [] {
    kept = new Aligned;
    delete static_cast<Aligned*>(kept);
  });
}

// Nor does measuring itself count, once it has its memory.
void countReadings() {
  static gslam::ProcessTree tree;
  tree.read();
  tree.read();
  count("reading_a_process", 0, 0, 0, [] { tree.read(); });
  count("reading_its_clock", 0, 0, 0, [] { tree.cpuTime(); });
  count("counting", 0, 0, 0, [] { gslam::allocationCountsOf(0); });
  // Also with a child of many threads.
  int ready[2];
  if (pipe(ready) != 0) return;
  const pid_t child = fork();
  if (child == 0) {
    std::vector<std::thread> threads;
    for (int i = 0; i < 16; ++i) threads.emplace_back([] { pause(); });
    if (write(ready[1], "", 1) == 1) pause();
    _exit(0);
  }
  char byte = 0;
  if (read(ready[0], &byte, 1) != 1) std::abort();
  tree.read();
  tree.read();
  count("reading_many_threads", 0, 0, 0, [] { tree.read(); });
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

void forkAndCount(int blocks_of_child) {
  const pid_t child = fork();
  if (child == 0) {
    const gslam::AllocationCounts before = gslam::allocationCounts();
    makeBlocks(0, blocks_of_child, 100);
    const gslam::AllocationCounts done = gslam::allocatedBetween(before, gslam::allocationCounts());
    std::printf("child %d %d\n", int(done.is_counted), int(done.calls));
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

void spawn(const char* program, int blocks_of_child);

// Children that are gone one after the other; every other one is another program.
void many(const char* program, int blocks_of_each, int children) {
  for (int i = 0; i < children; ++i) {
    if (i % 2 == 0) {
      spawn(program, blocks_of_each);
      continue;
    }
    const pid_t child = fork();
    if (child == 0) {
      makeBlocks(0, blocks_of_each, 10);
      _exit(0);
    }
    waitpid(child, nullptr, 0);
  }
}

void forkTwice(const char* program, int blocks_of_each) {
  const pid_t child = fork();
  if (child == 0) {
    const pid_t grandchild = fork();
    if (grandchild == 0) {
      makeBlocks(0, blocks_of_each, 10);
      spawn(program, blocks_of_each);
      _exit(0);
    }
    waitpid(grandchild, nullptr, 0);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

// All at once, while others are forked.
void crowd(int threads, int blocks_of_each) {
  std::mutex mutex;
  std::condition_variable changed;
  int waiting = 0;
  std::atomic<bool> is_over(false);
  std::thread forking([&] {
    for (int i = 0; i < 10 || !is_over; ++i) {
      const pid_t child = fork();
      if (child == 0) {
        kept = std::malloc(10);
        std::free(kept);
        _exit(0);
      }
      waitpid(child, nullptr, 0);
      usleep(20000);
    }
  });
  onThreads(threads, [&](int) {
    {
      std::unique_lock<std::mutex> lock(mutex);
      if (++waiting == threads) changed.notify_all();
      changed.wait(lock, [&] { return waiting == threads; });  // all have a place, or none
    }
    for (int i = 0; i < blocks_of_each; ++i) {
      void* const block = std::malloc(std::size_t(100 + i));
      static_cast<volatile char*>(block)[0] = 1;
      std::free(block);
    }
  });
  is_over = true;
  forking.join();
}

void spawn(const char* program, int blocks_of_other) {
  int out[2];
  if (pipe(out) != 0) return;
  const std::string number = std::to_string(blocks_of_other);
  const pid_t child = fork();
  if (child == 0) {
    dup2(open("/dev/null", O_RDONLY), 0);
    dup2(out[1], 1);
    execl(program, program, "blocks", number.c_str(), "10", "1", nullptr);
    _exit(1);
  }
  waitpid(child, nullptr, 0);
}

class SpenderSlam : public gslam::Slam {
 public:
  void configure(const gslam::SlamSetup& setup) override {
    pose_ = setup.messenger.advertise<gslam::TrackedPose>("pose");
    blocks_ = setup.parameters["blocks"].as<int>();
    seconds_ = setup.parameters["seconds"].as<double>();
  }
  void feed(const std::shared_ptr<const gslam::Frame>& frame) override {
    makeBlocks(0, blocks_, 100);
    burn(seconds_);
    for (int i = 1; i < blocks_; i += 2) std::free(blocks[i]);
    pose_.publish({frame->id, frame->stamp, gslam::SE3d(), gslam::TrackingState::tracking});
  }
  std::shared_ptr<const gslam::Map> map() override { return nullptr; }
  void finish() override {}

 private:
  gslam::Publisher<gslam::TrackedPose> pose_;
  int blocks_ = 0;
  double seconds_ = 0;
};

void addSlam(gslam::Plugins& plugins) {
  gslam::SlamFactory factory;
  factory.name = "spender";
  factory.parameters = gslam::Svar::object({{"blocks", 0}, {"seconds", 0.0}});
  factory.make = [] { return std::unique_ptr<gslam::Slam>(new SpenderSlam); };
  plugins.add(factory);
}

std::string number(int argc, char** argv, int i) {
  return i < argc ? argv[i] : "1";
}

int runCommand(int argc, char** argv) {
  const std::string command = argv[1];
  const int first = std::atoi(number(argc, argv, 2).c_str());
  const double seconds = std::atof(number(argc, argv, command == "burn" ? 2 : 3).c_str());
  const int third = std::atoi(number(argc, argv, 4).c_str());
  const auto waitForLine = [] {
    char byte = 0;
    while (read(0, &byte, 1) == 1 && byte != '\n') {
    }
  };
  std::setvbuf(stdout, nullptr, _IONBF, 0);
  std::printf("ready\n");
  waitForLine();
  if (command == "blocks") {
    const std::size_t size = std::size_t(std::atoi(number(argc, argv, 3).c_str()));
    if (first * third > kMostBlocks) return 3;
    if (third == 1) {
      const gslam::AllocationCounts before = gslam::allocationCounts();
      makeBlocks(0, first, size);
      const gslam::AllocationCounts done =
          gslam::allocatedBetween(before, gslam::allocationCounts());
      std::printf("%d %llu %llu %llu %lld %lld\n", int(done.is_counted),
                  static_cast<unsigned long long>(done.calls),
                  static_cast<unsigned long long>(done.bytes),
                  static_cast<unsigned long long>(done.frees),
                  static_cast<long long>(done.live_blocks - before.live_blocks),
                  static_cast<long long>(done.live_bytes - before.live_bytes));
    } else {
      onThreads(third, [&](int i) { makeBlocks(i * first, first, size); });
    }
  } else if (command == "burn") {
    onThreads(std::atoi(number(argc, argv, 3).c_str()), [&](int) { burn(seconds); });
  } else if (command == "touch") {
    const std::size_t size = std::size_t(first) * 1000000;
    char* const memory = static_cast<char*>(std::malloc(size));
    std::memset(memory, 1, size);
    std::printf("touched %d\n", int(memory[size - 1]));
    waitForLine();
    std::free(memory);
  } else if (command == "children" || command == "ignored") {
    if (command == "ignored") signal(SIGCHLD, SIG_IGN);
    childrenThatBurn(first, seconds);
  } else if (command == "orphan") {
    orphan(std::atof(number(argc, argv, 2).c_str()));
  } else if (command == "switch") {
    for (int i = 0; i < first; ++i) usleep(100);
  } else if (command == "affinity") {
    for (const int cpu : gslam::cpuAffinity()) std::printf("%d ", cpu);
    std::printf("\n");
  } else if (command == "kinds") {
    countKinds();
    countReadings();
  } else if (command == "fork") {
    forkAndCount(first);
  } else if (command == "many") {
    many(argv[0], first, std::atoi(number(argc, argv, 3).c_str()));
  } else if (command == "forks") {
    forkTwice(argv[0], first);
  } else if (command == "crowd") {
    crowd(first, std::atoi(number(argc, argv, 3).c_str()));
  } else if (command == "spawn") {
    spawn(argv[0], first);
  } else if (command == "demand") {
    const std::size_t size = std::size_t(first) * 1000000;
    char* const memory = static_cast<char*>(std::malloc(size));
    if (memory != nullptr) std::memset(memory, 1, size);
    std::printf("%s\n", memory != nullptr ? "got" : "refused");
    std::free(memory);
  } else {
    return 2;
  }
  std::printf("done\n");
  waitForLine();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (gslam::isIsolationWorker(argc, argv)) return gslam::runIsolationWorker(argc, argv, addSlam);
  return argc < 2 ? 2 : runCommand(argc, argv);
}
