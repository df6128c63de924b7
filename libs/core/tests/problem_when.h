// What a call that must fail says.
#ifndef GSLAM_CORE_TESTS_PROBLEM_WHEN_H
#define GSLAM_CORE_TESTS_PROBLEM_WHEN_H

#include <gslam/base/error.h>

#include <string>

/// @tparam E  the only type of error that is expected; another one goes on
template <class E = gslam::Error, class Function>
std::string problemWhen(Function function) {
  try {
    function();
  } catch (const E& error) {
    return error.what();
  }
  return "nothing was thrown";
}

#endif  // GSLAM_CORE_TESTS_PROBLEM_WHEN_H
