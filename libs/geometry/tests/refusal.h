// What a call that must be refused says.
#ifndef GSLAM_GEOMETRY_TESTS_REFUSAL_H
#define GSLAM_GEOMETRY_TESTS_REFUSAL_H

#include <gslam/base/error.h>

#include <string>

template <class F>
std::string refusal(const F& call) {
  try {
    (void)call();
  } catch (const gslam::ArgumentError& error) {
    return error.what();
  }
  return "taken";
}

#endif  // GSLAM_GEOMETRY_TESTS_REFUSAL_H
