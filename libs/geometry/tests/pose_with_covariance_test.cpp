// Covariances against numeric derivatives, and against what thousands of samples scatter.
#include <gmock/gmock.h>
#include <gslam/geometry/pose_with_covariance.h>

#include "any_group.h"

namespace {

using gslam::Mat;
using gslam::PoseWithCovariance;
using gslam::Vec;

template <class G>
class Covariances : public reference::AnyGroup<G> {
 public:
  static constexpr std::size_t kSize = G::kFreedom;
  using Step = typename G::Tangent;
  using Joint = Mat<double, 2 * kSize, 2 * kSize>;

  // The square of a random matrix, so that all directions are correlated.
  template <std::size_t N>
  Mat<double, N, N> root(double size) {
    Mat<double, N, N> m;
    for (double& value : m.values) value = gslam::randomUniform(this->generator, -size, size);
    return m;
  }
  static Joint joint(const Mat<double, kSize, kSize>& a, const Mat<double, kSize, kSize>& b) {
    Joint m{};
    m.setBlock(0, 0, a);
    m.setBlock(kSize, kSize, b);
    return m;
  }
  // The covariance of f(d_a, d_b) where (d_a, d_b) has the covariance s: J s J^T, J by differences.
  template <class F>
  static auto numeric(const F& f, const Joint& s)
      -> Mat<double, decltype(f(Step{}, Step{}))::size(), decltype(f(Step{}, Step{}))::size()> {
    constexpr std::size_t rows = decltype(f(Step{}, Step{}))::size();
    const double h = 1e-5;
    Mat<double, rows, 2 * kSize> j;
    for (std::size_t c = 0; c < 2 * kSize; ++c) {
      Vec<double, 2 * kSize> step{};
      step[c] = h;
      const auto at = [&](const Vec<double, 2 * kSize>& d) {
        return f(d.template segment<kSize>(0), d.template segment<kSize>(kSize));
      };
      const auto column = (at(step) - at(-step)) / (2 * h);
      for (std::size_t r = 0; r < rows; ++r) j(r, c) = column[r];
    }
    return j * s * j.transpose();
  }
  template <std::size_t N>
  static void expectNear(const Mat<double, N, N>& actual, const Mat<double, N, N>& expected) {
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < N * N; ++i) {
      difference = std::fmax(difference, std::fabs(actual.values[i] - expected.values[i]));
      size = std::fmax(size, std::fabs(expected.values[i]));
    }
    EXPECT_LE(difference, 1e-8 * size) << actual << "\n\n" << expected;
    EXPECT_EQ(actual, actual.transpose());
  }
};
using DoubleGroups =
    testing::Types<gslam::SO2d, gslam::SO3d, gslam::SE2d, gslam::SE3d, gslam::SIM3d>;
TYPED_TEST_SUITE(Covariances, DoubleGroups, );

TYPED_TEST(Covariances, FirstOrderOfEveryFunction) {
  using G = TypeParam;
  constexpr std::size_t n = G::kFreedom;
  for (int trial = 0; trial < 20; ++trial) {
    const G a = this->element(), b = this->element();
    const auto r = this->template root<2 * n>(1);
    const auto s = r * r.transpose();
    const auto sa = s.template block<n, n>(0, 0), sb = s.template block<n, n>(n, n);
    const auto cross = s.template block<n, n>(0, n);
    const PoseWithCovariance<G> pa(a, sa), pb(b, sb);
    const auto change = [](const G& from, const G& to) { return (from.inverse() * to).log(); };
    const auto product = [&](const typename G::Tangent& da, const typename G::Tangent& db) {
      return change(a * b, a * G::exp(da) * b * G::exp(db));
    };
    const auto relative = [&](const typename G::Tangent& da, const typename G::Tangent& db) {
      return change(a.inverse() * b, (a * G::exp(da)).inverse() * (b * G::exp(db)));
    };
    const auto back = [&](const typename G::Tangent& da, const typename G::Tangent&) {
      return change(a.inverse(), (a * G::exp(da)).inverse());
    };
    const auto left = [&](const typename G::Tangent& da, const typename G::Tangent&) {
      return (a * G::exp(da) * a.inverse()).log();
    };
    const auto apart = this->joint(sa, sb);
    this->expectNear((pa * pb).covariance(), this->numeric(product, apart));
    this->expectNear(PoseWithCovariance<G>::compose(pa, pb, cross).covariance(),
                     this->numeric(product, s));
    this->expectNear(PoseWithCovariance<G>::between(pa, pb).covariance(),
                     this->numeric(relative, apart));
    this->expectNear(PoseWithCovariance<G>::between(pa, pb, cross).covariance(),
                     this->numeric(relative, s));
    this->expectNear(pa.inverse().covariance(), this->numeric(back, s));
    this->expectNear(pa.leftCovariance(), this->numeric(left, s));
    ASSERT_TRUE((pa * pb).pose().isApprox(a * b, 0));
    ASSERT_TRUE(pa.inverse().pose().isApprox(a.inverse(), 0));
    ASSERT_TRUE(PoseWithCovariance<G>::between(pa, pb).pose().isApprox(a.inverse() * b, 0));
    this->expectNear(PoseWithCovariance<G>::fromLeftCovariance(a, pa.leftCovariance()).covariance(),
                     sa);
  }
}

