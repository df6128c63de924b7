#include <gmock/gmock.h>
#include <gslam/optimizer/summary.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace {

using gslam::LossKind;
using gslam::OptimizerStatus;
using gslam::OptimizerSummary;
using testing::HasSubstr;
using testing::Not;

OptimizerSummary someSummary() {
  OptimizerSummary summary;
  summary.status = OptimizerStatus::Converged;
  summary.message = "A step lowered the cost by less than function_tolerance.";
  summary.backend = "pba";
  summary.linear_solver = "explicit Schur, float, PCG block Jacobi";
  summary.is_usable = true;
  summary.initial_cost = 850912.5;
  summary.final_cost = 13345.25;
  summary.residuals = 63686;
  summary.parameters = 23769;
  summary.observations = 31843;
  summary.inliers = 31800;
  for (std::size_t i = 0; i < 3; ++i) {
    gslam::OptimizerIteration one;
    one.number = i;
    one.cost = 850912.5 / static_cast<double>(i + 1);
    one.is_successful = i != 2;
    one.linear_iterations = 11;
    one.seconds = 0.01 * static_cast<double>(i);
    summary.iterations.push_back(one);
  }
  summary.times = {0.01, 0.02, 0.05, 0.01, 0.1};
  return summary;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(summary, names_every_status_and_loss) {
  EXPECT_STREQ(nameOf(OptimizerStatus::Converged), "Converged");
  EXPECT_STREQ(nameOf(OptimizerStatus::MaxIterations), "MaxIterations");
  EXPECT_STREQ(nameOf(OptimizerStatus::MaxTime), "MaxTime");
  EXPECT_STREQ(nameOf(OptimizerStatus::Cancelled), "Cancelled");
  EXPECT_STREQ(nameOf(OptimizerStatus::Stalled), "Stalled");
  EXPECT_STREQ(nameOf(OptimizerStatus::Failed), "Failed");
  EXPECT_STREQ(nameOf(LossKind::Squared), "Squared");
  EXPECT_STREQ(nameOf(LossKind::Huber), "Huber");
  EXPECT_STREQ(nameOf(LossKind::Cauchy), "Cauchy");
  EXPECT_STREQ(nameOf(LossKind::Tukey), "Tukey");
  EXPECT_STREQ(nameOf(LossKind::GemanMcClure), "GemanMcClure");
}

TEST(summary, is_told_in_a_line) {
  OptimizerSummary summary = someSummary();
  EXPECT_EQ(briefReport(summary),
            "pba: Converged after 2 iterations, cost 850912 -> 13345.2, 100 ms");
  summary.is_usable = false;
  summary.warnings = {"points[3] is seen once"};
  EXPECT_THAT(briefReport(summary), HasSubstr("Converged, not usable after"));
  EXPECT_THAT(briefReport(summary), HasSubstr(", 1 warning"));
  EXPECT_EQ(briefReport(OptimizerSummary()),
            "Failed, not usable after 0 iterations, cost 0 -> 0, 0 us");
}

TEST(summary, is_told_on_a_page) {
  OptimizerSummary summary = someSummary();
  summary.left_out = 5;
  summary.warnings = {"points[3] is seen once", "cameras[1] has no observations"};
  const std::string page = fullReport(summary);
  for (const char* part :
       {"Converged\n", "A step lowered", "pba", "explicit Schur, float", "23769", "63686",
        "31843 used, 5 left out, 31800 inliers", "8.509125e+05 -> 1.334525e+04, 98.43 % less",
        "taken back", "setup", "100 ms     100.0 %", "50.0 %", "warning: points[3] is seen once\n",
        "warning: cameras[1] has no observations\n"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
  EXPECT_THAT(page, Not(HasSubstr("\n\n\n")));
  for (const std::string& line : linesOf(page)) EXPECT_LE(line.size(), 100u) << line;
}

TEST(summary, keeps_the_columns_of_its_table_in_line) {
  OptimizerSummary summary = someSummary();
  summary.iterations[1].cost_change = -1.5e300;
  summary.iterations[1].gradient_max = 1e-300;
  summary.iterations[1].seconds = 12345.678;
  std::vector<std::size_t> ends;
  for (const std::string& line : linesOf(fullReport(summary))) {
    const std::size_t end = line.find(" s", 60);
    if (end != std::string::npos && line.find("iter") == std::string::npos) ends.push_back(end);
  }
  ASSERT_EQ(ends.size(), 3u);
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_EQ(ends[0], ends[2]);
}

TEST(summary, is_told_without_iterations) {
  EXPECT_THAT(fullReport(OptimizerSummary()), HasSubstr("Failed, not usable"));
  EXPECT_THAT(fullReport(OptimizerSummary()), Not(HasSubstr("nan")));
}

TEST(summary, says_where_there_is_no_cost) {
  OptimizerSummary summary;
  for (const double none :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    summary.initial_cost = summary.final_cost = none;
    EXPECT_THAT(fullReport(summary), HasSubstr("cost           no value -> no value\n"));
    EXPECT_THAT(briefReport(summary), HasSubstr("cost no value -> no value,"));
    for (const std::string& text : {fullReport(summary), briefReport(summary)}) {
      EXPECT_THAT(text, Not(HasSubstr("nan")));
      EXPECT_THAT(text, Not(HasSubstr("inf")));
    }
  }
}

TEST(summary, tells_no_part_of_a_cost_that_is_not_positive) {
  OptimizerSummary summary = someSummary();
  summary.initial_cost = -1;  // a window prior may have such a cost
  summary.final_cost = -3;
  EXPECT_THAT(fullReport(summary), HasSubstr("cost           -1.000000e+00 -> -3.000000e+00\n"));
  summary.initial_cost = 2;
  EXPECT_THAT(fullReport(summary), HasSubstr("2.000000e+00 -> -3.000000e+00, 250.00 % less\n"));
}

}  // namespace
