// KITTI's figures against a double loop written from the devkit's published definition, on
// matrices.
#include <gslam/base/error.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/evaluation/kitti.h>
#include <gslam/evaluation/segments.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>

#include "made_trajectory.h"
#include "test_data.h"

namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

// A row-major 3 x 4 matrix as it stands in the file.
using Matrix = std::array<double, 12>;

std::vector<Matrix> matricesOf(const std::string& path) {
  std::ifstream in(path);
  std::vector<Matrix> poses;
  Matrix m;
  while (in >> m[0]) {
    for (std::size_t i = 1; i < 12; ++i) in >> m[i];
    poses.push_back(m);
  }
  return poses;
}

std::vector<Matrix> matricesOf(const std::vector<gslam::SE3d>& poses) {
  std::vector<Matrix> result;
  for (const gslam::SE3d& pose : poses) {
    const gslam::Mat<double, 3, 4> m = pose.matrix3x4();
    Matrix matrix;
    std::copy(m.values, m.values + 12, matrix.begin());
    result.push_back(matrix);
  }
  return result;
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      c[4 * i + j] = j == 3 ? a[4 * i + 3] : 0;
      for (std::size_t k = 0; k < 3; ++k) c[4 * i + j] += a[4 * i + k] * b[4 * k + j];
    }
  }
  return c;
}

// By cofactors: the matrices of files are not quite rotations.
Matrix inverse(const Matrix& m) {
  const auto minorOf = [&m](std::size_t r, std::size_t c) {
    const std::size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[4 * r1 + c1] * m[4 * r2 + c2] - m[4 * r1 + c2] * m[4 * r2 + c1];
  };
  const double determinant = m[0] * minorOf(0, 0) + m[1] * minorOf(0, 1) + m[2] * minorOf(0, 2);
  Matrix i{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) i[4 * r + c] = minorOf(c, r) / determinant;
    for (std::size_t c = 0; c < 3; ++c) i[4 * r + 3] -= i[4 * r + c] * m[4 * c + 3];
  }
  return i;
}

struct Row {
  double length, speed, t, r;
};

// calcSequenceErrors() of evaluate_odometry.cpp.
std::vector<Row> devkit(const std::vector<Matrix>& truth, const std::vector<Matrix>& result) {
  std::vector<double> dist = {0};
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Matrix &a = truth[i - 1], &b = truth[i];
    dist.push_back(dist[i - 1] + std::hypot(b[3] - a[3], b[7] - a[7], b[11] - a[11]));
  }
  std::vector<Row> rows;
  for (std::size_t first = 0; first < truth.size(); first += 10) {
    for (int hundreds = 1; hundreds <= 8; ++hundreds) {
      const double length = 100 * hundreds;
      std::size_t last = first;
      while (last < truth.size() && dist[last] <= dist[first] + length) ++last;
      if (last == truth.size()) continue;
      const Matrix delta_truth = product(inverse(truth[first]), truth[last]);
      const Matrix delta_result = product(inverse(result[first]), result[last]);
      const Matrix error = product(inverse(delta_result), delta_truth);
      const double d = 0.5 * (error[0] + error[5] + error[10] - 1);
      rows.push_back({length, length / (0.1 * double(last - first + 1)),
                      std::hypot(error[3], error[7], error[11]) / length,
                      std::acos(std::max(std::min(d, 1.0), -1.0)) / length});
    }
  }
  return rows;
}

struct Sum {
  std::size_t count = 0;
  double t = 0, r = 0;
  void add(const Row& row) {
    ++count;
    t += row.t;
    r += row.r;
  }
};

// What the two may differ by, as parts of the figures: acos() of a trace near 3 is not exact, less
// so of matrices with seven digits, which are no rotations by as much.
struct Slack {
  double t, r;
};
constexpr Slack kExact = {1e-9, 1e-6}, kSevenDigits = {2e-6, 5e-4};

void expectNear(const gslam::KittiBin& bin, const Sum& sum, const Slack& slack) {
  ASSERT_EQ(bin.count, sum.count);
  const double count = double(sum.count);
  EXPECT_NEAR(bin.t_err_percent, 100 * sum.t / count, slack.t * bin.t_err_percent);
  EXPECT_NEAR(bin.r_err_deg_per_m, kDegrees * sum.r / count, slack.r * bin.r_err_deg_per_m);
}

