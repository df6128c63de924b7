#include "instances.h"

#include <gslam/geometry/random.h>
#include <gslam/geometry/so3.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <utility>

using gslam::Mat3d;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec2d;
using gslam::Vec3d;

namespace {

using Generator = std::mt19937_64;

double uniform(Generator& generator, double low, double high) {
  return gslam::randomUniform<double>(generator, low, high);
}

Vec3d direction(Generator& generator) {
  return gslam::randomDirection<double>(generator);
}

// A point in view of a camera of 70 degrees at the origin.
Vec3d pointInView(Generator& generator) {
  const double depth = uniform(generator, 2, 10);
  return {uniform(generator, -0.7, 0.7) * depth, uniform(generator, -0.7, 0.7) * depth, depth};
}

// Of a camera that moved by one unit and turned by up to half a radian.
SE3d relativePose(Generator& generator) {
  const SO3d rotation = SO3d::exp(direction(generator) * uniform(generator, 0, 0.5));
  return SE3d(rotation, direction(generator));
}

Mat3d cross(const Vec3d& t) {
  return {0, -t[2], t[1], t[2], 0, -t[0], -t[1], t[0], 0};
}

Numbers numbersOf(const Mat3d& m) {
  return Numbers(m.values, m.values + 9);
}

Numbers numbersOf(const SE3d& pose) {
  Numbers numbers = numbersOf(pose.rotation().matrix());
  for (int i = 0; i < 3; ++i) numbers.push_back(pose.translation()[static_cast<std::size_t>(i)]);
  return numbers;
}

// Made once for each name and size, when first asked for.
const Instances& made(const char* name, std::size_t n,
                      const std::function<Instance(Generator&)>& make) {
  static std::map<std::pair<std::string, std::size_t>, Instances> all;
  Instances& instances = all[{name, n}];
  if (instances.empty()) {
    Generator generator(n + 7);
    while (instances.size() < instanceCount()) instances.push_back(make(generator));
  }
  return instances;
}

void seeFromBoth(Instance& instance, const Vec3d& point) {
  instance.first.push_back(point.normalized());
  instance.second.push_back((instance.pose * point).normalized());
}

Instance twoViews(Generator& generator, std::size_t n) {
  Instance instance;
  instance.pose = relativePose(generator);
  while (instance.first.size() < n) {
    const Vec3d point = pointInView(generator);
    if ((instance.pose * point)[2] > 0.5) seeFromBoth(instance, point);
  }
  instance.truth =
      numbersOf(cross(instance.pose.translation()) * instance.pose.rotation().matrix());
  return instance;
}

void dehomogenise(Instance& instance) {
  for (Vec3d& v : instance.first) v /= v[2];
  for (Vec3d& v : instance.second) v /= v[2];
}

Instance absolute(Generator& generator, const std::vector<Vec3d>& in_camera) {
  Instance instance;
  instance.pose = gslam::randomOf<SE3d>(generator, 5.0);
  for (const Vec3d& point : in_camera) {
    instance.second.push_back(point.normalized());
    instance.points.push_back(instance.pose.inverse() * point);
  }
  instance.truth = numbersOf(instance.pose);
  return instance;
}

std::vector<Vec3d> pointsInView(Generator& generator, std::size_t n) {
  std::vector<Vec3d> points;
  while (points.size() < n) points.push_back(pointInView(generator));
  return points;
}

// Points of a plane through a point in view, which is seen at 30 degrees at least.
std::vector<Vec3d> planeInView(Generator& generator, std::size_t n) {
  const Vec3d centre = pointInView(generator);
  Vec3d normal = direction(generator);
  while (std::fabs(normal.dot(centre.normalized())) < 0.5) normal = direction(generator);
  std::vector<Vec3d> points;
  while (points.size() < n) {
    const Vec3d ray = pointInView(generator).normalized();
    const double depth = normal.dot(centre) / normal.dot(ray);
    if (depth > 1 && depth < 20) points.push_back(ray * depth);
  }
  return points;
}

// Four cameras half a metre off the centre of a rig; each point is seen by a camera of its own.
Instance rig(Generator& generator, const std::vector<Vec3d>& in_rig) {
  Instance instance = absolute(generator, in_rig);
  std::vector<Vec3d> cameras;
  for (int i = 0; i < 4; ++i) cameras.push_back(direction(generator) * 0.5);
  for (std::size_t i = 0; i < in_rig.size(); ++i) {
    instance.origins.push_back(cameras[i % 4]);
    instance.second[i] = (in_rig[i] - cameras[i % 4]).normalized();
  }
  return instance;
}

}  // namespace

std::size_t instanceCount() {
  return std::getenv("GSLAM_PEERS_SLOW") != nullptr ? 100000 : 10000;
}

const Instances& essentialInstances(std::size_t n) {
  return made("essential", n, [n](Generator& generator) { return twoViews(generator, n); });
}

