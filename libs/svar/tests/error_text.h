// What a call that must be refused says.
#ifndef GSLAM_SVAR_TESTS_ERROR_TEXT_H
#define GSLAM_SVAR_TESTS_ERROR_TEXT_H

#include <gslam/svar/error.h>

#include <string>

template <class F>
std::string errorText(F call) {
  try {
    call();
  } catch (const gslam::SvarError& error) {
    return error.what();
  }
  return "(no error)";
}

#endif  // GSLAM_SVAR_TESTS_ERROR_TEXT_H
