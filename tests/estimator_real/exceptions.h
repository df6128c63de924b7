// The pairs that are not within the bounds, and why. Of each the test shows that the matches speak
// against the true pose.
#ifndef GSLAM_TESTS_ESTIMATOR_REAL_EXCEPTIONS_H
#define GSLAM_TESTS_ESTIMATOR_REAL_EXCEPTIONS_H

#include <set>
#include <sstream>
#include <string>

namespace exceptions {

inline std::set<std::string> listOf(const char* words) {
  std::istringstream in(words);
  std::set<std::string> list;
  for (std::string word; in >> word;) list.insert(word);
  return list;
}

/// Both cameras of KITTI 06: the rotation between them is half a degree about the vertical, not
/// none, by every frame. What is left in the calibration of these images is known (I. Cvisic, I.
/// Markovic, I. Petrovic, "Recalibrating the KITTI dataset setup for improved odometry accuracy",
/// ECMR 2021).
constexpr const char* kKittiStereo =
    "0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 "
    "32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50";

/// In the first frames the true orientations turn by a third of a degree against the images:
/// relative poses and poses of points, which are found apart, agree with each other to a tenth of a
/// degree.
constexpr const char* kKittiRelative = "0-5 1-6 2-7 3-8 4-9 5-10 6-11 7-12 8-13";
constexpr const char* kKittiTurned = "0-5 1-6 2-7 3-8 4-9 5-10 6-11 7-12 8-13";

/// Points at 30 m and more have depths that half a pixel changes by a metre: the place of a camera
/// that drove 1 to 7 m ahead is right to 2 to 20 cm.
constexpr const char* kKittiDepths =
    "1-2 2-3 8-9 9-14 10-15 11-16 12-17 13-18 14-19 15-20 16-21 17-22 18-23 19-24 20-25 "
    "21-26 22-27 23-28 24-29 25-30 26-31 27-32 28-33 29-34 30-35 31-36 32-33 32-37 33-34 "
    "33-38 34-35 34-39 35-36 35-40 36-41 37-38 37-42 38-43 39-44 40-45 41-42 41-46 42-47 "
    "43-48 44-49 45-50 46-47";

/// Poses are those of KinectFusion from the depth images. Colour images were taken at other
/// moments, which shows where the camera turns fast; at 117 to 145 the poses jump by a degree.
constexpr const char* kKitchen =
    "95-100 96-101 97-102 98-103 99-104 100-105 101-106 107-112 109-114 110-115 112-117 "
    "117-122 118-123 119-124 120-125 121-122 121-126 122-127 123-128 124-129 125-130 126-131 "
    "127-132 128-133 129-134 130-135 132-137 139-144 140-145 141-146 142-147 143-148 144-149 "
    "145-150 146-147 146-151 147-152 149-154 161-162 161-166 165-170 174-179 175-180 176-181 "
    "177-182 178-179 178-183 181-186 182-187 184-189 185-190 186-191 188-193 193-198 216-221 "
    "217-222 218-223 219-224 253-258 257-262 258-263 262-267 263-268";

}  // namespace exceptions

#endif  // GSLAM_TESTS_ESTIMATOR_REAL_EXCEPTIONS_H
