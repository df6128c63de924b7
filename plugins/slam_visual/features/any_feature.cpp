// Features of OpenCV's detectors that have their own scale space.
#include <gslam/base/error.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/features2d.hpp>
#include <string>

#include "features/even_choice.h"
#include "features/feature_extractor.h"
#include "features/grid_orb.h"

namespace visual {
namespace {

constexpr int kLeastSide = 32;  // pixels of an image in which OpenCV's detectors look for anything

struct Detector {
  const char* name;
  float least_size;  // of its features, pixels: those of octave 0
  cv::Ptr<cv::Feature2D> (*make)();
};

const Detector kDetectors[] = {
    {"sift", 1.8F, [] { return cv::Ptr<cv::Feature2D>(cv::SIFT::create()); }},
    {"akaze", 4.8F, [] { return cv::Ptr<cv::Feature2D>(cv::AKAZE::create()); }},
    {"brisk", 9.6F, [] { return cv::Ptr<cv::Feature2D>(cv::BRISK::create()); }},
    {"kaze", 3.2F, [] { return cv::Ptr<cv::Feature2D>(cv::KAZE::create()); }},
};

class AnyFeature : public FeatureExtractor {
 public:
  AnyFeature(const Detector& detector, const FeatureOptions& options)
      : options_(options),
        least_size_(detector.least_size),
        detector_(detector.make()),
        pyramid_(Levels(options.scale, options.levels)) {}

  void extract(const cv::Mat& grey, std::vector<gslam::Feature>& features,
               gslam::Image& descriptors) override {
    grey_ = grey;
    has_pyramid_ = false;
    features.clear();
    descriptors = gslam::Image();
    keys_.clear();
    if (std::min(grey.cols, grey.rows) < kLeastSide) return;
    detector_->detectAndCompute(grey, cv::noArray(), keys_, rows_);
    if (keys_.empty()) return;
    spots_.clear();
    for (const cv::KeyPoint& key : keys_) spots_.push_back({key.pt.x, key.pt.y, key.response});
    const SpotArea area = {0, 0, double(grey.cols), double(grey.rows)};
    const auto& chosen = choice_.choose(spots_, area, std::size_t(std::max(0, options_.count)));
    for (std::uint32_t at : chosen) features.push_back(featureOf(keys_[at]));
    copyRows(chosen, descriptors);
  }

  const Pyramid& pyramid() override {
    if (!has_pyramid_) pyramid_.build(grey_);
    has_pyramid_ = true;
    return pyramid_;
  }

 private:
  gslam::Feature featureOf(const cv::KeyPoint& key) const {
    gslam::Feature feature;
    feature.pixel = {key.pt.x, key.pt.y};
    feature.size = key.size;
    // OpenCV says degrees, -1 for none.
    feature.angle = key.angle < 0 ? 0 : float(double(key.angle) * CV_PI / 180);
    feature.response = key.response;
    const double level =
        std::log(std::max(1.0, double(key.size / least_size_))) / std::log(options_.scale);
    feature.octave = std::int16_t(std::min(int(std::lround(level)), pyramid_.count() - 1));
    return feature;
  }

  void copyRows(const std::vector<std::uint32_t>& chosen, gslam::Image& descriptors) const {
    if (chosen.empty()) return;
    const auto type = rows_.depth() == CV_8U ? gslam::PixelType::u8 : gslam::PixelType::f32;
    descriptors = gslam::Image(rows_.cols, int(chosen.size()), type);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      std::memcpy(descriptors.bytes(int(i)), rows_.ptr(int(chosen[i])), descriptors.rowBytes());
    }
  }

  FeatureOptions options_;
  float least_size_;
  cv::Ptr<cv::Feature2D> detector_;
  Pyramid pyramid_;
  bool has_pyramid_ = false;
  cv::Mat grey_, rows_;
  std::vector<cv::KeyPoint> keys_;
  std::vector<Spot> spots_;
  EvenChoice choice_;
};

}  // namespace

std::unique_ptr<FeatureExtractor> makeAnyFeature(const FeatureOptions& options) {
  std::string known = "orb";
  for (const Detector& detector : kDetectors) {
    if (options.detector == detector.name) return std::make_unique<AnyFeature>(detector, options);
    known += std::string(", ") + detector.name;
  }
  throw gslam::ArgumentError("detector",
                             "is \"" + options.detector + "\", expected one of: " + known);
}

std::unique_ptr<FeatureExtractor> makeFeatureExtractor(const FeatureOptions& options, int workers) {
  if (options.detector == "orb") return std::make_unique<GridOrb>(options, workers);
  return makeAnyFeature(options);
}

}  // namespace visual
