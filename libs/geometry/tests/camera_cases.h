// Cameras that the tests of all models run on: real calibrations where there are some (EuRoC,
// TUM-VI, KITTI, TUM RGB-D, OCamCalib's example), else values at which all terms count.
#ifndef GSLAM_GEOMETRY_TESTS_CAMERA_CASES_H
#define GSLAM_GEOMETRY_TESTS_CAMERA_CASES_H

#include <gslam/geometry/camera.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace camera_cases {

/// One kind of camera: in any precision, with parameters for an image of width x height.
template <template <class> class CameraOf>
struct Kind {
  using Double = CameraOf<double>;
  using Float = CameraOf<float>;
  using Long = CameraOf<long double>;
};

template <class T>
using Radtan4 = gslam::RadtanCamera<T, 4>;
template <class T>
using Radtan5 = gslam::RadtanCamera<T, 5>;
template <class T>
using Radtan8 = gslam::RadtanCamera<T, 8>;
template <class T>
using Radtan14 = gslam::RadtanCamera<T, 14>;

struct Pinhole : Kind<gslam::PinholeCamera> {
  static constexpr int kWidth = 1226, kHeight = 370;  // KITTI 06
  static std::vector<double> values() { return {707.0912, 707.0912, 601.8873, 183.1104}; }
};
struct EurocRadtan : Kind<Radtan4> {
  static constexpr int kWidth = 752, kHeight = 480;
  static std::vector<double> values() {
    return {458.654,     457.296,    367.215,    248.375,
            -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05};
  }
};
struct Freiburg1Radtan : Kind<Radtan5> {
  static constexpr int kWidth = 640, kHeight = 480;
  static std::vector<double> values() {
    return {517.306408, 516.469215, 318.643040, 255.313989, 0.262383,
            -0.953104,  -0.005358,  0.002628,   1.163314};
  }
};
struct RationalRadtan : Kind<Radtan8> {
  static constexpr int kWidth = 640, kHeight = 480;
  static std::vector<double> values() {
    return {380, 385, 322.5, 239.1, 0.9, 0.21, 0.0011, -0.0007, 0.012, 1.21, 0.42, 0.041};
  }
};
struct TiltedRadtan : Kind<Radtan14> {
  static constexpr int kWidth = 640, kHeight = 480;
  static std::vector<double> values() {
    return {380,  385,  322.5, 239.1,  0.9,     0.21,    0.0011, -0.0007, 0.012,
            1.21, 0.42, 0.041, 0.0012, -0.0004, -0.0021, 0.0003, 0.06,    -0.04};
  }
};
struct TumviKannalaBrandt : Kind<gslam::KannalaBrandtCamera> {
  static constexpr int kWidth = 512, kHeight = 512;
  static std::vector<double> values() {
    return {190.97847715128717,     190.9733070521226,     254.93170605935475,
            256.8974428996504,      0.0034823894022493434, 0.0007150348452162257,
            -0.0020532361418706202, 0.00020293673591811182};
  }
};
struct WideFov : Kind<gslam::FovCamera> {
  static constexpr int kWidth = 640, kHeight = 480;
  static std::vector<double> values() { return {318, 321, 319.5, 239.5, 0.933}; }
};
struct ToolboxOcam : Kind<gslam::OcamCamera> {
  static constexpr int kWidth = 640, kHeight = 480;
  static std::vector<double> values() {
    return {326.939156,    261.744395, 1.001968,     0.001400,      0.000113,
            -3.258881e+02, 0.0,        8.612196e-04, -3.553896e-08, 6.737619e-09};
  }
};
struct TumviDoubleSphere : Kind<gslam::DoubleSphereCamera> {
  static constexpr int kWidth = 512, kHeight = 512;
  static std::vector<double> values() {
    return {158.28600034966977, 158.2743455478755,    254.96116578191653,
            256.8894394501779,  -0.17213086034353243, 0.5931177593944744};
  }
};
struct EurocEucm : Kind<gslam::EucmCamera> {
  static constexpr int kWidth = 752, kHeight = 480;
  static std::vector<double> values() {
    return {460.76484651566468, 459.4051018049483,  365.8937161309615,
            249.33499869752445, 0.5903365915227143, 1.127468196965374};
  }
};
struct WideUcm : Kind<gslam::UcmCamera> {
  static constexpr int kWidth = 640, kHeight = 480;
  static std::vector<double> values() { return {280, 281, 319.5, 239.5, 0.68}; }
};
struct CatadioptricMei : Kind<gslam::MeiCamera> {
  static constexpr int kWidth = 1280, kHeight = 960;
  static std::vector<double> values() {
    return {1430, 1433, 638, 481, 1.31, -0.12, 0.31, 0.0004, -0.0011};
  }
};
struct Panorama : Kind<gslam::EquirectangularCamera> {
  static constexpr int kWidth = 1920, kHeight = 960;
  static std::vector<double> values() {
    return {305.57749073643905, 305.57749073643905, 959.5, 479.5};
  }
};
struct OrthographicFisheye : Kind<gslam::OrthographicCamera> {
  static constexpr int kWidth = 640, kHeight = 480;
  static std::vector<double> values() { return {410, 405, 321, 241}; }
};

using All = testing::Types<Pinhole, EurocRadtan, Freiburg1Radtan, RationalRadtan, TiltedRadtan,
                           TumviKannalaBrandt, WideFov, ToolboxOcam, TumviDoubleSphere, EurocEucm,
                           WideUcm, CatadioptricMei, Panorama, OrthographicFisheye>;

template <class Camera>
Camera make(const std::vector<double>& values) {
  typename Camera::Parameters parameters;
  EXPECT_EQ(values.size(), parameters.size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    parameters[i] = static_cast<typename Camera::Scalar>(values[i]);
  }
  return Camera(parameters);
}

/// Pixels all over the image, its borders and corners among them, and the principal point.
template <class Case, class T = double>
std::vector<gslam::Vec<T, 2>> pixels(int step = 13) {
  std::vector<gslam::Vec<T, 2>> all;
  for (int v = 0; v < Case::kHeight; v += step) {
    for (int u = 0; u < Case::kWidth; u += step) all.push_back({T(u), T(v)});
  }
  const T right = T(Case::kWidth - 1), bottom = T(Case::kHeight - 1);
  all.insert(all.end(), {{right, T(0)}, {T(0), bottom}, {right, bottom}});
  const auto parameters = make<typename Case::Double>(Case::values()).parameters();
  const bool is_ocam = parameters.size() == 10;
  all.push_back({T(parameters[is_ocam ? 0 : 2]), T(parameters[is_ocam ? 1 : 3])});
  return all;
}

}  // namespace camera_cases

#endif  // GSLAM_GEOMETRY_TESTS_CAMERA_CASES_H
