// Bundles with PBA, the multicore bundle adjustment of Wu et al. (CVPR 2011), on the CPU. It knows
// one coefficient of distortion, so 8 variables a camera; what it takes and gives back is float.
#include <pba/pba.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "measure.h"

namespace {

// PBA writes to std::cout, whatever it is told.
class SilentOutput {
 public:
  SilentOutput() : kept_(std::cout.rdbuf(nullptr)) {}
  ~SilentOutput() {
    std::cout.rdbuf(kept_);
    std::cout.clear();
  }
  SilentOutput(const SilentOutput&) = delete;
  SilentOutput& operator=(const SilentOutput&) = delete;

 private:
  std::streambuf* kept_;
};

// The bundle as PBA has it, which keeps pointers to these.
struct PbaArrays {
  std::vector<CameraT> cameras;
  std::vector<Point3D> points;
  std::vector<Point2D> pixels;
  std::vector<int> observation_camera, observation_point;
  std::vector<Lens> lenses;

  explicit PbaArrays(const BundleArrays& arrays) {
    for (const gslam::Camera& camera : arrays.cameras) lenses.push_back(lensOf(camera));
    for (std::size_t i = 0; i < arrays.T_world_body.size(); ++i) addCamera(arrays, i);
    for (const gslam::Vec3d& point : arrays.points) {
      points.emplace_back();
      points.back().SetPoint(point[0], point[1], point[2]);
    }
    for (std::size_t i = 0; i < arrays.pixels.size(); ++i) {
      const gslam::Vec2d pixel = arrays.pixels[i] - lenses[arrays.observation_camera[i]].centre;
      pixels.emplace_back();
      pixels.back().SetPoint2D(pixel[0], pixel[1]);
      observation_camera.push_back(static_cast<int>(arrays.observation_pose[i]));
      observation_point.push_back(static_cast<int>(arrays.observation_point[i]));
    }
  }

  void addCamera(const BundleArrays& arrays, std::size_t pose) {
    const gslam::SE3d T_camera_world = arrays.T_world_body[pose].inverse();
    const Lens& lens = lenses[hasFreeLenses(arrays) ? pose : 0];
    CameraT camera;
    camera.SetFocalLength(lens.numbers[0]);
    camera.SetProjectionDistortion(lens.numbers[1]);
    camera.SetMatrixRotation(T_camera_world.rotation().matrix().values);
    camera.SetTranslation(T_camera_world.translation().values);
    if (!arrays.pose_fixed.empty() && arrays.pose_fixed[pose] != 0) camera.SetConstantCamera();
    cameras.push_back(camera);
  }

  void writeBack(BundleArrays& arrays) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      gslam::Mat3d rotation;
      gslam::Vec3d translation;
      cameras[i].GetMatrixRotation(rotation.values);
      cameras[i].GetTranslation(translation.values);
      setView(arrays, i, {gslam::SO3d::fromMatrix(rotation, 1e-3), translation},
              {cameras[i].GetFocalLength(), cameras[i].GetProjectionDistortion(), 0});
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].GetPoint(arrays.points[i].values);
    }
  }
};

void configure(ParallelBA& solver, const BundleArrays& arrays, std::size_t iterations) {
  ConfigBA& config = *solver.GetInternalConfig();
  config.__lm_max_iteration = static_cast<int>(iterations);
  config.__lm_mse_threshold = config.__lm_delta_threshold = 0;
  config.__verbose_level = 0;
  // Its own choice where that is what the others get.
  const unsigned threads = arrays.points.size() > 2000 ? kThreads : 1;
  if (threads != std::thread::hardware_concurrency()) {
    std::string option = "-tnum", value = std::to_string(threads);
    std::array<char*, 2> options = {option.data(), value.data()};
    solver.ParseParam(static_cast<int>(options.size()), options.data());
  }
  solver.SetFixedIntrinsics(!hasFreeLenses(arrays));
  solver.EnableRadialDistortion(hasFreeLenses(arrays) ? ParallelBA::PBA_PROJECTION_DISTORTION
                                                      : ParallelBA::PBA_NO_DISTORTION);
}

// How far the solver was at a time.
struct Glance {
  int iteration;
  double mean_square;
  double seconds;
};

// Runs it, and asks every millisecond how far it is, as its interface suggests.
std::vector<Glance> run(ParallelBA& solver) {
  using Clock = std::chrono::steady_clock;
  std::vector<Glance> glances;
  std::atomic<bool> is_running{true};
  const Clock::time_point start = Clock::now();
  std::thread watch([&] {
    while (is_running) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      glances.push_back({solver.GetCurrentIteration(), solver.GetMeanSquaredError(), seconds});
    }
  });
  solver.RunBundleAdjustment();
  is_running = false;
  watch.join();
  return glances;
}

// Total time and ends are PBA's own: from its first evaluation, which the others leave out.
Course courseOf(ConfigBA& done, const std::vector<Glance>& glances, std::size_t observations) {
  const double half = 0.5 * double(observations);
  constexpr int kOptimization = 1;  // ConfigBA::TIMER_OPTIMIZATION is not public
  const double total = done.GetBundleTiming(kOptimization);
  const double set_up = done.GetBundleTiming() - total;
  Course course;
  course.add(half * done.GetInitialMSE(), 0);
  const auto last = static_cast<std::size_t>(done.GetIterationsLM());
  for (const Glance& glance : glances) {
    const std::size_t reached = std::min(last - 1, static_cast<std::size_t>(glance.iteration));
    const double seconds = std::min(total, std::max(0.0, glance.seconds - set_up));
    while (course.iterations() < reached) course.add(half * glance.mean_square, seconds);
  }
  while (course.iterations() < last) course.add(half * done.GetFinalMSE(), total);
  return course;
}

template <ParallelBA::DeviceT kDevice>
Course solveBundle(BundleArrays& arrays, std::size_t iterations) {
  const SilentOutput silence;
  PbaArrays copy(arrays);
  ParallelBA solver(kDevice);
  configure(solver, arrays, iterations);
  solver.SetCameraData(copy.cameras.size(), copy.cameras.data());
  solver.SetPointData(copy.points.size(), copy.points.data());
  solver.SetProjection(copy.pixels.size(), copy.pixels.data(), copy.observation_point.data(),
                       copy.observation_camera.data());
  const std::vector<Glance> glances = run(solver);
  copy.writeBack(arrays);
  return courseOf(*solver.GetInternalConfig(), glances, copy.pixels.size());
}

const bool kRows[] = {addBundleRows("pba_float", solveBundle<ParallelBA::PBA_CPU_FLOAT>),
                      addBundleRows("pba_double", solveBundle<ParallelBA::PBA_CPU_DOUBLE>)};

}  // namespace
