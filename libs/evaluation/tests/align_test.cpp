#include <gslam/base/error.h>
#include <gslam/evaluation/align.h>
#include <gslam/evaluation/ape.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "made_trajectory.h"
#ifdef GSLAM_HAS_EIGEN
#include <Eigen/Geometry>
#endif

namespace {

using gslam::align;
using gslam::Alignment;
using gslam::AlignmentMethod;
using gslam::AlignmentOptions;
using gslam::alignPositions;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::Vec3d;
using Points = std::vector<Vec3d>;

AlignmentOptions by(AlignmentMethod method, std::size_t first = 0) {
  AlignmentOptions options;
  options.method = method;
  options.first = first;
  return options;
}

Points somePoints(std::mt19937& random, std::size_t count, const Vec3d& size = {{3, 2, 1}}) {
  std::normal_distribution<double> normal;
  Points points(count);
  for (Vec3d& p : points) {
    for (std::size_t k = 0; k < 3; ++k) p[k] = size[k] * normal(random);
  }
  return points;
}

SIM3d someSimilarity(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Vec3d turn = {{normal(random), normal(random), normal(random)}};
  return SIM3d(SO3d::exp(turn), {{normal(random), 5 * normal(random), 20 * normal(random)}},
               std::exp(normal(random)));
}

Points moved(const SIM3d& s, const Points& points) {
  Points result;
  for (const Vec3d& p : points) result.push_back(s * p);
  return result;
}

double costOf(const SIM3d& s, const Points& reference, const Points& estimate) {
  double cost = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    cost += (s * estimate[i] - reference[i]).squaredNorm();
  }
  return cost;
}

TEST(align, finds_the_similarity_back) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const Points map = somePoints(random, 3 + random() % 30);
    const SIM3d truth = someSimilarity(random);
    const Alignment found = alignPositions(moved(truth, map), map, by(AlignmentMethod::sim3));
    ASSERT_TRUE(found.is_valid) << found.reason;
    ASSERT_TRUE(found.S_world_map.isApprox(truth, 1e-8)) << found.S_world_map << " for " << truth;
    const SIM3d rigid(truth.rigid());
    const Alignment found_rigid = alignPositions(moved(rigid, map), map, by(AlignmentMethod::se3));
    ASSERT_TRUE(found_rigid.S_world_map.isApprox(rigid, 1e-8));
    ASSERT_EQ(found_rigid.S_world_map.scale(), 1);
  }
}

#ifdef GSLAM_HAS_EIGEN
TEST(align, is_that_of_eigen) {
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    const std::size_t count = 4 + random() % 50;
    const Points map = somePoints(random, count);
    Points world = moved(someSimilarity(random), map);
    const Points noise = somePoints(random, count, {{0.5, 0.5, 0.5}});
    for (std::size_t i = 0; i < count; ++i) world[i] += noise[i];
    Eigen::Matrix3Xd from(3, count), to(3, count);
    for (std::size_t i = 0; i < count; ++i) {
      from.col(Eigen::Index(i)) << map[i][0], map[i][1], map[i][2];
      to.col(Eigen::Index(i)) << world[i][0], world[i][1], world[i][2];
    }
    for (const bool has_scale : {false, true}) {
      const Eigen::Matrix4d expected = Eigen::umeyama(from, to, has_scale);
      const Alignment found =
          alignPositions(world, map, by(has_scale ? AlignmentMethod::sim3 : AlignmentMethod::se3));
      ASSERT_TRUE(found.is_valid) << found.reason;
      const auto matrix = found.S_world_map.matrix();
      for (int r = 0; r < 4; ++r) {
        for (int c = 0; c < 4; ++c) {
          ASSERT_NEAR(matrix(std::size_t(r), std::size_t(c)), expected(r, c), 1e-9);
        }
      }
    }
  }
}
#endif

// No change of any parameter makes it better: of small steps, and of some large ones.
void expectNothingIsBetter(const Alignment& found, const Points& world, const Points& map,
                           const std::vector<std::size_t>& freedom, std::mt19937& random) {
  ASSERT_TRUE(found.is_valid) << found.reason;
  const double least = costOf(found.S_world_map, world, map);
  std::normal_distribution<double> normal;
  for (const double size : {1e-4, 1e-2, 1.0, 3.0}) {
    for (int i = 0; i < 200; ++i) {
      SIM3d::Tangent d{};
      for (const std::size_t k : freedom) d[k] = size * normal(random);
      // On the left: freedoms are about the axes of the world, around the mean of the points.
      Vec3d mean{};
      for (const Vec3d& p : world) mean += p / double(world.size());
      const SIM3d there(SE3d(SO3d(), mean));
      const SIM3d other = there * SIM3d::exp(d) * there.inverse() * found.S_world_map;
      ASSERT_GE(costOf(other, world, map), least * (1 - 1e-12));
    }
  }
}

