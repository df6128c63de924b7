#include "features/grid_orb.h"

#include <gslam/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace visual {
namespace {

constexpr float kDegrees = float(180 / CV_PI);
constexpr int kMostSheets = 3;

// How many features each level gets: fewer by the scale of the pyramid from one to the next.
std::vector<std::size_t> sharesOf(const Levels& levels, int count) {
  double all = 0;
  for (int i = 0; i < levels.count(); ++i) all += 1 / levels.factor(i);
  std::vector<std::size_t> shares;
  double sum = 0;
  long given = 0;
  for (int i = 0; i < levels.count(); ++i) {
    sum += 1 / levels.factor(i);
    const long until = std::lround(count * sum / all);
    shares.push_back(std::size_t(std::max(0L, until - given)));
    given = until;
  }
  return shares;
}

// Sheets for so many threads; 0: as many as there may be.
int sheetsFor(int workers) {
  return workers < 1 ? kMostSheets : std::min(workers, kMostSheets);
}

}  // namespace

GridOrb::GridOrb(const FeatureOptions& options, int workers)
    : workers_(unsigned(std::max(0, workers))),
      pyramid_(Levels(options.scale, options.levels), sheetsFor(workers)),
      wanted_(sharesOf(pyramid_.levels(), options.count)) {
  for (std::size_t i = 0; i < pyramid_.sheetCount(); ++i) {
    sheets_.push_back({CornerFinder(options, kOrbBorder),
                       EvenChoice(),
                       {},
                       {},
                       0,
                       cv::ORB::create(options.count, 1.2F, 1, kOrbBorder)});
  }
}

void GridOrb::extract(const cv::Mat& grey, std::vector<gslam::Feature>& features,
                      gslam::Image& descriptors) {
  pyramid_.build(grey);
  gslam::ParallelOptions threads;
  threads.threads = workers_;
  gslam::parallelFor(
      0, sheets_.size(), [this](std::size_t i) { detect(i); }, threads);
  std::size_t count = 0;
  for (Sheet& sheet : sheets_) {
    sheet.first = count;
    count += sheet.keys.size();
  }
  features.resize(count);
  descriptors = count == 0 ? gslam::Image() : gslam::Image(32, int(count), gslam::PixelType::u8);
  gslam::parallelFor(
      0, sheets_.size(), [&](std::size_t i) { describe(i, features, descriptors); }, threads);
}

void GridOrb::detect(std::size_t i) {
  Sheet& sheet = sheets_[i];
  sheet.keys.clear();
  sheet.ends.clear();
  sheet.corners.find(pyramid_, i);
  for (int n = pyramid_.firstOn(i); n < pyramid_.endOf(i); ++n) {
    const cv::Rect area = sheet.corners.areaOf(pyramid_, n);
    const std::vector<Spot>& spots = sheet.corners.cornersOf(n);
    const SpotArea part = {double(area.x), double(area.y), double(area.width), double(area.height)};
    const cv::Rect& place = pyramid_.place(n);
    for (std::uint32_t at : sheet.choice.choose(spots, part, wanted_[std::size_t(n)])) {
      const Spot& spot = spots[at];
      float angle = kDegrees * brightnessAngle(pyramid_.level(n), int(spot.u), int(spot.v));
      if (angle < 0) angle += 360;
      sheet.keys.emplace_back(spot.u + float(place.x), spot.v + float(place.y), 31.F, angle,
                              spot.response);
    }
    sheet.ends.push_back(sheet.keys.size());
  }
}

void GridOrb::describe(std::size_t i, std::vector<gslam::Feature>& features,
                       gslam::Image& descriptors) {
  Sheet& sheet = sheets_[i];
  if (sheet.keys.empty()) return;
  const std::size_t count = sheet.keys.size();
  cv::Mat rows(int(count), 32, CV_8UC1, descriptors.bytes(int(sheet.first)), descriptors.stride());
  const std::uint8_t* const target = rows.data;
  sheet.orb->compute(pyramid_.sheet(i), sheet.keys, rows);
  if (sheet.keys.size() != count || rows.data != target) {
    throw gslam::Error("OpenCV described " + std::to_string(sheet.keys.size()) + " of " +
                       std::to_string(count) + " corners, expected all");
  }
  int n = pyramid_.firstOn(i);
  for (std::size_t k = 0; k < count; ++k) {
    while (k >= sheet.ends[std::size_t(n - pyramid_.firstOn(i))]) ++n;
    const cv::KeyPoint& key = sheet.keys[k];
    const cv::Rect& place = pyramid_.place(n);
    gslam::Feature& feature = features[sheet.first + k];
    feature = gslam::Feature();
    feature.pixel = {float(toImage(double(key.pt.x) - place.x, pyramid_.ratioU(n))),
                     float(toImage(double(key.pt.y) - place.y, pyramid_.ratioV(n)))};
    feature.size = float(31 * pyramid_.levels().factor(n));
    feature.angle = key.angle / kDegrees;
    feature.response = key.response;
    feature.octave = std::int16_t(n);
  }
}

}  // namespace visual
