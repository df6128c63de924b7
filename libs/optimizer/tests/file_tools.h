// What tests of files share.
#ifndef GSLAM_OPTIMIZER_TESTS_FILE_TOOLS_H
#define GSLAM_OPTIMIZER_TESTS_FILE_TOOLS_H

#include <gslam/base/error.h>
#include <gslam/optimizer/bundle.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

namespace file_tools {

/// A folder of its own for a test, gone at the end.
class NewFolder {
 public:
  NewFolder() {
    std::random_device random;
    const std::string name = "gslam_optimizer_" + std::to_string(random());
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::create_directories(path_);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Half the sum of squared residuals of a bundle whose cameras are all radtan with k1 and k2 alone,
/// in long double, also of points behind the camera.
inline double radialCost(const gslam::Bundle& bundle) {
  long double sum = 0;
  for (std::size_t i = 0; i < bundle.pixels.size(); ++i) {
    const gslam::SE3d& pose = bundle.T_world_body[bundle.observation_pose[i]];
    const auto values = bundle.cameras[bundle.observation_camera[i]].parameters();
    const gslam::Vec3d p = pose.inverse() * bundle.points[bundle.observation_point[i]];
    const long double x = p[0] / static_cast<long double>(p[2]);
    const long double y = p[1] / static_cast<long double>(p[2]);
    const long double s = x * x + y * y;
    const long double g = 1 + s * (values[4] + s * values[5]);
    const long double u = values[0] * g * x + values[2] - bundle.pixels[i][0];
    const long double v = values[1] * g * y + values[3] - bundle.pixels[i][1];
    sum += u * u + v * v;
  }
  return static_cast<double>(sum / 2);
}

/// Expects a ParseError at a line with some words.
template <class Parse>
void expectParseError(const Parse& parse, std::size_t line, const std::string& words) {
  try {
    parse();
    ADD_FAILURE() << "nothing is thrown, expected: " << words;
  } catch (const gslam::ParseError& error) {
    EXPECT_EQ(error.line(), line) << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

/// Expects an ArgumentError with some words.
template <class Call>
void expectArgumentError(const Call& call, const std::string& words) {
  try {
    call();
    ADD_FAILURE() << "nothing is thrown, expected: " << words;
  } catch (const gslam::ArgumentError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

/// Every beginning of a text is read, or refused with a ParseError.
template <class Parse>
void expectNoCrashForBeginnings(const std::string& text, const Parse& parse) {
  std::size_t refused = 0;
  for (std::size_t size = 0; size < text.size(); ++size) {
    try {
      parse(text.substr(0, size));
    } catch (const gslam::ParseError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, text.size() / 2);
}

}  // namespace file_tools

#endif  // GSLAM_OPTIMIZER_TESTS_FILE_TOOLS_H