const Instances& verticalInstances(std::size_t n) {
  return made("vertical", n, [n](Generator& generator) {
    Instance instance = twoViews(generator, n);
    instance.truth = numbersOf(instance.pose);
    return instance;
  });
}

const Instances& fundamentalInstances(std::size_t n) {
  return made("fundamental", n, [n](Generator& generator) {
    Instance instance = twoViews(generator, n);
    dehomogenise(instance);
    return instance;
  });
}

const Instances& relativeRotationInstances() {
  return made("rotation", 5, [](Generator& generator) {
    Instance instance = twoViews(generator, 5);
    instance.truth = numbersOf(instance.pose.rotation().matrix());
    return instance;
  });
}

const Instances& homographyInstances() {
  return made("homography", 4, [](Generator& generator) {
    for (;;) {
      Instance instance;
      instance.pose = relativePose(generator);
      const std::vector<Vec3d> points = planeInView(generator, 4);
      bool is_seen = true;
      for (const Vec3d& point : points) {
        is_seen = is_seen && (instance.pose * point)[2] > 0.5;
        seeFromBoth(instance, point);
      }
      if (!is_seen) continue;
      const Vec3d normal = (points[1] - points[0]).cross(points[2] - points[0]);
      const Vec3d by_distance = normal / normal.dot(points[0]);
      Mat3d h = instance.pose.rotation().matrix();
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
          h(r, c) += instance.pose.translation()[r] * by_distance[c];
        }
      }
      instance.truth = numbersOf(h);
      dehomogenise(instance);
      return instance;
    }
  });
}

const Instances& pureRotationInstances() {
  return made("pure_rotation", 2, [](Generator& generator) {
    Instance instance;
    instance.pose = SE3d(gslam::randomOf<SO3d>(generator), Vec3d{});
    for (const Vec3d& point : pointsInView(generator, 2)) seeFromBoth(instance, point);
    instance.truth = numbersOf(instance.pose.rotation().matrix());
    return instance;
  });
}

const Instances& triangulationInstances() {
  return made("triangulation", 1, [](Generator& generator) {
    Instance instance;
    instance.pose = relativePose(generator);
    const Vec3d point = pointInView(generator);
    seeFromBoth(instance, point);
    instance.truth = {point[0], point[1], point[2]};
    return instance;
  });
}

const Instances& absoluteInstances(std::size_t n) {
  return made("absolute", n, [n](Generator& generator) {
    return absolute(generator, pointsInView(generator, n));
  });
}

const Instances& collinearInstances() {
  return made("collinear", 3, [](Generator& generator) {
    std::vector<Vec3d> points = pointsInView(generator, 2);
    points.push_back(points[0] + (points[1] - points[0]) * uniform(generator, 0.2, 0.8) +
                     direction(generator) * (1e-4 * (points[1] - points[0]).norm()));
    return absolute(generator, points);
  });
}

const Instances& planarInstances(std::size_t n) {
  return made("planar", n,
              [n](Generator& generator) { return absolute(generator, planeInView(generator, n)); });
}

const Instances& rigInstances(std::size_t n) {
  return made("rig", n,
              [n](Generator& generator) { return rig(generator, pointsInView(generator, n)); });
}

const Instances& planarRigInstances(std::size_t n) {
  return made("planar_rig", n,
              [n](Generator& generator) { return rig(generator, planeInView(generator, n)); });
}

const Instances& similarityInstances() {
  return made("similarity", 3, [](Generator& generator) {
    Instance instance;
    instance.pose = gslam::randomOf<SE3d>(generator, 5.0);
    const double scale = std::exp(uniform(generator, -1, 1));
    for (int i = 0; i < 3; ++i) {
      instance.first.push_back(gslam::detail::randomInCube<double, 3>(generator, 3.0));
      instance.second.push_back(instance.pose.rotation() * instance.first.back() * scale +
                                instance.pose.translation());
    }
    instance.truth = numbersOf(instance.pose);
    instance.truth.push_back(scale);
    return instance;
  });
}

namespace {

Instance affine(Generator& generator, std::size_t n, std::size_t dimensions) {
  Instance instance;
  instance.truth.resize(dimensions * (dimensions + 1));
  for (double& number : instance.truth) number = uniform(generator, -3, 3);
  while (instance.first.size() < n) {
    Vec3d point{}, moved{};
    for (std::size_t i = 0; i < dimensions; ++i) point[i] = uniform(generator, -3, 3);
    for (std::size_t r = 0; r < dimensions; ++r) {
      const double* const row = &instance.truth[r * (dimensions + 1)];
      moved[r] = row[dimensions];
      for (std::size_t c = 0; c < dimensions; ++c) moved[r] += row[c] * point[c];
    }
    instance.first.push_back(point);
    instance.second.push_back(moved);
  }
  return instance;
}

}  // namespace

