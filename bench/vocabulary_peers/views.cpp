#include "views.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr int kMostFeatures = 1000;
constexpr int kRendered = 24;

// A wall with posters: shapes and writing of all sizes over noise of all sizes.
cv::Mat renderImage(std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat image(kHeight, kWidth, CV_8U, cv::Scalar(random.uniform(60, 190)));
  for (int size = 8; size <= 128; size *= 2) {
    cv::Mat noise(kHeight / size + 2, kWidth / size + 2, CV_8U), large;
    random.fill(noise, cv::RNG::UNIFORM, 0, 24);
    cv::resize(noise, large, image.size(), 0, 0, cv::INTER_CUBIC);
    image += large;
    image -= cv::Scalar(12);
  }
  const auto point = [&] {
    return cv::Point(random.uniform(0, kWidth), random.uniform(0, kHeight));
  };
  for (int i = 0; i < 260; ++i) {
    const int size = static_cast<int>(4 * std::exp(random.uniform(0.0, 3.2)));
    const cv::Scalar grey(random.uniform(0, 256));
    const cv::Point at = point();
    switch (random.uniform(0, 4)) {
      case 0:
        cv::ellipse(image, at, cv::Size(size, 1 + size * random.uniform(2, 10) / 10),
                    random.uniform(0, 180), 0, 360, grey, random.uniform(0, 3) - 1, cv::LINE_AA);
        break;
      case 1: {
        std::vector<cv::Point> corners;
        for (int corner = 0; corner < 4; ++corner) {
          corners.push_back(
              at + cv::Point(random.uniform(-size, size + 1), random.uniform(-size, size + 1)));
        }
        cv::fillConvexPoly(image, corners, grey, cv::LINE_AA);
        break;
      }
      case 2:
        cv::line(image, at, point(), grey, random.uniform(1, 4), cv::LINE_AA);
        break;
      default: {
        std::string text;
        for (int letter = 0; letter < 6; ++letter) {
          text += static_cast<char>('A' + random.uniform(0, 57) % 58);
        }
        cv::putText(image, text, at, random.uniform(0, 8), 0.3 + size / 60.0, grey, 1 + size / 40,
                    cv::LINE_AA);
      }
    }
  }
  return image;
}

struct Album {
  const char* folder;
  const char* ending;
  std::size_t step;  // one of how many is taken
};

std::vector<std::string> photographs() {
  const char* const root = std::getenv("GSLAM_TEST_DATA");
  std::vector<std::string> found;
  if (root == nullptr) return found;
  const Album albums[] = {{"vocabularies/slambook_images", ".png", 1},
                          {"sequences/kitti_06/sequences/06/image_0", ".png", 10},
                          {"sequences/7scenes_redkitchen", ".color.jpg", 30},
                          {"sequences/tum_rgbd_freiburg1_rpy/rgb", ".png", 12},
                          {"sfm/strecha_fountain_P11/images", ".jpg", 1}};
  for (const Album& album : albums) {
    std::vector<std::string> names;
    std::error_code absent;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(root) / album.folder, absent)) {
      const std::string name = entry.path().string(), ending = album.ending;
      if (name.size() > ending.size() &&
          name.compare(name.size() - ending.size(), ending.size(), ending) == 0) {
        names.push_back(name);
      }
    }
    std::sort(names.begin(), names.end());
    for (std::size_t i = 0; i < names.size(); i += album.step) found.push_back(names[i]);
  }
  return found;
}