void expectDevkit(const gslam::KittiErrors& ours, const std::vector<Row>& rows,
                  const Slack& slack) {
  Sum all;
  std::map<double, Sum> lengths, speeds;
  for (const Row& row : rows) {
    all.add(row);
    lengths[row.length].add(row);
    for (int even = 2; even < 25; even += 2) {
      const double speed = even;
      if (std::fabs(row.speed - speed) < 2.0) speeds[speed].add(row);
    }
  }
  expectNear({0, ours.count, ours.t_err_percent, ours.r_err_deg_per_m}, all, slack);
  ASSERT_EQ(ours.lengths.size(), lengths.size());
  for (const gslam::KittiBin& bin : ours.lengths) expectNear(bin, lengths[bin.at], slack);
  std::size_t many = 0;
  for (const auto& speed : speeds) many += speed.second.count > 2 ? 1 : 0;
  ASSERT_EQ(ours.speeds.size(), many);
  for (const gslam::KittiBin& bin : ours.speeds) expectNear(bin, speeds[bin.at], slack);
}

TEST(kitti, is_the_devkit_on_sequence_00) {
  NEEDS_TEST_DATA();
  const std::string folder = test_data::folder() + "trajectories/evo/";
  const std::string truth = folder + "KITTI_00_gt.txt", result = folder + "KITTI_00_ORB.txt";
  gslam::AssociationOptions how;
  how.is_numbered = true;
  const gslam::PosePairs pairs =
      gslam::pairPoses(gslam::readTrajectory(truth), gslam::readTrajectory(result), how);
  ASSERT_EQ(pairs.size(), 4541U);
  const gslam::KittiErrors ours = gslam::kittiErrors(pairs);
  EXPECT_GT(ours.count, 3000U);
  EXPECT_EQ(ours.lengths.size(), 8U);
  expectDevkit(ours, devkit(matricesOf(truth), matricesOf(result)), kSevenDigits);
}

TEST(kitti, is_the_devkit_on_made_ways) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const gslam::Trajectory reference =
        made::changed(made::trajectory(1500), [](const gslam::SE3d& pose) {
          return gslam::SE3d(pose.rotation(), 5.0 * pose.translation());
        });
    const gslam::PosePairs pairs = made::pairs(reference, made::noisy(reference, 0.5, 0.02, seed));
    const gslam::KittiErrors ours = gslam::kittiErrors(pairs);
    ASSERT_GT(ours.count, 100U);
    expectDevkit(ours, devkit(matricesOf(pairs.reference), matricesOf(pairs.estimate)), kExact);
  }
}

TEST(kitti, a_short_way_has_no_figures_and_a_reason) {
  const gslam::Trajectory reference = made::trajectory(100);
  const gslam::KittiErrors none = gslam::kittiErrors(made::pairs(reference, reference));
  EXPECT_EQ(none.count, 0U);
  EXPECT_NE(none.reason.find("no longer than the shortest segment of 100 m"), std::string::npos);
}

TEST(kitti, a_scale_counts) {
  gslam::Trajectory reference;
  for (std::int64_t i = 0; i < 500; ++i) reference.add(i, gslam::SE3d({}, {{double(i), 0, 0}}));
  const gslam::Trajectory estimate = made::changed(reference, [](const gslam::SE3d& pose) {
    return gslam::SE3d(pose.rotation(), 0.9 * pose.translation());
  });
  const gslam::PosePairs pairs = made::pairs(reference, estimate);
  // A segment ends behind its length, one metre too late here.
  EXPECT_NEAR(gslam::kittiErrors(pairs).lengths[0].t_err_percent, 10.1, 1e-9);
  EXPECT_NEAR(gslam::kittiErrors(pairs, {}, 1 / 0.9).t_err_percent, 0, 1e-9);
}

TEST(kitti, speeds_of_two_segments_are_not_printed) {
  gslam::Trajectory reference;
  for (std::int64_t i = 0; i < 130; ++i) reference.add(i, gslam::SE3d({}, {{double(i), 0, 0}}));
  const auto part = [&](std::size_t count) {
    gslam::Trajectory result;
    for (std::size_t i = 0; i < count; ++i) result.add(reference[i].stamp, reference[i].pose);
    return gslam::kittiErrors(made::pairs(result, result));
  };
  EXPECT_EQ(part(115).count, 2U);
  EXPECT_EQ(part(115).speeds.size(), 0U);
  EXPECT_EQ(part(125).count, 3U);
  EXPECT_EQ(part(125).speeds.size(), 2U);  // 9.8 m/s is within 2 m/s of 8 and of 10
}

TEST(kitti, refuses_wrong_options) {
  const gslam::Trajectory some = made::trajectory(10);
  const gslam::PosePairs pairs = made::pairs(some, some);
  gslam::KittiOptions options;
  options.step = 0;
  EXPECT_THROW(gslam::kittiErrors(pairs, options), gslam::ArgumentError);
  options = {};
  options.lengths = {100, -5};
  EXPECT_THROW(gslam::kittiErrors(pairs, options), gslam::ArgumentError);
  options.lengths = {};
  EXPECT_THROW(gslam::kittiErrors(pairs, options), gslam::ArgumentError);
}

