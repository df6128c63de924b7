// Folders and archives that tests of readers write.
#ifndef GSLAM_DATASETS_TESTS_READING_CASE_H
#define GSLAM_DATASETS_TESTS_READING_CASE_H

#include <gslam/core/dataset.h>
#include <gslam/core/image.h>
#include <gslam/core/parameters.h>
#include <gslam/core/registry.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "new_folder.h"
#include "words.h"

namespace reading_case {

namespace fs = std::filesystem;

/// A new folder that goes with this, and what is written into it.
class TempFolder : public NewFolder {
 public:
  /// Writes a file, and makes the folders it is in.
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(*this / name).parent_path());
    std::ofstream(*this / name, std::ios::binary) << text;
  }
  /// Writes an image of random pixels.
  cv::Mat writeImage(const std::string& name, int seed, int type = CV_8UC1, int width = 16,
                     int height = 12) const {
    fs::create_directories(fs::path(*this / name).parent_path());
    cv::Mat pixels(height, width, type);
    cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
    random.fill(pixels, cv::RNG::UNIFORM, 0, CV_MAT_DEPTH(type) == CV_16U ? 65536 : 256);
    if (!cv::imwrite(*this / name, pixels)) std::abort();
    return pixels;
  }
};

inline std::string textOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

/// Puts all files of a folder into a zip archive, compressed, below a folder in it.
inline void zipFolder(const std::string& folder, const std::string& archive,
                      const std::string& inside = "") {
  int problem = 0;
  zip_t* const zip = zip_open(archive.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &problem);
  if (zip == nullptr) std::abort();
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = inside + fs::relative(entry.path(), folder).string();
    zip_source_t* const source = zip_source_file(zip, entry.path().c_str(), 0, -1);
    if (zip_file_add(zip, name.c_str(), source, ZIP_FL_ENC_UTF_8) < 0) std::abort();
  }
  if (zip_close(zip) != 0) std::abort();
}

/// Opens with some parameters laid over the defaults.
inline std::unique_ptr<gslam::Dataset> openWith(
    const gslam::DatasetFactory& factory, const std::string& path,
    const gslam::Svar& parameters = gslam::Svar::object()) {
  return factory.open(path, gslam::completeParameters(factory.parameters, parameters));
}

inline std::vector<std::shared_ptr<const gslam::Frame>> allFrames(gslam::Dataset& dataset) {
  std::vector<std::shared_ptr<const gslam::Frame>> frames;
  while (auto frame = dataset.next()) frames.push_back(std::move(frame));
  return frames;
}

/// Whether an image has the pixels of a matrix.
inline bool isSame(const gslam::Image& image, const cv::Mat& pixels) {
  if (image.width() != pixels.cols || image.height() != pixels.rows ||
      image.channels() != pixels.channels() || int(image.type()) != pixels.depth()) {
    return false;
  }
  for (int y = 0; y < pixels.rows; ++y) {
    if (!std::equal(image.bytes(y), image.bytes(y) + image.rowBytes(), pixels.ptr(y))) return false;
  }
  return true;
}

/// Whether one of the remarks has a text in it.
inline bool hasRemark(const gslam::DatasetInfo& info, const std::string& text) {
  return says(info.remarks, text);
}

/// What an action throws, which must be a gslam::Error; empty where it throws nothing.
template <class Action>
std::string messageOf(const Action& action) {
  try {
    action();
  } catch (const gslam::Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace reading_case

#endif  // GSLAM_DATASETS_TESTS_READING_CASE_H