// All of the same height and width, so that they are seen at about the same scale.
const std::vector<cv::Mat>& images() {
  static const std::vector<cv::Mat> made = [] {
    std::vector<cv::Mat> all;
    for (int i = 0; i < kRendered; ++i) all.push_back(renderImage(1000 + std::uint64_t(i)));
    for (const std::string& path : photographs()) {
      const cv::Mat photograph = cv::imread(path, cv::IMREAD_GRAYSCALE);
      if (photograph.empty()) throw std::runtime_error(path + " is no image");
      cv::Mat same_size;
      const double scale =
          std::max(double(kWidth) / photograph.cols, double(kHeight) / photograph.rows);
      cv::resize(photograph, same_size, cv::Size(), scale, scale,
                 scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
      all.push_back(same_size);
    }
    return all;
  }();
  return made;
}

// A camera that moved in front of the picture.
cv::Mat viewOf(const cv::Mat& image, cv::RNG& random) {
  const double angle = random.uniform(-0.5, 0.5);
  const double scale = std::exp(random.uniform(-0.1, 0.5));
  const double c = std::cos(angle) * scale, s = std::sin(angle) * scale;
  const double x = random.uniform(0.3, 0.7) * image.cols, y = random.uniform(0.3, 0.7) * image.rows;
  const double tilt_x = random.uniform(-2e-4, 2e-4), tilt_y = random.uniform(-2e-4, 2e-4);
  const cv::Matx33d to_origin(1, 0, -x, 0, 1, -y, 0, 0, 1);
  const cv::Matx33d turn(c, -s, 0, s, c, 0, tilt_x, tilt_y, 1);
  const cv::Matx33d to_middle(1, 0, kWidth / 2.0, 0, 1, kHeight / 2.0, 0, 0, 1);
  cv::Mat view, noise(kHeight, kWidth, CV_16S);
  cv::warpPerspective(image, view, to_middle * turn * to_origin, cv::Size(kWidth, kHeight),
                      cv::INTER_LINEAR, cv::BORDER_REFLECT_101);
  if (random.uniform(0, 2) == 0) cv::GaussianBlur(view, view, {}, random.uniform(0.5, 1.3));
  random.fill(noise, cv::RNG::NORMAL, 0, 3);
  cv::Mat lit;
  view.convertTo(lit, CV_16S, random.uniform(0.7, 1.3), random.uniform(-20.0, 20.0));
  lit += noise;
  lit.convertTo(view, CV_8U);
  return view;
}

Rows describe(Feature feature, const cv::Mat& view) {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  if (feature == Feature::orb) {
    static const cv::Ptr<cv::ORB> orb =
        cv::ORB::create(kMostFeatures, 1.2F, 8, 19, 0, 2, cv::ORB::HARRIS_SCORE, 31, 7);
    orb->detectAndCompute(view, cv::noArray(), points, descriptors);
  } else {
    static const cv::Ptr<cv::SIFT> sift = cv::SIFT::create(kMostFeatures, 3, 0.02);
    cv::Mat numbers;
    sift->detectAndCompute(view, cv::noArray(), points, numbers);
    numbers.convertTo(descriptors, CV_8U);
  }
  if (descriptors.rows > kMostFeatures) descriptors.resize(kMostFeatures);
  return Rows(descriptors.datastart, descriptors.datastart + descriptors.total());
}

std::vector<Rows> describeNew(Feature feature, std::size_t count, std::uint32_t seed) {
  std::vector<Rows> views(count);
  for (std::size_t i = 0; i < count; ++i) {
    cv::RNG random((std::uint64_t(seed) << 32) + i + 1);
    views[i] = describe(feature, viewOf(images()[i % images().size()], random));
  }
  return views;
}

// The file: the bytes of each view, a number on a line; then all rows. Nothing when it is not there
// or too short.
std::vector<Rows> readCache(const std::string& path, std::size_t count) {
  std::ifstream file(path, std::ios::binary);
  std::vector<Rows> views(count);
  for (Rows& view : views) {
    std::size_t size = 0;
    file >> size;
    view.resize(file && size < 1000000 ? size : 0);
  }
  file.get();
  for (Rows& view : views) {
    file.read(reinterpret_cast<char*>(view.data()), static_cast<std::streamsize>(view.size()));
  }
  return file ? views : std::vector<Rows>();
}

void writeCache(const std::string& path, const std::vector<Rows>& views) {
  {
    std::ofstream file(path + ".new", std::ios::binary);
    for (const Rows& view : views) file << view.size() << '\n';
    for (const Rows& view : views) {
      file.write(reinterpret_cast<const char*>(view.data()),
                 static_cast<std::streamsize>(view.size()));
    }
    if (!file.flush()) throw std::runtime_error(path + " cannot be written");
  }
  std::filesystem::rename(path + ".new", path);
}

}  // namespace

std::string cacheFolder() {
  const char* const named = std::getenv("GSLAM_PEERS_CACHE");
  const std::filesystem::path folder =
      named != nullptr ? std::filesystem::path(named)
                       : std::filesystem::temp_directory_path() / "gslam_vocabulary_peers";
  std::filesystem::create_directories(folder);
  return folder.string() + "/";
}

std::string cacheKey(Feature feature, std::uint32_t seed) {
  return std::string(feature == Feature::orb ? "orb" : "sift") + "_seed" + std::to_string(seed) +
         "_photographs" + std::to_string(photographs().size()) + "_opencv" CV_VERSION;
}

std::vector<Rows> describeViews(Feature feature, std::size_t count, std::uint32_t seed) {
  const std::string path =
      cacheFolder() + cacheKey(feature, seed) + "_views" + std::to_string(count);
  std::vector<Rows> views = readCache(path, count);
  if (!views.empty()) return views;
  std::cerr << "describing " << count << " views, kept in " << path << '\n';
  views = describeNew(feature, count, seed);
  writeCache(path, views);
  return views;
}
