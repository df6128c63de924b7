#include <gmock/gmock.h>
#include <gslam/optimizer.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "backend_contract/scenes.h"
#include "not_finite.h"

namespace {

using gslam::OptimizerOptions;
using testing::HasSubstr;
using testing::StartsWith;

// What the facade says of options, whatever the problem.
std::string complaintAbout(const std::function<void(OptimizerOptions&)>& change) {
  OptimizerOptions options;
  options.backend = "none of this name";
  change(options);
  return backend_contract::complaintOf([&] { optimizePose({}, gslam::SE3d(), options); });
}

using not_finite::kInfinity;
using not_finite::kNan;

TEST(check_options, names_the_option_and_what_was_expected) {
  EXPECT_EQ(complaintAbout([](OptimizerOptions& o) { o.max_seconds = -1; }),
            "options.max_seconds is -1, expected 0 or more, and finite");
  EXPECT_EQ(complaintAbout([](OptimizerOptions& o) { o.loss.scale = 0; }),
            "options.loss.scale is 0, expected above 0, and finite");
  EXPECT_EQ(complaintAbout([](OptimizerOptions& o) { o.max_linear_iterations = 0; }),
            "options.max_linear_iterations is 0, expected 1 or more");
  EXPECT_EQ(complaintAbout([](OptimizerOptions& o) { o.linear_tolerance = 1; }),
            "options.linear_tolerance is 1, expected 0 or more and below 1");
}

TEST(check_options, refuses_what_is_not_finite_or_negative) {
  const std::vector<std::pair<std::string, double OptimizerOptions::*>> fields = {
      {"options.function_tolerance", &OptimizerOptions::function_tolerance},
      {"options.gradient_tolerance", &OptimizerOptions::gradient_tolerance},
      {"options.parameter_tolerance", &OptimizerOptions::parameter_tolerance},
      {"options.max_seconds", &OptimizerOptions::max_seconds},
      {"options.initial_damping", &OptimizerOptions::initial_damping},
      {"options.linear_tolerance", &OptimizerOptions::linear_tolerance}};
  for (const auto& field : fields) {
    for (const double value : {-1e-300, kNan, kInfinity, -kInfinity}) {
      EXPECT_THAT(complaintAbout([&](OptimizerOptions& o) { o.*field.second = value; }),
                  StartsWith(field.first + " is "));
    }
    EXPECT_THAT(complaintAbout([&](OptimizerOptions& o) { o.*field.second = 0; }),
                StartsWith("options.backend"));
  }
  for (const double value : {-1.0, kNan, kInfinity}) {
    EXPECT_THAT(complaintAbout([&](OptimizerOptions& o) { o.loss.scale = value; }),
                StartsWith("options.loss.scale is "));
  }
}

TEST(check_options, refuses_numbers_that_are_no_enumerators) {
  EXPECT_THAT(complaintAbout([](OptimizerOptions& o) { o.loss.kind = gslam::LossKind(5); }),
              StartsWith("options.loss is 5"));
  EXPECT_THAT(
      complaintAbout([](OptimizerOptions& o) { o.linear_solver = gslam::LinearSolverKind(4); }),
      StartsWith("options.linear_solver is 4"));
  EXPECT_THAT(
      complaintAbout([](OptimizerOptions& o) { o.preconditioner = gslam::PreconditionerKind(-1); }),
      StartsWith("options.preconditioner is -1"));
  EXPECT_THAT(complaintAbout([](OptimizerOptions& o) { o.schur = gslam::SchurKind(3); }),
              StartsWith("options.schur is 3"));
  EXPECT_THAT(complaintAbout([](OptimizerOptions& o) { o.precision = gslam::PrecisionKind(3); }),
              StartsWith("options.precision is 3"));
}

}  // namespace