TEST(align, nothing_is_better) {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    const Points map = somePoints(random, 12);
    Points world = moved(someSimilarity(random), map);
    for (Vec3d& p : world) p += somePoints(random, 1)[0];
    // Mirrored ones, too: of the rotations the best, though it fits badly.
    if (round % 2 == 1) {
      for (Vec3d& p : world) p[0] = -p[0];
    }
    expectNothingIsBetter(alignPositions(world, map, by(AlignmentMethod::se3)), world, map,
                          {0, 1, 2, 3, 4, 5}, random);
    expectNothingIsBetter(alignPositions(world, map, by(AlignmentMethod::yaw)), world, map,
                          {0, 1, 2, 5}, random);
    const Alignment sim3 = alignPositions(world, map, by(AlignmentMethod::sim3));
    if (sim3.is_valid) {
      expectNothingIsBetter(sim3, world, map, {0, 1, 2, 3, 4, 5, 6}, random);
    }
  }
}

TEST(align, yaw_turns_about_the_vertical_alone) {
  std::mt19937 random(4);
  const Points map = somePoints(random, 40);
  for (const Vec3d& up : {Vec3d{{0, 0, 1}}, Vec3d{{0, -2, 0}}, Vec3d{{1, 1, 1}}}) {
    const SIM3d truth(SE3d(SO3d::exp(2.5 * up.normalized()), {{3, 4, 5}}));
    AlignmentOptions options = by(AlignmentMethod::yaw);
    options.up = up;
    const Alignment found = alignPositions(moved(truth, map), map, options);
    ASSERT_TRUE(found.is_valid);
    EXPECT_TRUE(found.S_world_map.isApprox(truth, 1e-9)) << found.S_world_map;
  }
  // A tilt cannot be mended.
  const SIM3d tilt(SE3d(SO3d::exp({{0.5, 0, 0}}), {{3, 4, 5}}));
  const Alignment found = alignPositions(moved(tilt, map), map, by(AlignmentMethod::yaw));
  ASSERT_TRUE(found.is_valid);
  const Vec3d turn = found.S_world_map.rotation().log();
  EXPECT_NEAR(turn[0], 0, 1e-12);
  EXPECT_NEAR(turn[1], 0, 1e-12);
}

TEST(align, scale_leaves_rotation_and_origin) {
  std::mt19937 random(5);
  const Points map = somePoints(random, 20);
  const Points world = moved(SIM3d(made::someMotion(), 2.5), map);
  const Alignment found = alignPositions(world, map, by(AlignmentMethod::scale));
  ASSERT_TRUE(found.is_valid);
  EXPECT_NEAR(found.S_world_map.scale(), 2.5, 1e-12);
  EXPECT_EQ(found.S_world_map.rigid().translation().norm(), 0);
  EXPECT_EQ(found.S_world_map.rotation().angle(), 0);
}

TEST(align, origin_lays_the_first_pose_on_its_partner) {
  const gslam::Trajectory reference = made::trajectory(50);
  const gslam::Trajectory estimate = made::changed(
      made::noisy(reference, 0.1, 0.05), [](const SE3d& t) { return made::someMotion() * t; });
  const gslam::PosePairs pairs = made::pairs(reference, estimate);
  const Alignment found = align(pairs, by(AlignmentMethod::origin));
  ASSERT_TRUE(found.is_valid);
  EXPECT_TRUE(aligned(found.S_world_map, pairs.estimate[0]).isApprox(pairs.reference[0], 1e-12));
  EXPECT_TRUE(align(pairs, by(AlignmentMethod::none)).S_world_map.isApprox(SIM3d(), 0));
}

TEST(align, only_the_first_ones_count) {
  const gslam::Trajectory reference = made::trajectory(60);
  std::size_t i = 0;
  // From the 20th on all is nonsense.
  const gslam::Trajectory estimate = made::changed(reference, [&](const SE3d& t) {
    return ++i <= 20 ? made::someMotion() * t : SE3d(t.rotation(), {{double(i * i), 0, 0}});
  });
  const gslam::PosePairs pairs = made::pairs(reference, estimate);
  const Alignment found = align(pairs, gslam::parseAlignment("first:20"));
  ASSERT_TRUE(found.is_valid);
  EXPECT_TRUE(found.S_world_map.rigid().isApprox(made::someMotion().inverse(), 1e-9));
  EXPECT_FALSE(align(pairs).S_world_map.rigid().isApprox(made::someMotion().inverse(), 1e-3));
  EXPECT_FALSE(align(pairs, gslam::parseAlignment("first:2")).is_valid);
}

void expectRefused(const Points& world, const Points& map, AlignmentMethod method,
                   const std::string& reason) {
  const Alignment found = alignPositions(world, map, by(method));
  EXPECT_FALSE(found.is_valid) << found.S_world_map;
  EXPECT_NE(found.reason.find(reason), std::string::npos) << found.reason;
}

