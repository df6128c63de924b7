#include "features/depth_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace visual {
namespace {

using gslam::CameraImage;
using gslam::Feature;
using gslam::Image;
using gslam::PixelType;
using gslam::Vec2d;
using gslam::Vec3d;

constexpr float kEdge = 1.1F;         // ratio of depths beside each other that is an edge
constexpr double kSameCamera = 1e-6;  // radians, and metres, between cameras that are one

// Depths in rows, as numbers of an image or as metres.
template <class T>
class DepthRows {
 public:
  DepthRows(const T* first, std::size_t stride, int columns, int rows, double scale)
      : first_(first), stride_(stride), columns_(columns), rows_(rows), scale_(float(scale)) {}

  // The depth at a pixel; 0: none.
  float at(int u, int v) const noexcept {
    if (u < 0 || v < 0 || u >= columns_ || v >= rows_) return 0;
    const float depth = scale_ * float(first_[std::size_t(v) * stride_ + std::size_t(u)]);
    return depth > 0 && std::isfinite(depth) ? depth : 0;
  }

  // The depth of a feature, as DepthReader says.
  float around(int u, int v) const noexcept {
    const float middle = at(u, v);
    const float beside[] = {at(u - 1, v), at(u + 1, v), at(u, v - 1), at(u, v + 1)};
    float least = middle > 0 ? middle : std::numeric_limits<float>::max(), most = middle;
    for (float depth : beside) {
      if (depth > 0) least = std::min(least, depth);
      most = std::max(most, depth);
    }
    if (most <= 0 || most > kEdge * least) return 0;
    return middle > 0 ? middle : least;
  }

 private:
  const T* first_;
  std::size_t stride_;
  int columns_, rows_;
  float scale_;
};

// Pixels a radian in the middle of a camera's image; 0: it sees nothing there.
double focalOf(const gslam::Camera& camera) {
  const Vec2d middle = {(camera.width() - 1) / 2.0, (camera.height() - 1) / 2.0};
  Vec3d a, b;
  if (!camera.unproject(middle, a) || !camera.unproject(middle + Vec2d{1, 0}, b)) return 0;
  const double angle = (a - b).norm();
  return angle > 0 ? 1 / angle : 0;
}

template <class T>
void readRows(const DepthRows<T>& rows, int cell, const std::vector<Feature>& features,
              std::vector<float>& depth) {
  const double size = cell;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Feature& feature = features[i];
    const int u = int(std::floor((double(feature.pixel[0]) + 0.5) / size));
    const int v = int(std::floor((double(feature.pixel[1]) + 0.5) / size));
    depth[i] = rows.around(u, v);
  }
}

}  // namespace

DepthReader::DepthReader(const Eye& eye, const gslam::Camera& camera,
                         const gslam::SE3d& T_body_depth)
    : eye_(eye), camera_(camera), T_eye_depth_(eye.T_body_camera.inverse() * T_body_depth) {
  is_same_ = camera == eye.camera && T_eye_depth_.isApprox(gslam::SE3d(), kSameCamera);
  if (is_same_) return;
  // Two pixels of the eye: holes between points that fall beside each other stay rare. More where
  // the depth camera has fewer pixels.
  const double fewer = focalOf(eye.camera) / std::max(1e-3, focalOf(camera));
  cell_ = std::clamp(int(std::ceil(1.5 * fewer)), 2, 64);
  columns_ = (eye.camera.width() + cell_ - 1) / cell_;
  rows_ = (eye.camera.height() + cell_ - 1) / cell_;
  bearings_.assign(std::size_t(camera.width()) * std::size_t(camera.height()), Vec3d{});
  std::size_t i = 0;
  for (int v = 0; v < camera.height(); ++v) {
    for (int u = 0; u < camera.width(); ++u, ++i) {
      Vec3d bearing;
      if (camera.unproject({double(u), double(v)}, bearing) && bearing[2] > 0.05) {
        bearings_[i] = bearing * (1 / bearing[2]);
      }
    }
  }
}

