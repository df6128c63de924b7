// Trajectories to text and back, beside the C++ library's streams and the C library.
#include <benchmark/benchmark.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/geometry/random.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

using gslam::SE3d;
using gslam::StampedPose;
using gslam::Trajectory;
using gslam::TrajectoryFormat;

constexpr std::size_t kPoses = 20000;

Trajectory walk() {
  std::mt19937_64 random(1);
  std::normal_distribution<double> step(0, 0.02);
  std::vector<StampedPose> poses;
  SE3d pose;
  for (std::size_t i = 0; i < kPoses; ++i) {
    poses.push_back({1305031098665900000 + std::int64_t(i) * 33333333, pose});
    gslam::Vec<double, 6> tangent;
    for (std::size_t j = 0; j < 6; ++j) tangent[j] = step(random);
    pose = pose * SE3d::exp(tangent);
    pose = SE3d(pose.rotation().normalized(), pose.translation());
  }
  return Trajectory(poses);
}

// As benchmarks publish them: seven digits.
std::string shortText(const Trajectory& trajectory, TrajectoryFormat format) {
  std::string text;
  char line[400];
  for (const StampedPose& p : trajectory) {
    const double* const q = p.pose.rotation().data();
    const gslam::Vec3d& t = p.pose.translation();
    if (format == TrajectoryFormat::kitti) {
      const gslam::Mat3d r = p.pose.rotation().matrix();
      for (std::size_t i = 0; i < 3; ++i) {
        std::snprintf(line, sizeof(line), "%s%.6e %.6e %.6e %.6e", i == 0 ? "" : " ", r(i, 0),
                      r(i, 1), r(i, 2), t[i]);
        text += line;
      }
      text += '\n';
    } else if (format == TrajectoryFormat::euroc) {
      std::snprintf(line, sizeof(line), "%lld,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n",
                    static_cast<long long>(p.stamp), t[0], t[1], t[2], q[3], q[0], q[1], q[2]);
      text += line;
    } else {
      std::snprintf(line, sizeof(line), "%s %.6f %.6f %.6f %.6f %.6f %.6f %.6f\n",
                    gslam::secondsText(p.stamp).c_str(), t[0], t[1], t[2], q[0], q[1], q[2], q[3]);
      text += line;
    }
  }
  return text;
}

void setBytes(benchmark::State& state, std::size_t size) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(size));
}

void readText(benchmark::State& state, const std::string& text) {
  for (auto _ : state) benchmark::DoNotOptimize(gslam::parseTrajectory(text, "bench"));
  setBytes(state, text.size());
}

void readByStream(benchmark::State& state, const std::string& text) {
  for (auto _ : state) {
    std::istringstream in(text);
    std::vector<StampedPose> poses;
    double s = 0, x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 0;
    while (in >> s >> x >> y >> z >> qx >> qy >> qz >> qw) {
      poses.push_back({static_cast<std::int64_t>(s * 1e9),
                       SE3d(gslam::SO3d::fromQuaternion(qx, qy, qz, qw), {{x, y, z}})});
    }
    benchmark::DoNotOptimize(poses);
  }
  setBytes(state, text.size());
}

void readByStrtod(benchmark::State& state, const std::string& text) {
  for (auto _ : state) {
    std::vector<StampedPose> poses;
    char* p = const_cast<char*>(text.c_str());
    while (*p != 0) {
      double v[8];
      for (double& value : v) value = std::strtod(p, &p);
      poses.push_back(
          {static_cast<std::int64_t>(v[0] * 1e9),
           SE3d(gslam::SO3d::fromQuaternion(v[4], v[5], v[6], v[7]), {{v[1], v[2], v[3]}})});
      while (*p == '\n') ++p;
    }
    benchmark::DoNotOptimize(poses);
  }
  setBytes(state, text.size());
}

void writeText(benchmark::State& state, TrajectoryFormat format) {
  const Trajectory trajectory = walk();
  std::size_t size = 0;
  for (auto _ : state) {
    const std::string text = gslam::printTrajectory(trajectory, format);
    benchmark::DoNotOptimize(text.data());
    size = text.size();
  }
  setBytes(state, size);
}

void writeByStream(benchmark::State& state) {
  const Trajectory trajectory = walk();
  std::size_t size = 0;
  for (auto _ : state) {
    std::ostringstream out;
    out.precision(17);
    for (const StampedPose& p : trajectory) out << double(p.stamp) * 1e-9 << ' ' << p.pose << '\n';
    size = out.str().size();
  }
  setBytes(state, size);
}

// Long recordings: as many lines as the argument says, each with a stamp of its own.
void readLong(benchmark::State& state) {
  const std::string lines = shortText(walk(), TrajectoryFormat::tum);
  std::string text;
  text.reserve(std::size_t(state.range(0)) * 100);
  std::size_t at = 0;
  for (std::int64_t i = 0; i < state.range(0); ++i) {
    if (at == lines.size()) at = 0;
    const std::size_t end = lines.find('\n', at) + 1;
    text += gslam::secondsText(1305031098665900000 + i * 5000000);
    text.append(lines, lines.find(' ', at), end - lines.find(' ', at));
    at = end;
  }
  for (auto _ : state) {
    const Trajectory read = gslam::parseTrajectory(text, "bench");
    if (std::int64_t(read.size()) != state.range(0)) state.SkipWithError("poses are missing");
    benchmark::DoNotOptimize(read);
  }
  setBytes(state, text.size());
  state.SetItemsProcessed(state.iterations() * state.range(0));  // poses
}
BENCHMARK(readLong)
    ->Name("trajectory_read_tum_poses/gslam")
    ->Arg(1000000)
    ->Arg(10000000)
    ->Unit(benchmark::kMillisecond);

int registerAll() {
  const Trajectory trajectory = walk();
  for (const TrajectoryFormat format :
       {TrajectoryFormat::tum, TrajectoryFormat::euroc, TrajectoryFormat::kitti}) {
    const std::string name = gslam::trajectoryFormatName(format);
    const std::string full = gslam::printTrajectory(trajectory, format);
    const std::string brief = shortText(trajectory, format);
    benchmark::RegisterBenchmark(("trajectory_read_" + name + "/gslam/17_digits").c_str(), readText,
                                 full);
    benchmark::RegisterBenchmark(("trajectory_read_" + name + "/gslam/7_digits").c_str(), readText,
                                 brief);
    if (format == TrajectoryFormat::tum) {
      benchmark::RegisterBenchmark("trajectory_read_tum/std_stream/7_digits", readByStream, brief);
      benchmark::RegisterBenchmark("trajectory_read_tum/strtod/7_digits", readByStrtod, brief);
    }
    benchmark::RegisterBenchmark(("trajectory_write_" + name + "/gslam/17_digits").c_str(),
                                 writeText, format);
  }
  benchmark::RegisterBenchmark("trajectory_write_tum/std_stream/17_digits", writeByStream);
  return 0;
}

const int kRegistered = registerAll();

}  // namespace