TEST(align, degenerate_positions_are_refused_with_a_reason) {
  std::mt19937 random(6);
  const Points wide = somePoints(random, 10);
  Points same(10, Vec3d{{1e5, 2e5, -3e3}}), line, vertical;
  for (int i = 0; i < 10; ++i) {
    line.push_back(Vec3d{{100.3, 7, 9}} + double(i) * Vec3d{{0.1, 0.7, -0.3}});
    vertical.push_back(Vec3d{{1, 2, double(i)}});
  }
  for (const AlignmentMethod method : {AlignmentMethod::se3, AlignmentMethod::sim3}) {
    expectRefused(wide, same, method, "all positions of the estimate are the same");
    expectRefused(same, wide, method, "all positions of the reference are the same");
    expectRefused(line, line, method, "lie on a line");
    expectRefused(wide, line, method, "estimate lie on a line");
    expectRefused({wide[0], wide[1]}, {wide[0], wide[1]}, method, "2 pairs do not fix a rotation");
    expectRefused({wide[0]}, {wide[0]}, method, "1 pair does not");
  }
  expectRefused(wide, same, AlignmentMethod::scale, "the same");
  expectRefused(vertical, vertical, AlignmentMethod::yaw, "any heading");
  expectRefused(same, same, AlignmentMethod::yaw, "any heading");
  // The last digits of a file are no width.
  std::normal_distribution<double> normal;
  Points rounded = line;
  for (Vec3d& p : rounded) p += 1e-8 * Vec3d{{normal(random), normal(random), normal(random)}};
  expectRefused(rounded, rounded, AlignmentMethod::se3, "lie on a line");
  for (Vec3d& p : rounded) p += 1e-3 * Vec3d{{normal(random), normal(random), normal(random)}};
  EXPECT_TRUE(alignPositions(rounded, rounded, by(AlignmentMethod::se3)).is_valid);
  // Two places do fix a heading, and a line has a scale.
  EXPECT_TRUE(
      alignPositions(Points{wide[0], wide[1]}, Points{wide[0], wide[1]}, by(AlignmentMethod::yaw))
          .is_valid);
  EXPECT_NEAR(alignPositions(line, moved(SIM3d(SE3d(), 0.5), line), by(AlignmentMethod::scale))
                  .S_world_map.scale(),
              2, 1e-9);
}

TEST(align, mirrored_positions_are_named_and_never_mirrored_back) {
  std::mt19937 random(7);
  const Points map = somePoints(random, 50);
  Points world = map;
  for (Vec3d& p : world) p[1] = -p[1];
  const Alignment found = alignPositions(world, map, by(AlignmentMethod::se3));
  ASSERT_TRUE(found.is_valid);
  EXPECT_TRUE(found.is_mirrored);
  EXPECT_GT(costOf(found.S_world_map, world, map), 1);
  EXPECT_FALSE(alignPositions(map, map, by(AlignmentMethod::se3)).is_mirrored);
  // A flat way looks the same in a mirror: nothing is wrong with it.
  const Points flat = somePoints(random, 50, {{5, 3, 1e-4}});
  Points turned = flat;
  for (Vec3d& p : turned) p[2] = -p[2];
  const Alignment flat_found = alignPositions(turned, flat, by(AlignmentMethod::se3));
  ASSERT_TRUE(flat_found.is_valid);
  EXPECT_FALSE(flat_found.is_mirrored);
  // Of a mirrored cube corner several rotations are as good.
  const Points axes = {{{1, 0, 0}},  {{-1, 0, 0}}, {{0, 1, 0}},
                       {{0, -1, 0}}, {{0, 0, 1}},  {{0, 0, -1}}};
  Points opposite = axes;
  for (Vec3d& p : opposite) p = -p;
  expectRefused(opposite, axes, AlignmentMethod::sim3, "several rotations");
}

TEST(align, digits_survive_far_from_the_origin) {
  std::mt19937 random(8);
  const Points map = somePoints(random, 100);
  const SIM3d far(SE3d(SO3d::exp({{0.3, 0.2, 0.1}}), {{4e5, 5e6, 300}}));  // UTM coordinates
  const Alignment found = alignPositions(moved(far, map), map, by(AlignmentMethod::se3));
  ASSERT_TRUE(found.is_valid);
  EXPECT_LT(std::sqrt(costOf(found.S_world_map, moved(far, map), map) / 100), 1e-8);
}

TEST(align, texts) {
  for (const char* const text : {"none", "origin", "se3", "sim3", "scale", "yaw", "first:12"}) {
    EXPECT_EQ(gslam::alignmentText(gslam::parseAlignment(text)), text);
  }
  for (const char* const text :
       {"", "SE3", "first", "first:", "first:0", "first:-1", "first:1.5"}) {
    EXPECT_THROW(gslam::parseAlignment(text), gslam::ArgumentError) << text;
  }
}

TEST(align, refuses_wrong_arguments) {
  const Points one = {{{1, 2, 3}}}, two = {{{1, 2, 3}}, {{3, 4, 5}}};
  const Points no_number = {{{1, std::nan(""), 3}}};
  EXPECT_THROW(alignPositions(one, two), gslam::ArgumentError);
  EXPECT_THROW(alignPositions(Points(), Points()), gslam::ArgumentError);
  EXPECT_THROW(alignPositions(no_number, one), gslam::ArgumentError);
  EXPECT_THROW(align(gslam::PosePairs()), gslam::ArgumentError);
  AlignmentOptions options = by(AlignmentMethod::yaw);
  options.up = {{0, 0, 0}};
  EXPECT_THROW(alignPositions(two, two, options), gslam::ArgumentError);
}

}  // namespace