TYPED_TEST(Covariances, FirstOrderOfPoints) {
  using G = TypeParam;
  constexpr std::size_t n = G::kFreedom, m = G::Point::size();
  for (int trial = 0; trial < 20; ++trial) {
    const G a = this->element();
    const typename G::Point p = gslam::randomNormal<double, m>(this->generator);
    const auto r = this->template root<n>(1);
    const auto q = this->template root<m>(1);
    const auto sa = r * r.transpose();
    const auto sp = q * q.transpose();
    const PoseWithCovariance<G> pose(a, sa);
    const auto moved = [&](const typename G::Tangent& da, const typename G::Tangent&) {
      return a * G::exp(da) * p;
    };
    const auto of_pose = this->numeric(moved, this->joint(sa, sa));
    this->expectNear((pose * p).covariance, of_pose);
    EXPECT_EQ((pose * p).point, a * p);
    const auto linear = a.matrix().template block<m, m>(0, 0);
    const auto both = pose * gslam::PointWithCovariance<double, m>{p, sp};
    this->expectNear(both.covariance, of_pose + linear * sp * linear.transpose());
  }
}

// A sample covariance S of N normal samples has the deviation sqrt((Sii Sjj + Sij^2) / N); five of
// them are allowed. The perturbations are so small that higher orders cannot be seen.
TYPED_TEST(Covariances, SamplesScatterAsPredicted) {
  using G = TypeParam;
  constexpr std::size_t n = G::kFreedom;
  const int count = 20000;
  const G a = this->element(), b = this->element();
  const auto r = this->template root<2 * n>(1e-3);
  const auto s = r * r.transpose();
  const PoseWithCovariance<G> pa(a, s.template block<n, n>(0, 0));
  const PoseWithCovariance<G> pb(b, s.template block<n, n>(n, n));
  const auto cross = s.template block<n, n>(0, n);
  const auto product = PoseWithCovariance<G>::compose(pa, pb, cross);
  const auto relative = PoseWithCovariance<G>::between(pa, pb, cross);
  Mat<double, n, n> of_product{}, of_relative{};
  for (int i = 0; i < count; ++i) {
    const auto d = r * gslam::randomNormal<double, 2 * n>(this->generator);
    const G sample_a = a * G::exp(d.template segment<n>(0));
    const G sample_b = b * G::exp(d.template segment<n>(n));
    const auto x = (product.pose().inverse() * sample_a * sample_b).log();
    const auto y = (relative.pose().inverse() * sample_a.inverse() * sample_b).log();
    of_product += (1.0 / count) * gslam::outer(x, x);
    of_relative += (1.0 / count) * gslam::outer(y, y);
  }
  const auto expect_scatter = [&](const Mat<double, n, n>& sampled,
                                  const Mat<double, n, n>& expected) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double variance =
            (expected(i, i) * expected(j, j) + expected(i, j) * expected(i, j)) / count;
        EXPECT_NEAR(sampled(i, j), expected(i, j), 5 * std::sqrt(variance)) << i << j;
      }
    }
  };
  expect_scatter(of_product, product.covariance());
  expect_scatter(of_relative, relative.covariance());
}

using gslam::SE3d;
using gslam::SO3d;
using Matrix6 = Mat<double, 6, 6>;

