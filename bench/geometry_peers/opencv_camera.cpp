#include <benchmark/benchmark.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "camera_data.h"

namespace {

using namespace camera_data;  // NOLINT(google-build-using-namespace)

const cv::Vec3d kNoMotion(0, 0, 0);

cv::Matx33d matrix(const std::array<double, 4>& f) {
  return {f[0], 0, f[2], 0, f[1], f[3], 0, 0, 1};
}

std::vector<cv::Point3d> points() {
  std::vector<cv::Point3d> result;
  for (const auto& p : camera_data::points()) result.emplace_back(p[0], p[1], p[2]);
  return result;
}

std::vector<cv::Point2d> pixels(double width, double height) {
  std::vector<cv::Point2d> result;
  for (const auto& p : camera_data::pixels(width, height)) result.emplace_back(p[0], p[1]);
  return result;
}

template <class Operation>
void measure(benchmark::State& state, const Operation& operation) {
  for (auto _ : state) {
    operation();
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPoints));
}

void projectRadtan(benchmark::State& state) {
  const auto in = points();
  std::vector<cv::Point2d> out;
  measure(state,
          [&] { cv::projectPoints(in, kNoMotion, kNoMotion, matrix(kRadtanFocal), kRadtan, out); });
}
BENCHMARK(projectRadtan)->Name("camera_project_radtan/opencv");

void projectRadtanJacobians(benchmark::State& state) {
  const auto in = points();
  std::vector<cv::Point2d> out;
  cv::Mat jacobian;
  measure(state, [&] {
    cv::projectPoints(in, kNoMotion, kNoMotion, matrix(kRadtanFocal), kRadtan, out, jacobian);
  });
}
BENCHMARK(projectRadtanJacobians)->Name("camera_jacobians_radtan/opencv");

void projectFisheye(benchmark::State& state) {
  const auto in = points();
  std::vector<cv::Point2d> out;
  measure(state, [&] {
    cv::fisheye::projectPoints(in, out, kNoMotion, kNoMotion, matrix(kFisheyeFocal), kFisheye);
  });
}
BENCHMARK(projectFisheye)->Name("camera_project_fisheye/opencv");

// With its 5 steps, and with as many as ours needs for the last digit.
void unprojectRadtan(benchmark::State& state, const cv::TermCriteria& until) {
  const auto in = pixels(kWidth, kHeight);
  std::vector<cv::Point2d> out;
  measure(state, [&] {
    cv::undistortPoints(in, out, matrix(kRadtanFocal), kRadtan, cv::noArray(), cv::noArray(),
                        until);
  });
}
BENCHMARK_CAPTURE(unprojectRadtan, five_steps, cv::TermCriteria(cv::TermCriteria::COUNT, 5, 0.01))
    ->Name("camera_unproject_radtan/opencv_5_steps");
BENCHMARK_CAPTURE(unprojectRadtan, converged,
                  cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 1000, 1e-10))
    ->Name("camera_unproject_radtan/opencv");

void unprojectFisheye(benchmark::State& state) {
  const auto in = pixels(512, 512);
  std::vector<cv::Point2d> out;
  measure(state, [&] { cv::fisheye::undistortPoints(in, out, matrix(kFisheyeFocal), kFisheye); });
}
BENCHMARK(unprojectFisheye)->Name("camera_unproject_fisheye/opencv");

// With maps made before, in OpenCV's fast form.
void undistort(benchmark::State& state) {
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const int channels = static_cast<int>(state.range(0));
  std::vector<std::uint8_t> pixels = image(static_cast<std::size_t>(channels));
  const cv::Mat in(kHeight, kWidth, CV_8UC(channels), pixels.data());
  cv::Mat out, map, fractions;
  cv::initUndistortRectifyMap(matrix(kRadtanFocal), kRadtan, cv::noArray(), matrix(kRadtanFocal),
                              in.size(), CV_16SC2, map, fractions);
  for (auto _ : state) {
    cv::remap(in, out, map, fractions, cv::INTER_LINEAR);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kWidth * kHeight);
  cv::setNumThreads(threads);
}
BENCHMARK(undistort)->Name("camera_undistort/opencv")->Arg(1)->Arg(3)->Arg(4);

}  // namespace
