// Runs tests/spender/spender.cpp as a child and talks to it.
#ifndef GSLAM_EVALUATION_TESTS_SPENDER_CHILD_H
#define GSLAM_EVALUATION_TESTS_SPENDER_CHILD_H

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <vector>

namespace spender {

class Child {
 public:
  // Waits until it is ready.
  explicit Child(std::vector<std::string> arguments,
                 const std::string& program = GSLAM_TEST_SPENDER) {
    int in[2], out[2];
    if (pipe2(in, O_CLOEXEC) != 0 || pipe2(out, O_CLOEXEC) != 0) ADD_FAILURE() << "no pipe";
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, in[0], 0);
    posix_spawn_file_actions_adddup2(&files, out[1], 1);
    arguments.insert(arguments.begin(), program);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(&argument[0]);
    pointers.push_back(nullptr);
    const int problem =
        posix_spawn(&number_, program.c_str(), &files, nullptr, pointers.data(), environ);
    EXPECT_EQ(problem, 0) << program;
    posix_spawn_file_actions_destroy(&files);
    close(in[0]);
    close(out[1]);
    in_ = in[1];
    out_ = out[0];
    EXPECT_EQ(line(), "ready");
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { end(); }

  void go() { EXPECT_EQ(write(in_, "\n", 1), 1); }
  // Until the line end, without it.
  std::string line() {
    std::string text;
    char byte = 0;
    while (read(out_, &byte, 1) == 1 && byte != '\n') text += byte;
    return text;
  }
  void end() {
    if (number_ <= 0) return;
    close(in_);
    close(out_);
    waitpid(number_, nullptr, 0);
    number_ = -1;
  }
  long number() const { return number_; }

 private:
  pid_t number_ = -1;
  int in_ = -1, out_ = -1;
};

inline double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Whether programs can count here: not with a sanitizer.
inline constexpr bool canCount() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
  return false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
  return false;
#else
  return true;
#endif
#else
  return true;
#endif
}

// A sanitizer may have a thread of its own.
constexpr std::size_t kOtherThreads = canCount() ? 0 : 1;

}  // namespace spender

#endif  // GSLAM_EVALUATION_TESTS_SPENDER_CHILD_H