void DepthReader::read(const CameraImage& image, const std::vector<Feature>& features,
                       std::vector<float>& depth, std::vector<float>& right_u) {
  depth.assign(features.size(), 0);
  right_u.assign(features.size(), std::numeric_limits<float>::quiet_NaN());
  const Image& pixels = image.image;
  if (!is_same_) {
    project(image);
    readRows(DepthRows<float>(seen_.data(), std::size_t(columns_), columns_, rows_, 1), cell_,
             features, depth);
  } else if (pixels.type() == PixelType::u16) {
    readRows(DepthRows<std::uint16_t>(pixels.row<std::uint16_t>(0), pixels.stride() / 2,
                                      pixels.width(), pixels.height(), image.depth_scale),
             1, features, depth);
  } else {
    readRows(DepthRows<float>(pixels.row<float>(0), pixels.stride() / 4, pixels.width(),
                              pixels.height(), image.depth_scale),
             1, features, depth);
  }
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (!(depth[i] > 0)) continue;
    const Vec2d pixel = {double(features[i].pixel[0]), double(features[i].pixel[1])};
    right_u[i] = float(eye_.rightOf(pixel, double(depth[i])));
    if (!std::isfinite(right_u[i])) depth[i] = 0;
  }
}

bool DepthReader::accepts(const CameraImage& image, std::string& problem) const {
  const std::string name = "the image of camera '" + image.name + "' ";
  const Image& pixels = image.image;
  if (image.kind != gslam::ImageKind::depth) {
    problem = name + "is of kind " + gslam::imageKindName(image.kind) + ", expected depth";
  } else if (pixels.empty()) {
    problem = name + "is missing";
  } else if (pixels.width() != camera_.width() || pixels.height() != camera_.height() ||
             pixels.channels() != 1 ||
             (pixels.type() != PixelType::u16 && pixels.type() != PixelType::f32)) {
    problem = name + "is " + pixels.text() + ", expected " + std::to_string(camera_.width()) +
              " x " + std::to_string(camera_.height()) + " u16 or f32";
  } else if (!(image.depth_scale > 0) || !std::isfinite(image.depth_scale)) {
    problem = name + "has no scale of depth, expected metres for a number";
  } else {
    return true;
  }
  return false;
}

void DepthReader::project(const CameraImage& image) {
  seen_.assign(std::size_t(columns_) * std::size_t(rows_), 0);
  points_.resize(std::size_t(camera_.width()));
  pixels_.resize(points_.size());
  is_seen_.resize(points_.size());
  if (image.image.type() == PixelType::u16) {
    projectRows<std::uint16_t>(image.image, image.depth_scale);
  } else {
    projectRows<float>(image.image, image.depth_scale);
  }
}

template <class T>
void DepthReader::projectRows(const Image& image, double scale) {
  const double right = eye_.camera.width() - 0.5, bottom = eye_.camera.height() - 0.5;
  for (int v = 0; v < image.height(); ++v) {
    const T* const row = image.row<T>(v);
    const Vec3d* const bearings = bearings_.data() + std::size_t(v) * std::size_t(camera_.width());
    std::size_t count = 0;
    for (int u = 0; u < image.width(); ++u) {
      const double depth = scale * double(row[u]);
      if (!(depth > 0 && std::isfinite(depth)) || !(bearings[u][2] > 0)) continue;
      points_[count++] = T_eye_depth_ * (depth * bearings[u]);
    }
    eye_.camera.projectMany({points_.data(), count}, {pixels_.data(), count},
                            {is_seen_.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2d& at = pixels_[i];
      const float depth = float(points_[i][2]);
      if (is_seen_[i] == 0 || !(depth > 0) || !(at[0] >= -0.5 && at[0] < right) ||
          !(at[1] >= -0.5 && at[1] < bottom)) {
        continue;
      }
      const int column = int((at[0] + 0.5) / cell_), cell_row = int((at[1] + 0.5) / cell_);
      float& seen = seen_[std::size_t(cell_row) * std::size_t(columns_) + std::size_t(column)];
      if (seen == 0 || depth < seen) seen = depth;
    }
  }
}

}  // namespace visual
