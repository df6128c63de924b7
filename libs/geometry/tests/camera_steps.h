// Numbers at equal distances, for loops.
#ifndef GSLAM_GEOMETRY_TESTS_CAMERA_STEPS_H
#define GSLAM_GEOMETRY_TESTS_CAMERA_STEPS_H

#include <vector>

/// first, first + step, ... below last.
inline std::vector<double> steps(double first, double last, double step) {
  std::vector<double> all;
  for (int i = 0; first + i * step < last; ++i) all.push_back(first + i * step);
  return all;
}

#endif  // GSLAM_GEOMETRY_TESTS_CAMERA_STEPS_H
