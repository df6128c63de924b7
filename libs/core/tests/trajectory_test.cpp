// Trajectories against a search through all poses.
#include <gslam/core/trajectory.h>
#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace {

using gslam::ArgumentError;
using gslam::SE3d;
using gslam::StampedPose;
using gslam::Trajectory;
using gslam::Vec3d;

SE3d poseAt(double x) {
  return SE3d(gslam::SO3d(), {{x, 0, 0}});
}

std::uint64_t timeBetween(std::int64_t a, std::int64_t b) {
  return a < b ? std::uint64_t(b) - std::uint64_t(a) : std::uint64_t(a) - std::uint64_t(b);
}

// Stamps in any order, each once, near one another or as far apart as can be.
std::vector<StampedPose> drawnPoses(std::mt19937_64& random, int count) {
  std::vector<StampedPose> poses;
  while (static_cast<int>(poses.size()) < count) {
    const std::int64_t stamp = static_cast<std::int64_t>(random()) >> (random() % 2 == 0 ? 0 : 57);
    const bool is_new = std::none_of(poses.begin(), poses.end(),
                                     [&](const StampedPose& p) { return p.stamp == stamp; });
    if (is_new) poses.push_back({stamp, gslam::randomOf<SE3d>(random)});
  }
  return poses;
}

std::vector<std::int64_t> questions(std::mt19937_64& random,
                                    const std::vector<StampedPose>& poses) {
  std::vector<std::int64_t> stamps = {INT64_MIN, -1, 0, 1, INT64_MAX};
  for (const StampedPose& p : poses) {
    stamps.push_back(p.stamp);
    if (p.stamp != INT64_MAX) stamps.push_back(p.stamp + 1);
    if (p.stamp != INT64_MIN) stamps.push_back(p.stamp - 1);
    stamps.push_back(static_cast<std::int64_t>(random()) >> (random() % 64));
  }
  return stamps;
}

TEST(Trajectory, IsOrderedHoweverItWasMade) {
  std::mt19937_64 random(1);
  for (int count = 0; count < 40; ++count) {
    const std::vector<StampedPose> poses = drawnPoses(random, count);
    const Trajectory whole(poses);
    Trajectory added;
    for (const StampedPose& p : poses) added.add(p.stamp, p.pose);
    ASSERT_EQ(whole.size(), poses.size());
    ASSERT_EQ(added.size(), poses.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
      ASSERT_TRUE(i == 0 || whole[i - 1].stamp < whole[i].stamp);
      ASSERT_EQ(whole[i].stamp, added[i].stamp);
      const auto source = std::find_if(poses.begin(), poses.end(), [&](const StampedPose& p) {
        return p.stamp == whole[i].stamp;
      });
      ASSERT_EQ(whole[i].pose.translation(), source->pose.translation());
      ASSERT_EQ(added[i].pose.translation(), source->pose.translation());
    }
  }
}

TEST(Trajectory, FindsWhatASearchThroughAllFinds) {
  std::mt19937_64 random(2);
  for (int count = 0; count < 40; ++count) {
    const Trajectory trajectory(drawnPoses(random, count));
    const std::vector<StampedPose> all(trajectory.begin(), trajectory.end());
    for (const std::int64_t stamp : questions(random, all)) {
      const auto first = std::find_if(all.begin(), all.end(),
                                      [&](const StampedPose& p) { return p.stamp >= stamp; });
      ASSERT_EQ(trajectory.lowerBound(stamp) - trajectory.begin(), first - all.begin());
      const auto nearest =
          std::min_element(all.begin(), all.end(), [&](const StampedPose& a, const StampedPose& b) {
            return timeBetween(a.stamp, stamp) < timeBetween(b.stamp, stamp);
          });
      const StampedPose* const found = trajectory.nearest(stamp);
      if (all.empty()) {
        ASSERT_EQ(found, nullptr);
      } else {
        ASSERT_EQ(found->stamp, nearest->stamp);
      }
    }
  }
}

TEST(Trajectory, InterpolatesBetweenThePosesAroundAStamp) {
  std::mt19937_64 random(3);
  for (int count = 0; count < 30; ++count) {
    const Trajectory trajectory(drawnPoses(random, count));
    const std::vector<StampedPose> all(trajectory.begin(), trajectory.end());
    for (const std::int64_t stamp : questions(random, all)) {
      SE3d expected = poseAt(-1), pose = poseAt(-1);
      bool inside = false;
      std::uint64_t gap = 0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].stamp == stamp) {
          expected = all[i].pose;
          inside = true;
          gap = 0;
        } else if (i > 0 && all[i - 1].stamp < stamp && stamp < all[i].stamp) {
          gap = timeBetween(all[i - 1].stamp, all[i].stamp);
          const double part = double(timeBetween(all[i - 1].stamp, stamp)) / double(gap);
          expected = gslam::interpolateSplit(all[i - 1].pose, all[i].pose, part);
          inside = gap <= std::uint64_t(INT64_MAX);
          if (!inside) expected = poseAt(-1);
        }
      }
      ASSERT_EQ(trajectory.interpolate(stamp, pose), inside);
      ASSERT_TRUE(pose.isApprox(expected, 1e-12));
      if (!inside || gap == 0) continue;
      ASSERT_TRUE(trajectory.interpolate(stamp, pose, std::int64_t(gap)));
      pose = poseAt(-1);
      ASSERT_FALSE(trajectory.interpolate(stamp, pose, std::int64_t(gap) - 1));
      ASSERT_FALSE(trajectory.interpolate(stamp, pose, -1));
      ASSERT_EQ(pose.translation(), poseAt(-1).translation());
    }
  }
}

TEST(Trajectory, OfTwoAsNearTheEarlierIsTaken) {
  const Trajectory trajectory({{10, poseAt(1)}, {20, poseAt(2)}});
  EXPECT_EQ(trajectory.nearest(15)->stamp, 10);
  EXPECT_EQ(trajectory.nearest(16)->stamp, 20);
}

TEST(Trajectory, AStampTwiceIsRefused) {
  EXPECT_THROW(Trajectory({{5, poseAt(1)}, {7, poseAt(2)}, {5, poseAt(3)}}), ArgumentError);
  EXPECT_THROW(Trajectory({{5, poseAt(1)}, {5, poseAt(3)}}), ArgumentError);
  Trajectory trajectory({{5, poseAt(1)}, {7, poseAt(2)}});
  EXPECT_THROW(trajectory.add(5, poseAt(9)), ArgumentError);
  EXPECT_THROW(trajectory.add(7, poseAt(9)), ArgumentError);
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory[0].pose.translation()[0], 1);
  try {
    trajectory.add(7, poseAt(9));
  } catch (const ArgumentError& error) {
    EXPECT_STREQ(error.what(), "stamp is 7 ns, which another pose has");
  }
}

TEST(Trajectory, LengthAndDuration) {
  EXPECT_EQ(Trajectory().length(), 0);
  EXPECT_EQ(Trajectory().duration(), 0U);
  const Trajectory trajectory({{30, poseAt(1)}, {10, poseAt(0)}, {20, poseAt(5)}});
  EXPECT_EQ(trajectory.length(), 9);
  EXPECT_EQ(trajectory.duration(), 20U);
  EXPECT_EQ(Trajectory({{INT64_MIN, poseAt(0)}, {INT64_MAX, poseAt(0)}}).duration(), UINT64_MAX);
}

}  // namespace
