#include "stdout_guard.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace app {
namespace {

void flushAll() {
  std::cout.flush();
  std::fflush(stdout);
}

}  // namespace

StdoutGuard::StdoutGuard() : stdout_(fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 10)) {
  flushAll();
  if (stdout_ >= 0) dup2(STDERR_FILENO, STDOUT_FILENO);
}

StdoutGuard::~StdoutGuard() {
  flushAll();
  if (stdout_ < 0) return;
  dup2(stdout_, STDOUT_FILENO);
  close(stdout_);
}

}  // namespace app