// Of a pose turned by a quarter about z: forward is y in the world. Turning the body about its own
// z does not move its position, in the axes of the world; as a perturbation on the left it does.
TEST(CovarianceInWorldAxes, AsInRos) {
  const SE3d pose(SO3d::exp({0, 0, std::acos(-1.0) / 2}), {10, 0, 0});
  Matrix6 s{};
  s(0, 0) = 4;     // along the body's x
  s(5, 5) = 0.01;  // about the body's z
  const PoseWithCovariance<SE3d> p(pose, s);
  const Matrix6 world = p.covarianceInWorldAxes();
  EXPECT_NEAR(world(0, 0), 0, 1e-15);
  EXPECT_NEAR(world(1, 1), 4, 1e-14);
  EXPECT_NEAR(world(5, 5), 0.01, 1e-15);
  EXPECT_NEAR(p.leftCovariance()(1, 1), 4 + 0.01 * 100, 1e-13);
  const auto again = PoseWithCovariance<SE3d>::fromCovarianceInWorldAxes(pose, world);
  for (std::size_t i = 0; i < 36; ++i) {
    EXPECT_NEAR(again.covariance().values[i], s.values[i], 1e-14);
  }
}

// Two poses with the same error are apart for sure.
TEST(CovarianceOfBetween, CommonErrorsCancel) {
  const Matrix6 s = Matrix6::identity();
  const SE3d pose(SO3d::exp({1, 0, 0}), {1, 2, 3});
  const PoseWithCovariance<SE3d> p(pose, s);
  const Matrix6 apart = PoseWithCovariance<SE3d>::between(p, p, s).covariance();
  for (const double value : apart.values) EXPECT_NEAR(value, 0, 1e-14);
  EXPECT_NEAR(PoseWithCovariance<SE3d>::between(p, p).covariance()(0, 0), 2, 1e-14);
  EXPECT_EQ(PoseWithCovariance<SE3d>(pose).covariance(), Matrix6{});
}

TEST(CovarianceInput, WhatIsRefused) {
  using testing::HasSubstr;
  const auto refusal = [](std::size_t r, std::size_t c, double value) -> std::string {
    Matrix6 s = Matrix6::identity();
    s(r, c) = value;
    try {
      (void)PoseWithCovariance<SE3d>(SE3d(), s);
      (void)PoseWithCovariance<SE3d>::fromLeftCovariance(SE3d(), s);
    } catch (const gslam::ArgumentError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(refusal(1, 2, std::numeric_limits<double>::quiet_NaN()),
              HasSubstr("covariance has the element nan in row 1, column 2"));
  EXPECT_THAT(refusal(3, 3, -1), HasSubstr("element -1 in row 3, column 3, expected a variance"));
  EXPECT_THAT(refusal(0, 1, 0.5),
              HasSubstr("element 0.5 in row 0, column 1, expected a symmetric"));
  EXPECT_THAT(refusal(4, 5, 2),
              HasSubstr("element 2 in row 4, column 5, more than the two variances"));
  EXPECT_EQ(refusal(3, 3, 0), "taken");
}

TEST(CovarianceInput, NearlySymmetricOnesAreMadeSymmetric) {
  gslam::Mat3d m = gslam::Mat3d::identity();
  m(0, 1) = 5e-4;
  const PoseWithCovariance<gslam::SO3d> pose(gslam::SO3d(), m);
  EXPECT_EQ(pose.covariance()(0, 1), 2.5e-4);
  EXPECT_EQ(pose.covariance(), pose.covariance().transpose());
  EXPECT_EQ((pose * pose).covariance(), (pose * pose).covariance().transpose());
}

// Each two of the three may be so correlated, but not all at once: the least eigenvalue is -0.8.
TEST(CovarianceInput, IndefiniteOnesAreRefused) {
  const gslam::Mat3d m = {1, 0.9, -0.9, 0.9, 1, 0.9, -0.9, 0.9, 1};
  EXPECT_THROW(PoseWithCovariance<gslam::SO3d>(gslam::SO3d(), m), gslam::ArgumentError);
  const gslam::Mat3d singular = {1, 1, 0, 1, 1, 0, 0, 0, 0};
  EXPECT_NO_THROW(PoseWithCovariance<gslam::SO3d>(gslam::SO3d(), singular));
}

}  // namespace
