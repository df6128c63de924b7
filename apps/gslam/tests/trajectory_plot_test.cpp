// What the command cannot be given, as its readers and the evaluation refuse it before.
#include "trajectory_plot.h"

#include <gslam/base/error.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <opencv2/imgcodecs.hpp>

namespace app {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PlottedPose pose(std::int64_t stamp, double x, double y, double z, double error = 0) {
  return {stamp, {{x, y, z}}, error};
}

// A way along two axes.
TrajectoryPlot square() {
  TrajectoryPlot plot;
  plot.truth = {pose(0, 0, 0, 7), pose(1, 4, 0, 7), pose(2, 4, 3, 7), pose(3, 0, 3, 7)};
  return plot;
}

cv::Mat drawn(const TrajectoryPlot& plot) {
  const std::string path = testing::TempDir() + "trajectory_plot_test.png";
  writePlot(plot, path);
  const cv::Mat picture = cv::imread(path);
  std::remove(path.c_str());
  return picture;
}

TEST(TrajectoryPlot, SeesTheTwoLongestAxesOfTheTruth) {
  TrajectoryPlot plot = square();
  plot.estimate = {pose(0, 0, 0, -100), pose(1, 0, 0, 100), pose(2, -1, 5, 0)};
  const PlotView view = viewOf(plot);
  EXPECT_EQ(view.right, 0);
  EXPECT_EQ(view.up, 1);
  EXPECT_EQ(view.left, -1);  // all of the estimate is seen
  EXPECT_EQ(view.width, 5);
  EXPECT_EQ(view.bottom, 0);
  EXPECT_EQ(view.height, 5);
  plot.truth.clear();
  EXPECT_EQ(viewOf(plot).right, 1);
  EXPECT_EQ(viewOf(plot).up, 2);
}

TEST(TrajectoryPlot, LeavesOutWhatIsNotFinite) {
  TrajectoryPlot plot = square();
  plot.truth.insert(plot.truth.begin() + 2, pose(1, kNaN, 1, 1));
  plot.truth.push_back(pose(4, 0, std::numeric_limits<double>::infinity(), 0));
  plot.truth.push_back(pose(5, 1e300, 0, 0));
  const PlotView view = viewOf(plot);
  EXPECT_EQ(view.width, 4);
  EXPECT_EQ(view.height, 3);
  const std::vector<PlotStroke> strokes = strokesOf(plot.truth, view, 0);
  ASSERT_EQ(strokes.size(), 2U);  // a gap where one was
  EXPECT_EQ(strokes[0].size(), 2U);
  EXPECT_EQ(strokes[1].size(), 2U);
}

TEST(TrajectoryPlot, EndsALineWhereNothingIsTracked) {
  std::vector<PlottedPose> poses;
  for (int i = 0; i < 20; ++i) poses.push_back(pose(i < 10 ? i : i + 6, i, 0, 0));
  const PlotView view;
  EXPECT_EQ(strokesOf(poses, view, 0).size(), 2U);  // 7 steps
  EXPECT_EQ(strokesOf(poses, view, 7).size(), 1U);
  EXPECT_EQ(strokesOf(poses, view, 6).size(), 2U);
  EXPECT_TRUE(strokesOf({}, view, 0).empty());
}

TEST(TrajectoryPlot, StandsEmptyAndSinglePoses) {
  TrajectoryPlot plot;
  EXPECT_TRUE(viewOf(plot).is_empty);
  EXPECT_NE(plotText(plot, true).find("no poses"), std::string::npos);
  const cv::Mat empty = drawn(plot);
  EXPECT_FALSE(empty.empty());
  plot.truth = {pose(0, kNaN, kNaN, kNaN)};
  EXPECT_NE(plotText(plot, false).find("no poses"), std::string::npos);
  EXPECT_FALSE(drawn(plot).empty());
  plot.truth = {pose(0, 1e9, 2, 3)};
  EXPECT_GT(viewOf(plot).width, 0);
  EXPECT_NE(plotText(plot, false).find('S'), std::string::npos);
  EXPECT_FALSE(drawn(plot).empty());
  plot.estimate = {pose(0, 1e9, 2, 3, kNaN)};  // an error that is not known
  EXPECT_FALSE(drawn(plot).empty());
}

// Left of the scale of errors, which has all colours.
bool hasBlue(const cv::Mat& picture) {
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols - 250; ++x) {
      const cv::Vec3b colour = picture.at<cv::Vec3b>(y, x);
      if (colour[0] > colour[2] + 100) return true;
    }
  }
  return false;
}

TEST(TrajectoryPlot, HasTheColourOfTheError) {
  TrajectoryPlot plot = square();
  EXPECT_FALSE(hasBlue(drawn(plot)));
  plot.estimate = plot.truth;
  for (PlottedPose& one : plot.estimate) one.error = 0.1;
  EXPECT_FALSE(hasBlue(drawn(plot)));
  plot.estimate[0].error = plot.estimate[1].error = 0.001;
  EXPECT_TRUE(hasBlue(drawn(plot)));
}

TEST(TrajectoryPlot, HasEqualScales) {
  // Letters are twice as high as wide.
  const std::string text = plotText(square(), false);
  const std::size_t columns = text.find('\n') - 2;
  const auto rows = std::count(text.begin(), text.end(), '\n') - 3;
  EXPECT_EQ(rows, 20);
  EXPECT_NEAR(double(columns) / double(2 * rows), 4.0 / 3, 0.07);
}

TEST(TrajectoryPlot, WritesNumbersAsShortAsTheyMayBe) {
  EXPECT_EQ(numberText(-1e-17, 0.5), "0.0");
  EXPECT_EQ(numberText(12, 2), "12");
  EXPECT_EQ(numberText(0.25, 0.05), "0.25");
  EXPECT_EQ(roundStep(0.11), 0.2);
  EXPECT_EQ(roundStep(100), 100);
  EXPECT_EQ(roundStep(6), 10);
  EXPECT_EQ(lengthText(0.01234), "1.23 cm");
  EXPECT_EQ(lengthText(0.00012), "0.120 mm");
  EXPECT_EQ(lengthText(12.34), "12.3 m");
  EXPECT_EQ(lengthText(1234), "1.23 km");
  EXPECT_EQ(lengthText(0), "0.00 mm");
}

}  // namespace
}  // namespace app
