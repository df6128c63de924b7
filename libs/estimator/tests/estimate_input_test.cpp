// What the estimate functions say of input that cannot be right.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "closed_form_helpers.h"
#include "estimate_cases.h"

using namespace estimate_test;  // NOLINT(google-build-using-namespace): these are its tests
using gslam::EstimateScoring;
using gslam::EstimateStatus;
using solver_test::kInf;
using solver_test::kNan;

namespace {

template <class Case>
class EstimateInput : public ::testing::Test {
 protected:
  EstimateInput() {
    std::mt19937 generator(1);
    typename Case::Model truth;
    pairs_ = makePairsOf<Case>(generator, {50, 0.2, 0.1}, truth);
    options_.threshold = 1;
  }

  void expectRefused(const std::string& part) {
    const auto result = Case::estimate(pairs_, options_);
    EXPECT_EQ(EstimateStatus::InvalidInput, result.status) << part;
    EXPECT_NE(std::string::npos, result.message.find(part)) << result.message;
    EXPECT_FALSE(result.ok());
    EXPECT_EQ(0u, result.inlier_count);
    for (const double element : result.covariance.values) EXPECT_EQ(0, element);
  }

  Pairs<Case::kPoint> pairs_;
  EstimateOptions options_;
};

TYPED_TEST_SUITE(EstimateInput, Cases, );

TYPED_TEST(EstimateInput, IsAccepted) {
  EXPECT_TRUE(TypeParam::estimate(this->pairs_, this->options_).ok());
}

TYPED_TEST(EstimateInput, HasSizesThatAgree) {
  this->pairs_.second.pop_back();
  this->expectRefused("second has 49 elements, expected 50");
}

TYPED_TEST(EstimateInput, IsFinite) {
  for (const double strange : {kNan, kInf, -kInf}) {
    const auto good = this->pairs_;
    this->pairs_.second[17][1] = strange;
    this->expectRefused("second[17] is not finite");
    this->pairs_.first[3][0] = strange;
    this->expectRefused("first[3] is not finite");
    this->pairs_ = good;
  }
}

TYPED_TEST(EstimateInput, IsEnough) {
  while (this->pairs_.first.size() > 2) {
    this->pairs_.first.pop_back();
    this->pairs_.second.pop_back();
  }
  auto result = TypeParam::estimate(this->pairs_, this->options_);
  EXPECT_EQ(EstimateStatus::TooFewPoints, result.status);
  EXPECT_EQ(2u, result.inliers.size());
  EXPECT_NE(std::string::npos, result.message.find("2 given")) << result.message;
  this->pairs_.first.clear();
  this->pairs_.second.clear();
  result = TypeParam::estimate(this->pairs_, this->options_);
  EXPECT_EQ(EstimateStatus::TooFewPoints, result.status);
}

TYPED_TEST(EstimateInput, HasOptionsInRange) {
  const auto with = [this](const std::function<void(EstimateOptions&)>& change,
                           const std::string& part) {
    const EstimateOptions good = this->options_;
    change(this->options_);
    this->expectRefused(part);
    this->options_ = good;
  };
  for (const double bad : {-1.0, kNan, kInf}) {
    with([bad](EstimateOptions& o) { o.threshold = bad; }, "threshold");
  }
  for (const double bad : {-1.0, 0.0, 1.0, 2.0, kNan}) {
    with([bad](EstimateOptions& o) { o.confidence = bad; }, "confidence");
  }
  with([](EstimateOptions& o) { o.max_iterations = 0; }, "max_iterations");
  for (const double bad : {-1.0, kNan}) {
    with([bad](EstimateOptions& o) { o.max_seconds = bad; }, "max_seconds");
  }
  for (const double bad : {-1.0, 0.0, kNan}) {
    with([bad](EstimateOptions& o) { o.max_false_alarms = bad; }, "max_false_alarms");
  }
  with([](EstimateOptions& o) { o.scoring = static_cast<EstimateScoring>(17); }, "scoring");
  with([](EstimateOptions& o) { o.sampling = static_cast<gslam::EstimateSampling>(17); },
       "sampling");
  std::vector<float> quality(49);
  with([&](EstimateOptions& o) { o.quality = quality; }, "quality has 49 elements");
  quality.resize(50);
  quality[20] = std::numeric_limits<float>::quiet_NaN();
  with([&](EstimateOptions& o) { o.quality = quality; }, "quality[20]");
}

TYPED_TEST(EstimateInput, HasAThresholdWhereTheUnitIsNotKnown) {
  this->options_.threshold = 0;
  if (TypeParam::kPoint == 3) {
    this->expectRefused("threshold is 0");
    this->options_.scoring = EstimateScoring::Lmeds;
  }
  const auto result = TypeParam::estimate(this->pairs_, this->options_);
  EXPECT_TRUE(result.ok()) << result.message;
  EXPECT_EQ(TypeParam::kPoint == 2, result.threshold == 3);
}

TYPED_TEST(EstimateInput, OfExtremeSizeIsNoHarm) {
  for (const double scale : {1e-150, 1e-20, 1e20, 1e150, 1e300}) {
    const auto good = this->pairs_;
    for (auto& p : this->pairs_.first) p *= scale;
    for (auto& p : this->pairs_.second) p *= scale;
    for (const double threshold : {1e-3, scale}) {
      this->options_.threshold = threshold;
      const auto result = TypeParam::estimate(this->pairs_, this->options_);
      EXPECT_EQ(50u, result.inliers.size());
      for (const double element : result.covariance.values) EXPECT_FALSE(std::isnan(element));
    }
    this->pairs_ = good;
  }
}

TEST(EstimatePlaneInput, IsChecked) {
  std::mt19937 generator(2);
  PlaneData data(generator, {50, 0.2, 0.1});
  EstimateOptions options;
  EXPECT_EQ(EstimateStatus::InvalidInput, gslam::estimatePlane(data.points, options).status);
  options.threshold = 0.5;
  EXPECT_EQ(EstimateStatus::Ok, gslam::estimatePlane(data.points, options).status);
  data.points[7][2] = kNan;
  const auto result = gslam::estimatePlane(data.points, options);
  EXPECT_EQ(EstimateStatus::InvalidInput, result.status);
  EXPECT_EQ("points[7] is not finite", result.message);
  data.points.resize(2);
  EXPECT_EQ(EstimateStatus::TooFewPoints, gslam::estimatePlane(data.points, options).status);
  const std::vector<Vec3d> same(20, Vec3d{{1, 2, 3}});
  EXPECT_EQ(EstimateStatus::Degenerate, gslam::estimatePlane(same, options).status);
}

}  // namespace
