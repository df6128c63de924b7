#include "synthetic_bundle.h"

#include <gslam/geometry/random.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace synthetic_bundle {
namespace {

using gslam::Camera;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

constexpr double kFocalLength = 500;

using Generator = std::mt19937_64;

double uniform(Generator& generator, double low, double high) {
  return gslam::randomUniform(generator, low, high);
}

double normal(Generator& generator) {
  const double u = uniform(generator, 1e-300, 1), v = uniform(generator, 0, 1);
  return std::sqrt(-2 * std::log(u)) * std::cos(6.283185307179586 * v);
}

Vec3d normal3(Generator& generator, double sigma) {
  return {sigma * normal(generator), sigma * normal(generator), sigma * normal(generator)};
}

SE3d perturbed(const SE3d& pose, double translation, double rotation, Generator& generator) {
  const Vec3d t = normal3(generator, translation), r = normal3(generator, rotation);
  return pose * SE3d::exp({t[0], t[1], t[2], r[0], r[1], r[2]});
}

Camera cameraOf(const Shape& shape, double focal, double k1, double k2) {
  if (!shape.bal) return Camera::fromParameters("pinhole", 1000, 1000, {focal, focal, 500, 500});
  return Camera::fromParameters("radtan", 1000, 1000, {focal, focal, 0, 0, k1, k2, 0, 0});
}

// Two cameras or more; most tracks are short, a tenth are four times as long.
std::size_t trackLength(const Shape& shape, Generator& generator) {
  const double mean = double(shape.observations) / double(shape.points) - 2;
  const double scale = mean / 1.3 * (uniform(generator, 0, 1) < 0.1 ? 4 : 1);
  const double extra = -scale * std::log(uniform(generator, 1e-12, 1)) + 0.5;
  return std::min(shape.cameras, 2 + static_cast<std::size_t>(std::max(0.0, extra)));
}

class Maker {
 public:
  explicit Maker(const Shape& shape) : shape_(shape), generator_(shape.seed) {
    length_ = (shape.cameras + shape.walks - 1) / shape.walks;
  }

  Arrays make() {
    reserve();
    makeCameras();
    for (std::size_t i = 0; i < shape_.points; ++i) addPoint();
    disturb();
    return std::move(arrays_);
  }

 private:
  // Growing would need more memory than solving.
  void reserve() {
    const std::size_t most = shape_.observations + shape_.observations / 16;
    arrays_.points.reserve(shape_.points);
    arrays_.observation_pose.reserve(most);
    arrays_.observation_point.reserve(most);
    arrays_.observation_camera.reserve(most);
    arrays_.pixels.reserve(most);
  }

  // Place along the street, in steps; each walk is a little beside the others.
  double placeOf(std::size_t camera) const {
    return double(camera % length_) + 0.3 * double(camera / length_);
  }

  void makeCameras() {
    for (std::size_t i = 0; i < shape_.cameras; ++i) {
      const SE3d straight(gslam::SO3d(), {placeOf(i), 0.0, -0.5 * double(i / length_ % 4)});
      arrays_.T_world_body.push_back(perturbed(straight, 0.1, 0.05, generator_));
      if (i > 0 && !shape_.bal) continue;
      const double focal = kFocalLength * (shape_.bal ? uniform(generator_, 0.9, 1.1) : 1.0);
      arrays_.cameras.push_back(cameraOf(shape_, focal, shape_.bal ? -0.05 : 0, 0.01));
    }
  }

  // Cameras within reach of a place: a random subset of the wanted size.
  void chooseCameras(double place, std::size_t wanted) {
    chosen_.clear();
    for (std::size_t walk = 0; walk < shape_.walks; ++walk) {
      const double middle = place - 0.3 * double(walk);
      const double low = std::max(0.0, middle - shape_.reach);
      const double high = std::min(double(length_) - 1, middle + shape_.reach);
      for (double at = std::ceil(low); at <= high; ++at) {
        const std::size_t camera = walk * length_ + static_cast<std::size_t>(at);
        if (camera < shape_.cameras) chosen_.push_back(static_cast<std::uint32_t>(camera));
      }
    }
    for (std::size_t i = 0; i < std::min(wanted, chosen_.size()); ++i) {
      const double rest = double(chosen_.size() - i);
      const auto other = i + static_cast<std::size_t>(uniform(generator_, 0, 1) * rest);
      std::swap(chosen_[i], chosen_[std::min(other, chosen_.size() - 1)]);
    }
    chosen_.resize(std::min(wanted, chosen_.size()));
    std::sort(chosen_.begin(), chosen_.end());
  }

