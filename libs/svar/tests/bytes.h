// Texts with zero bytes.
#ifndef GSLAM_SVAR_TESTS_BYTES_H
#define GSLAM_SVAR_TESTS_BYTES_H

#include <cstddef>
#include <string>

// A literal with all its bytes, zero bytes among them.
template <std::size_t size>
std::string bytes(const char (&text)[size]) {
  return std::string(text, size - 1);
}

#endif  // GSLAM_SVAR_TESTS_BYTES_H
