// main() of every benchmark: keeps a second thread alive while figures are taken. With one thread
// the C library skips the atomics of shared_ptr and of locks, which no SLAM system will ever see.
#include <benchmark/benchmark.h>

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace {

class SecondThread {
 public:
  SecondThread()
      : thread_([this] {
          std::unique_lock<std::mutex> lock(mutex_);
          end_.wait(lock, [this] { return ending_; });
        }) {}
  ~SecondThread() {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      ending_ = true;
    }
    end_.notify_one();
    thread_.join();
  }
  SecondThread(const SecondThread&) = delete;
  SecondThread& operator=(const SecondThread&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable end_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
#ifdef __OPTIMIZE__
  benchmark::AddCustomContext("code_build_type", "release");
#else
  benchmark::AddCustomContext("code_build_type", "debug");
#endif
#if defined(__clang__)
  benchmark::AddCustomContext("compiler", "clang++ " + std::to_string(__clang_major__));
#elif defined(__GNUC__)
  benchmark::AddCustomContext("compiler", "g++ " + std::to_string(__GNUC__));
#endif
  const SecondThread second_thread;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
