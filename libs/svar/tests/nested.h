// A value that overflows the stack of whatever recurses.
#ifndef GSLAM_SVAR_TESTS_NESTED_H
#define GSLAM_SVAR_TESTS_NESTED_H

#include <gslam/svar.h>

#include <utility>

// [[[...]]] in turns with {"a": {"a": ...}}.
inline gslam::Svar nested(int depth) {
  gslam::Svar value;
  for (int i = 0; i < depth; ++i) {
    gslam::Svar outer =
        i % 3 == 0 ? gslam::Svar::object({{"a", value}}) : gslam::Svar::array({value});
    value = std::move(outer);
  }
  return value;
}

#endif  // GSLAM_SVAR_TESTS_NESTED_H
