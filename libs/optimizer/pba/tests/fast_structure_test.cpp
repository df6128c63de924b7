#include "bundle/fast_structure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "fast_reference.h"

namespace fast_reference {
namespace {

using gslam::detail::pba::FastStructure;
using gslam::detail::pba::kNoBlock;
using gslam::detail::pba::makeFastStructure;

// Observations in no order, so many that they come in several parts.
Arrays shuffled() {
  Shape shape;
  shape.cameras = 40;
  shape.points = 30000;
  shape.observations = 150000;
  shape.walks = 2;
  Arrays arrays = synthetic_bundle::make(shape);
  std::uint64_t random = 1;
  for (std::size_t i = arrays.pixels.size(); i > 1; --i) {
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    const std::size_t other = (random >> 33) % i;
    std::swap(arrays.pixels[i - 1], arrays.pixels[other]);
    std::swap(arrays.observation_pose[i - 1], arrays.observation_pose[other]);
    std::swap(arrays.observation_point[i - 1], arrays.observation_point[other]);
  }
  return arrays;
}

void expectSame(const FastStructure& a, const FastStructure& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.point_begin, b.point_begin);
  EXPECT_EQ(a.sources, b.sources);
  EXPECT_EQ(a.view_of, b.view_of);
  EXPECT_EQ(a.seen_u, b.seen_u);
  EXPECT_EQ(a.seen_v, b.seen_v);
  EXPECT_EQ(a.row_begin, b.row_begin);
  EXPECT_EQ(a.row, b.row);
  EXPECT_EQ(a.task_begin, b.task_begin);
  EXPECT_EQ(a.left_out, b.left_out);
}

TEST(fast_structure, is_the_same_for_any_number_of_threads) {
  Arrays arrays = shuffled();
  const FastStructure one = makeFastStructure(arrays.problem(), 1);
  for (const unsigned threads : {2U, 3U, 7U}) {
    expectSame(one, makeFastStructure(arrays.problem(), threads));
  }
}

TEST(fast_structure, has_each_observation_once_and_where_it_belongs) {
  Arrays arrays = shuffled();
  arrays.points.push_back({0, 0, 5});  // nobody sees it
  const BundleProblem problem = arrays.problem();
  const FastStructure structure = makeFastStructure(problem, 2);
  ASSERT_EQ(structure.observationCount(), arrays.pixels.size());
  EXPECT_EQ(std::set<std::uint32_t>(structure.sources.begin(), structure.sources.end()).size(),
            arrays.pixels.size());
  ASSERT_EQ(structure.point_begin.size(), structure.points.size() + 1);
  EXPECT_EQ(std::count(structure.points.begin(), structure.points.end(), 30000U), 0);
  for (std::size_t p = 0; p < structure.points.size(); ++p) {
    std::uint32_t last = 0;
    for (std::size_t k = structure.point_begin[p]; k < structure.point_begin[p + 1]; ++k) {
      const std::uint32_t source = structure.sources[k];
      ASSERT_EQ(problem.observation_point[source], structure.points[p]);
      ASSERT_EQ(structure.views[structure.view_of[k]].pose, problem.observation_pose[source]);
      ASSERT_EQ(structure.seen_u[k], problem.pixels[source][0]);
      ASSERT_EQ(structure.seen_v[k], problem.pixels[source][1]);
      ASSERT_LE(last, structure.blockOf(k));  // those without a block are the last
      last = structure.blockOf(k);
    }
  }
}

TEST(fast_structure, has_rows_of_all_variables_in_ascending_order) {
  Arrays arrays = shuffled();
  const FastStructure structure = makeFastStructure(arrays.problem(), 2);
  ASSERT_EQ(structure.blocks.size(), 38U);  // two poses are fixed
  std::size_t free = 0;
  for (std::size_t k = 0; k < structure.observationCount(); ++k) {
    free += structure.blockOf(k) != kNoBlock ? 1 : 0;
  }
  EXPECT_EQ(structure.row.size(), free);
  for (std::size_t b = 0; b < structure.blocks.size(); ++b) {
    for (std::size_t i = structure.row_begin[b]; i < structure.row_begin[b + 1]; ++i) {
      ASSERT_EQ(structure.blockOf(structure.row[i]), b);
      if (i == structure.row_begin[b]) continue;
      ASSERT_LT(structure.row[i - 1], structure.row[i]);
    }
  }
}

}  // namespace
}  // namespace fast_reference
