#include <gslam/estimator/solvers/relative_pose_3pt_vertical.h>
#include <gtest/gtest.h>

#include "closed_form_helpers.h"
#include "instances.h"

namespace {

using namespace gslam;
using namespace solver_test;

using VerticalPoses = std::array<SE3d, 4>;

struct VerticalScene {
  SE3d T_second_first;  // |t| = 1 but for `baseline`
  Vec3d gravity_first, gravity_second;
  std::vector<Vec3d> points, first, second;

  void project() {
    first.clear();
    second.clear();
    for (const Vec3d& p : points) {
      first.push_back(p.normalized());
      second.push_back((T_second_first * p).normalized());
    }
    gravity_second = T_second_first.rotation() * gravity_first;
  }
  SE3d truth() const {
    return SE3d(T_second_first.rotation(), T_second_first.translation().normalized());
  }
};

// Any turn, points all around.
template <class Generator>
VerticalScene randomVerticalScene(Generator& generator, double baseline = 1, double reach = 5) {
  VerticalScene s;
  s.T_second_first = SE3d(randomOf<SO3d>(generator), baseline * randomDirection<double>(generator));
  s.gravity_first = randomDirection<double>(generator);
  s.points = randomPoints<3>(generator, 3, reach);
  s.project();
  return s;
}

double leastDifference(const VerticalPoses& poses, std::size_t count, const SE3d& truth) {
  double least = kInf;
  for (std::size_t i = 0; i < count; ++i) {
    least = std::fmin(least, poseError(poses[i], truth));
  }
  return least;
}

void expectValid(const VerticalPoses& poses, std::size_t count, const VerticalScene& s,
                 double tolerance) {
  for (std::size_t i = 0; i < count; ++i) {
    const SE3d& t = poses[i];
    ASSERT_TRUE(isFinite(t)) << t;
    EXPECT_NEAR(t.translation().norm(), 1, 1e-12);
    EXPECT_LT((t.rotation() * s.gravity_first - s.gravity_second).norm(), 1e-12);
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3d turned = t.rotation() * s.first[j];
      const Vec3d n = turned.cross(s.second[j]);
      EXPECT_NEAR(n.dot(t.translation()), 0, tolerance);
      // In front of both.
      EXPECT_GT(s.second[j].cross(t.translation()).dot(n), 0);
      EXPECT_GT(turned.cross(t.translation()).dot(n), 0);
    }
  }
}

TEST(RelativePose3ptVertical, FindsTheTruth) {
  std::mt19937 generator(1);
  const std::size_t count = instances();
  std::size_t lost = 0;
  std::size_t all = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const VerticalScene s = randomVerticalScene(generator);
    VerticalPoses poses;
    const std::size_t found =
        relativePose3ptVertical(s.first, s.second, s.gravity_first, s.gravity_second, poses);
    expectValid(poses, found, s, 1e-9);
    all += found;
    lost += !(leastDifference(poses, found, s.truth()) < 1e-6);
  }
  EXPECT_LE(lost, count / 10000);
  EXPECT_LT(all, 3 * count);
}

// A camera on a vehicle: small turns, points ahead, gravity along an axis, or zeros in plenty.
TEST(RelativePose3ptVertical, FindsTheTruthAtSpecialMotions) {
  std::mt19937 generator(2);
  const std::vector<Vec3d> directions = {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}};
  for (const Vec3d& gravity : directions) {
    for (const Vec3d& motion : directions) {
      for (const double angle : {0.0, 0.1, 1.5707963267948966, 3.1415926535897931}) {
        std::size_t lost = 0;
        for (int i = 0; i < 100; ++i) {
          VerticalScene s = randomVerticalScene(generator);
          s.gravity_first = gravity;
          s.T_second_first = SE3d(SO3d::exp(angle * gravity), motion);
          s.project();
          VerticalPoses poses;
          const std::size_t found =
              relativePose3ptVertical(s.first, s.second, s.gravity_first, s.gravity_second, poses);
          expectValid(poses, found, s, 1e-8);
          lost += !(leastDifference(poses, found, s.truth()) < 1e-6);
        }
        EXPECT_LE(lost, 1u) << gravity << ", " << motion << ", " << angle;
      }
    }
  }
}

TEST(RelativePose3ptVertical, KeepsDigitsOfSmallBaselines) {
  std::mt19937 generator(3);
  for (const double baseline : {1e-2, 1e-4}) {
    std::size_t lost = 0;
    for (std::size_t i = 0; i < 1000; ++i) {
      const VerticalScene s = randomVerticalScene(generator, baseline);
      VerticalPoses poses;
      const std::size_t found =
          relativePose3ptVertical(s.first, s.second, s.gravity_first, s.gravity_second, poses);
      lost += !(leastDifference(poses, found, s.truth()) < 1e-6);
    }
    // Three roots are as near to each other as the baseline is short.
    EXPECT_LE(lost, baseline > 1e-3 ? 2u : 120u) << baseline;
  }
}

TEST(RelativePose3ptVertical, SurvivesDegenerateSets) {
  std::mt19937 generator(4);
  for (int i = 0; i < 2000; ++i) {
    VerticalScene s = randomVerticalScene(generator, i % 5 == 0 ? 0 : 1);
    if (i % 5 == 1) s.points[2] = s.points[1];
    if (i % 5 == 2) s.points[2] = 0.5 * (s.points[0] + s.points[1]);
    if (i % 5 == 3) s.points[0] = 3 * s.gravity_first;
    if (i % 5 == 4) s.points[0] = s.points[1] = s.points[2] = s.gravity_first;
    s.project();
    VerticalPoses poses;
    const std::size_t found =
        relativePose3ptVertical(s.first, s.second, s.gravity_first, s.gravity_second, poses);
    expectValid(poses, found, s, 1e-7);
    if (i % 5 == 3) {
      EXPECT_LT(leastDifference(poses, found, s.truth()), 1e-5);
    }
  }
}

TEST(RelativePose3ptVertical, IsNeverNan) {
  std::mt19937 generator(5);
  for (const double value : absurdValues()) {
    for (std::size_t at = 0; at < 24; ++at) {
      VerticalScene s = randomVerticalScene(generator);
      if (at < 9) s.first[at / 3][at % 3] = value;
      if (at >= 9 && at < 18) s.second[at / 3 - 3][at % 3] = value;
      if (at >= 18 && at < 21) s.gravity_first[at - 18] = value;
      if (at >= 21) s.gravity_second[at - 21] = value;
      VerticalPoses poses;
      std::size_t found =
          relativePose3ptVertical(s.first, s.second, s.gravity_first, s.gravity_second, poses);
      for (std::size_t i = 0; i < found; ++i) EXPECT_TRUE(isFinite(poses[i])) << poses[i];
      for (Vec3d& f : s.first) f *= value;
      for (Vec3d& f : s.second) f *= value;
      found = relativePose3ptVertical(s.first, s.second, s.gravity_first, s.gravity_second, poses);
      for (std::size_t i = 0; i < found; ++i) EXPECT_TRUE(isFinite(poses[i])) << poses[i];
    }
  }
  const std::vector<Vec3d> two(2), three(3);
  VerticalPoses poses;
  EXPECT_THROW(relativePose3ptVertical(two, three, three[0], three[0], poses), ArgumentError);
  EXPECT_THROW(relativePose3ptVertical(three, two, three[0], three[0], poses), ArgumentError);
  EXPECT_EQ(relativePose3ptVertical(three, three, three[0], three[0], poses), 0u);
}

}  // namespace
