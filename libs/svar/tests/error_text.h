// What a call that must be refused says.
#ifndef GSLAM_SVAR_TESTS_ERROR_TEXT_H
#define GSLAM_SVAR_TESTS_ERROR_TEXT_H

#include <gslam/svar/error.h>

#include <string>

/// @tparam E  the only type of error that is expected; another one goes on
template <class E = gslam::SvarError, class F>
std::string errorText(F call) {
  try {
    call();
  } catch (const E& error) {
    return error.what();
  }
  return "(no error)";
}

#endif  // GSLAM_SVAR_TESTS_ERROR_TEXT_H
