// What is thrown where something must be.
#ifndef GSLAM_DATASETS_TESTS_THROWN_H
#define GSLAM_DATASETS_TESTS_THROWN_H

#include <gslam/base/error.h>
#include <gtest/gtest.h>

#include <string>

/// The text of the error of this type that an action throws.
template <class E = gslam::Error, class Action>
std::string thrownBy(const Action& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

#endif  // GSLAM_DATASETS_TESTS_THROWN_H