const Instances& affine2DInstances() {
  return made("affine_2d", 3, [](Generator& generator) { return affine(generator, 3, 2); });
}

const Instances& affine3DInstances() {
  return made("affine_3d", 4, [](Generator& generator) { return affine(generator, 4, 3); });
}

const Instances& planeInstances() {
  return made("plane", 3, [](Generator& generator) {
    Instance instance;
    const Vec3d normal = direction(generator);
    const double distance = uniform(generator, -3, 3);
    for (int i = 0; i < 3; ++i) {
      const Vec3d point = gslam::detail::randomInCube<double, 3>(generator, 3.0);
      instance.first.push_back(point - normal * (normal.dot(point) + distance));
    }
    instance.truth = {normal[0], normal[1], normal[2], distance};
    return instance;
  });
}

namespace {

Vec2d pixelOf(const Vec3d& point) {
  return {kFocal * point[0] / point[2] + kCentreX, kFocal * point[1] / point[2] + kCentreY};
}

bool isInImage(const Vec2d& pixel) {
  return pixel[0] > -0.5 && pixel[0] < kWidth - 0.5 && pixel[1] > -0.5 && pixel[1] < kHeight - 0.5;
}

Vec2d anyPixel(Generator& generator) {
  return {uniform(generator, 0, kWidth - 1), uniform(generator, 0, kHeight - 1)};
}

Vec2d noisy(Generator& generator, const Vec2d& pixel) {
  return pixel + gslam::randomNormal<double, 2>(generator);
}

Vec3d pointAtPixel(const Vec2d& pixel, double depth) {
  return {(pixel[0] - kCentreX) / kFocal * depth, (pixel[1] - kCentreY) / kFocal * depth, depth};
}

// Depths of 4 to 10 units, or of a plane whose normal is up to 45 degrees off the axis.
Scene scene(Generator& generator, SceneKind kind, std::size_t n, double outliers) {
  Scene result;
  result.pose =
      kind == SceneKind::Points ? gslam::randomOf<SE3d>(generator, 5.0) : relativePose(generator);
  const Vec3d normal = (Vec3d{0, 0, 1} + direction(generator) * 0.7).normalized();
  const double distance = 6 * normal[2];
  const std::size_t wrong =
      static_cast<std::size_t>(std::lround(outliers * static_cast<double>(n)));
  std::size_t tries = 0;
  while (result.second.size() < n) {
    if (++tries > 1000 * n)
      return scene(generator, kind, n, outliers);  // they see little in common
    const Vec2d pixel = anyPixel(generator);
    double depth = uniform(generator, 4, 10);
    if (kind == SceneKind::TwoViewsOfPlane) depth = distance / normal.dot(pointAtPixel(pixel, 1));
    const Vec3d point = pointAtPixel(pixel, depth);
    if (depth < 0.5 || depth > 50) continue;
    const bool is_wrong = result.second.size() < wrong;
    if (kind == SceneKind::Points) {
      result.points.push_back(result.pose.inverse() * point);
      result.second.push_back(is_wrong ? anyPixel(generator) : noisy(generator, pixel));
      continue;
    }
    const Vec3d in_second = result.pose * point;
    if (!is_wrong && (in_second[2] < 0.5 || !isInImage(pixelOf(in_second)))) continue;
    result.first.push_back(is_wrong ? anyPixel(generator) : noisy(generator, pixel));
    result.second.push_back(is_wrong ? anyPixel(generator) : noisy(generator, pixelOf(in_second)));
  }
  const Mat3d k = {kFocal, 0, kCentreX, 0, kFocal, kCentreY, 0, 0, 1};
  const Mat3d k_inverse = {1 / kFocal, 0, -kCentreX / kFocal, 0, 1 / kFocal, -kCentreY / kFocal, 0,
                           0,          1};
  Mat3d h = result.pose.rotation().matrix();
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      h(r, c) += result.pose.translation()[r] * normal[c] / distance;
    }
  }
  result.homography = k * h * k_inverse;
  // Wrong ones anywhere among the right ones.
  for (std::size_t i = n; i > 1; --i) {
    const std::size_t j = static_cast<std::size_t>(generator() % i);
    std::swap(result.second[i - 1], result.second[j]);
    if (!result.first.empty()) std::swap(result.first[i - 1], result.first[j]);
    if (!result.points.empty()) std::swap(result.points[i - 1], result.points[j]);
  }
  return result;
}

}  // namespace

const std::vector<Scene>& scenes(SceneKind kind, std::size_t n, double outliers) {
  static std::map<std::tuple<SceneKind, std::size_t, double>, std::vector<Scene>> all;
  std::vector<Scene>& result = all[{kind, n, outliers}];
  Generator generator(n);
  while (result.size() < 100) result.push_back(scene(generator, kind, n, outliers));
  return result;
}
