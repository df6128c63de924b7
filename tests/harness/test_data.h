// Files below GSLAM_TEST_DATA, for the tests of all libraries.
#ifndef GSLAM_TESTS_HARNESS_TEST_DATA_H
#define GSLAM_TESTS_HARNESS_TEST_DATA_H

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace test_data {

/// The folder of the data with a slash at its end; empty where there is none.
inline std::string folder() {
  const char* const path = std::getenv("GSLAM_TEST_DATA");
  std::FILE* const found = path == nullptr ? nullptr : std::fopen(path, "r");
  if (found == nullptr) return "";
  std::fclose(found);
  return std::string(path) + "/";
}

inline bool isRequired() {
  const char* const ci = std::getenv("CI");
  return ci != nullptr && std::string(ci) == "true";
}

}  // namespace test_data

/// Skips the test where there is no data; where it must be, fails it.
#define NEEDS_TEST_DATA()                                                                  \
  do {                                                                                     \
    if (!test_data::folder().empty()) break;                                               \
    if (test_data::isRequired()) FAIL() << "GSLAM_TEST_DATA names no folder, but CI=true"; \
    GTEST_SKIP() << "GSLAM_TEST_DATA names no folder";                                     \
  } while (false)

#endif  // GSLAM_TESTS_HARNESS_TEST_DATA_H