  void addPoint() {
    const double place = uniform(generator_, 0, double(length_ - 1));
    const double depth = uniform(generator_, 1, 2) * (shape_.reach + 2);
    const Vec3d point = {place, uniform(generator_, -0.5, 0.5) * depth, depth};
    chooseCameras(place, trackLength(shape_, generator_));
    const auto number = static_cast<std::uint32_t>(arrays_.points.size());
    arrays_.points.push_back(point);
    for (const std::uint32_t camera : chosen_) {
      const Vec3d local = arrays_.T_world_body[camera].inverse() * point;
      Vec2d pixel{};
      const std::uint32_t intrinsics = shape_.bal ? camera : 0;
      if (!arrays_.cameras[intrinsics].project(local, pixel)) continue;
      arrays_.observation_pose.push_back(camera);
      arrays_.observation_point.push_back(number);
      arrays_.observation_camera.push_back(intrinsics);
      arrays_.pixels.push_back({pixel[0] + shape_.pixel_noise * normal(generator_),
                                pixel[1] + shape_.pixel_noise * normal(generator_)});
    }
  }

  void disturb() {
    const double noise = shape_.start_noise;
    if (!shape_.bal) {
      arrays_.pose_fixed.assign(shape_.cameras, 0);
      arrays_.pose_fixed[0] = arrays_.pose_fixed[1] = 1;
    }
    for (std::size_t i = 0; i < shape_.cameras; ++i) {
      SE3d& pose = arrays_.T_world_body[i];
      if (shape_.bal || i > 1) pose = perturbed(pose, 0.05 * noise, 0.01 * noise, generator_);
      if (!shape_.bal) continue;
      const double focal =
          arrays_.cameras[i].parameter("fx") * (1 + 0.01 * noise * normal(generator_));
      arrays_.cameras[i] = cameraOf(shape_, focal, 0, 0);
      gslam::CameraFreedom freedom;
      freedom.parameters = 1U | (1U << 4) | (1U << 5);
      freedom.keeps_aspect = true;
      arrays_.camera_freedom.push_back(freedom);
    }
    for (Vec3d& point : arrays_.points) point += normal3(generator_, 0.1 * noise);
  }

  const Shape shape_;
  Generator generator_;
  std::size_t length_ = 1;
  Arrays arrays_;
  std::vector<std::uint32_t> chosen_;
};

}  // namespace

Shape ladybug() {
  Shape shape;
  shape.cameras = 49;
  shape.points = 7800;
  shape.observations = 32000;
  shape.reach = 10;
  shape.bal = true;
  return shape;
}

Shape trafalgar() {
  Shape shape;
  shape.cameras = 257;
  shape.points = 65000;
  shape.observations = 225000;
  shape.walks = 3;
  shape.reach = 12;
  shape.bal = true;
  return shape;
}

Shape venice() {
  Shape shape;
  shape.cameras = 1778;
  shape.points = 994000;
  shape.observations = 5002000;
  shape.walks = 8;
  shape.reach = 10;
  shape.bal = true;
  return shape;
}

Shape local() {
  return Shape();
}

gslam::BundleProblem Arrays::problem() {
  gslam::BundleProblem views;
  views.T_world_body = T_world_body;
  views.pose_fixed = pose_fixed;
  views.points = points;
  views.cameras = cameras;
  views.camera_freedom = camera_freedom;
  views.observation_pose = observation_pose;
  views.observation_point = observation_point;
  views.observation_camera = observation_camera;
  views.pixels = pixels;
  return views;
}

Arrays make(const Shape& shape) {
  return Maker(shape).make();
}

}  // namespace synthetic_bundle