TEST(kitti, matrices_are_read_as_they_stand) {
  const std::string path = testing::TempDir() + "gslam_evaluation_matrices.txt";
  const auto write = [&path](const std::string& text) { std::ofstream(path) << text; };
  write("1.5 2 3 4 5 6 7 8 9 10 11 12\r\n\n# no pose\n1,0,0,1 0 1 0 2 0 0 1 -3e0 # one\n");
  const std::vector<gslam::KittiMatrix> matrices = gslam::readKittiMatrices(path);
  ASSERT_EQ(matrices.size(), 2U);
  EXPECT_EQ(matrices[0](0, 0), 1.5);
  EXPECT_EQ(matrices[0](1, 1), 6);
  EXPECT_EQ(matrices[1](2, 3), -3);
  for (const char* const text : {"1 2 3\n", "1 2 3 4 5 6 7 8 9 10 11 12 13\n", "a b\n"}) {
    write(text);
    EXPECT_THROW(gslam::readKittiMatrices(path), gslam::ParseError) << text;
  }
  std::remove(path.c_str());
  EXPECT_THROW(gslam::readKittiMatrices(path), gslam::FileError);
}

// ---- segments of any length

TEST(segments, are_those_of_the_definition) {
  const gslam::Trajectory reference = made::trajectory(400);
  const gslam::PosePairs pairs = made::pairs(reference, made::noisy(reference, 0.05, 0.02));
  std::vector<double> way = {0};
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    way.push_back(way.back() +
                  (pairs.reference[i].translation() - pairs.reference[i - 1].translation()).norm());
  }
  const std::vector<double> lengths = {2, 10, 1e4};
  const std::vector<gslam::SegmentErrors> ours = segmentErrors(pairs, lengths);
  ASSERT_EQ(ours.size(), 3U);
  EXPECT_EQ(ours[2].translation.count, 0U);
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double> translation, rotation;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      std::size_t best = i + 1;
      for (std::size_t j = i + 1; j < way.size(); ++j) {
        if (std::fabs(way[j] - way[i] - lengths[k]) < std::fabs(way[best] - way[i] - lengths[k])) {
          best = j;
        }
      }
      if (std::fabs(way[best] - way[i] - lengths[k]) > 0.2 * lengths[k]) continue;
      const gslam::SE3d error = (pairs.reference[i].inverse() * pairs.reference[best]).inverse() *
                                (pairs.estimate[i].inverse() * pairs.estimate[best]);
      translation.push_back(error.translation().norm());
      rotation.push_back(error.rotation().angle() * kDegrees);
    }
    const gslam::Statistics t = gslam::statisticsOf(translation);
    ASSERT_EQ(ours[k].translation.count, t.count);
    EXPECT_NEAR(ours[k].translation.rmse, t.rmse, 1e-12);
    EXPECT_NEAR(ours[k].translation_percent.mean, 100 * t.mean / lengths[k], 1e-10);
    EXPECT_NEAR(ours[k].rotation_deg.median, gslam::statisticsOf(rotation).median, 1e-9);
    EXPECT_NEAR(ours[k].rotation_deg_per_m.max, gslam::statisticsOf(rotation).max / lengths[k],
                1e-9);
  }
}

// Yaw that drifts is yaw alone, a tilt that drifts is gravity alone, in the axes of the world.
TEST(segments, tell_yaw_from_gravity) {
  const auto errorsWith = [](const gslam::Vec3d& turn) {
    gslam::Trajectory reference, estimate;
    const gslam::SO3d mounted = gslam::SO3d::exp({{-1.2, 0.3, 0.7}});  // a camera that looks ahead
    for (std::int64_t i = 0; i < 100; ++i) {
      const gslam::Vec3d place = {{double(i), 0, 0}};
      reference.add(i, gslam::SE3d(mounted, place));
      estimate.add(i, gslam::SE3d(gslam::SO3d::exp(double(i) * turn) * mounted, place));
    }
    const std::vector<double> lengths = {10};
    return segmentErrors(made::pairs(reference, estimate), lengths)[0];
  };
  const gslam::SegmentErrors yaw = errorsWith({{0, 0, 0.001}}), tilt = errorsWith({{0.001, 0, 0}});
  EXPECT_NEAR(yaw.yaw_deg.median, 0.01 * kDegrees, 1e-6);
  EXPECT_NEAR(yaw.gravity_deg.max, 0, 1e-6);
  EXPECT_NEAR(tilt.gravity_deg.median, 0.01 * kDegrees, 1e-6);
  EXPECT_NEAR(tilt.yaw_deg.max, 0, 1e-6);
  EXPECT_NEAR(tilt.rotation_deg.median, 0.01 * kDegrees, 1e-6);
}

TEST(segments, refuse_lengths_that_are_none) {
  const gslam::Trajectory some = made::trajectory(10);
  const std::vector<double> lengths = {0};
  EXPECT_THROW(segmentErrors(made::pairs(some, some), lengths), gslam::ArgumentError);
}

}  // namespace
