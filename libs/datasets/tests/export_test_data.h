// Files below GSLAM_TEST_DATA.
#ifndef GSLAM_DATASETS_TESTS_EXPORT_TEST_DATA_H
#define GSLAM_DATASETS_TESTS_EXPORT_TEST_DATA_H

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace export_test_data {

/// A folder below sequences/ with a slash at its end; empty where there is none.
inline std::string sequence(const std::string& name) {
  const char* const path = std::getenv("GSLAM_TEST_DATA");
  if (path == nullptr) return "";
  const std::string folder = std::string(path) + "/sequences/" + name + "/";
  return std::filesystem::is_directory(folder) ? folder : "";
}

inline bool isRequired() {
  const char* const ci = std::getenv("CI");
  return ci != nullptr && std::string(ci) == "true";
}

}  // namespace export_test_data

/// Skips the test where the sequence is missing; where it must be there, fails it.
#define NEEDS_SEQUENCE(name)                                                                \
  do {                                                                                      \
    if (!export_test_data::sequence(name).empty()) break;                                   \
    if (export_test_data::isRequired()) FAIL() << "no " << (name) << " in GSLAM_TEST_DATA"; \
    GTEST_SKIP() << "no " << (name) << " in GSLAM_TEST_DATA";                               \
  } while (false)

#endif  // GSLAM_DATASETS_TESTS_EXPORT_TEST_DATA_H
