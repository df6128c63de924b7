#include "image_features.h"

#include <gslam/base/error.h>
#include <gslam/base/parallel.h>

#include <algorithm>
#include <numeric>
#include <thread>

namespace app {
namespace {

cv::Ptr<cv::Feature2D> makeDetector(const std::string& kind, std::size_t most) {
  const int count = static_cast<int>(most);
  if (kind == "orb") return cv::ORB::create(count);
  if (kind == "sift") return cv::SIFT::create(count);
  if (kind == "brisk") return cv::BRISK::create();
  return cv::AKAZE::create();
}

// Some detectors know no limit: the strongest features stay, in their order.
cv::Mat strongest(const std::vector<cv::KeyPoint>& points, const cv::Mat& descriptors,
                  std::size_t most) {
  if (points.size() <= most) return descriptors;
  std::vector<int> rows(points.size());
  std::iota(rows.begin(), rows.end(), 0);
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) {
    return points[static_cast<std::size_t>(a)].response >
           points[static_cast<std::size_t>(b)].response;
  });
  rows.resize(most);
  std::sort(rows.begin(), rows.end());
  cv::Mat kept(static_cast<int>(most), descriptors.cols, descriptors.type());
  for (int i = 0; i < kept.rows; ++i) {
    descriptors.row(rows[static_cast<std::size_t>(i)]).copyTo(kept.row(i));
  }
  return kept;
}

}  // namespace

const std::vector<FeatureKind>& featureKinds() {
  static const std::vector<FeatureKind> kinds = {
      {"orb", true, 32}, {"sift", false, 128}, {"brisk", true, 64}, {"akaze", true, 61}};
  return kinds;
}

std::vector<std::string> featureNames() {
  std::vector<std::string> names;
  for (const FeatureKind& kind : featureKinds()) names.emplace_back(kind.name);
  return names;
}

const FeatureKind& featureKind(const std::string& name) {
  for (const FeatureKind& kind : featureKinds()) {
    if (name == kind.name) return kind;
  }
  throw gslam::ConfigError("--feature", "is '" + name + "', which is no feature");
}

const FeatureKind& featureKindFor(const gslam::DescriptorFormat& format) {
  const bool is_binary = format.type == gslam::DescriptorType::binary;
  for (const FeatureKind& kind : featureKinds()) {
    if (kind.is_binary == is_binary && kind.size == format.size) return kind;
  }
  throw gslam::Error("the vocabulary is for descriptors of " + std::to_string(format.size) +
                     (is_binary ? " bytes of bits" : " floats") +
                     ", which no feature of this command has: expected orb (32 bytes), brisk (64), "
                     "akaze (61) or sift (128 floats)");
}

void FeatureStream::declare(Options& options) {
  options.arg<std::size_t>("features", 1000, "most features of an image, the strongest")
      .range(1, 1000000)
      .group("Features");
  options.arg<unsigned>("threads", 0, "most threads at work; 0: as many as there are processors")
      .range(0, 1024);
}

FeatureStream::FeatureStream(const Options& options, const FeatureKind& kind, ImageStream& images)
    : images_(images),
      kind_(kind.name),
      most_(options.get<std::size_t>("features")),
      threads_(options.get<unsigned>("threads")) {
  cv::setNumThreads(1);  // each image has a thread; so a result does not depend on others
  const unsigned workers = threads_ != 0 ? threads_ : std::thread::hardware_concurrency();
  slots_.resize(std::size_t(2) * std::max(1u, workers));
}

bool FeatureStream::next(ImageFeatures& features) {
  if (at_ == filled_) fill();
  if (at_ == filled_) return false;
  Slot& slot = slots_[at_++];
  features.name = slot.image.name;
  features.descriptors = slot.descriptors;
  return true;
}

void FeatureStream::fill() {
  at_ = filled_ = 0;
  while (filled_ < slots_.size() && images_.next(slots_[filled_].image)) ++filled_;
  gslam::ParallelOptions parallel;
  parallel.threads = threads_;
  gslam::parallelFor(
      0, filled_, [this](std::size_t i) { describe(slots_[i]); }, parallel);
}

cv::Ptr<cv::Feature2D> FeatureStream::takeDetector() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!detectors_.empty()) {
      const cv::Ptr<cv::Feature2D> detector = detectors_.back();
      detectors_.pop_back();
      return detector;
    }
  }
  return makeDetector(kind_, most_);
}

void FeatureStream::describe(Slot& slot) {
  const cv::Mat pixels = greyPixels(slot.image);
  slot.image.pixels.release();
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  const cv::Ptr<cv::Feature2D> detector = takeDetector();
  try {
    detector->detectAndCompute(pixels, cv::noArray(), points, descriptors);
  } catch (const cv::Exception& error) {
    throw gslam::FileError(slot.image.name, "no features can be found in it: " + error.err);
  }
  slot.descriptors = strongest(points, descriptors, most_);
  const std::lock_guard<std::mutex> lock(mutex_);
  detectors_.push_back(detector);
}

}  // namespace app
