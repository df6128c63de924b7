// Sets of matches with known maps, for the estimate functions on points.
#ifndef GSLAM_ESTIMATOR_TESTS_ESTIMATE_CASES_H
#define GSLAM_ESTIMATOR_TESTS_ESTIMATE_CASES_H

#include <gslam/estimator/estimate_affine_2d.h>
#include <gslam/estimator/estimate_affine_3d.h>
#include <gslam/estimator/estimate_homography.h>
#include <gslam/estimator/estimate_plane.h>
#include <gslam/estimator/estimate_rigid_3d.h>
#include <gslam/estimator/estimate_similarity_3d.h>
#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace estimate_test {

using gslam::EstimateOptions;
using gslam::Mat;
using gslam::Mat3d;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::Vec;
using gslam::Vec2d;
using gslam::Vec3d;
using gslam::Vec4d;

/// How a set is made.
struct Recipe {
  std::size_t count = 200;
  double outliers = 0.5;
  double noise = 0.5;
};

template <std::size_t N>
Vec<double, N> randomPoint(std::mt19937& generator, double low, double high) {
  Vec<double, N> p;
  for (std::size_t k = 0; k < N; ++k) p[k] = gslam::randomUniform(generator, low, high);
  return p;
}

template <std::size_t N>
struct Pairs {
  std::vector<Vec<double, N>> first, second;
  std::vector<std::uint8_t> is_inlier;
};

// Each case has: Model truth(generator), apply(model, p), estimate(pairs, options), kPoint,
// difference of two models in the unit of points, dof.

/// Pairs x, map(x) + noise, or with a second point anywhere in the box of all second ones.
template <std::size_t N, class Map>
Pairs<N> makePairs(std::mt19937& generator, const Recipe& recipe, const Map& map) {
  Pairs<N> pairs;
  for (std::size_t i = 0; i < recipe.count; ++i) {
    const Vec<double, N> p = randomPoint<N>(generator, 0, 500);
    pairs.first.push_back(p);
    pairs.second.push_back(map(p));
    pairs.is_inlier.push_back(1);
  }
  Vec<double, N> low = pairs.second[0], high = low;
  for (const Vec<double, N>& p : pairs.second) {
    for (std::size_t k = 0; k < N; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  for (std::size_t i = 0; i < recipe.count; ++i) {
    const bool is_outlier = gslam::randomUniform(generator, 0.0, 1.0) < recipe.outliers;
    if (is_outlier) {
      for (std::size_t k = 0; k < N; ++k) {
        pairs.second[i][k] = gslam::randomUniform(generator, low[k], high[k]);
      }
      pairs.is_inlier[i] = 0;
    } else {
      pairs.second[i] += recipe.noise * gslam::randomNormal<double, N>(generator);
    }
  }
  return pairs;
}

struct HomographyCase {
  static constexpr std::size_t kPoint = 2;
  using Model = Mat3d;
  using Result = gslam::HomographyEstimate;
  static Model truth(std::mt19937& g) {
    const auto u = [&g](double reach) { return gslam::randomUniform(g, -reach, reach); };
    return {{1 + u(0.2), u(0.2), u(50), u(0.2), 1 + u(0.2), u(50), u(4e-4), u(4e-4), 1}};
  }
  static Vec2d apply(const Model& h, const Vec2d& p) {
    const Vec3d q = h * Vec3d{{p[0], p[1], 1}};
    return {{q[0] / q[2], q[1] / q[2]}};
  }
  static Result estimate(const Pairs<2>& pairs, const EstimateOptions& options) {
    return gslam::estimateHomography(pairs.first, pairs.second, options);
  }
  /// d apply / d elements.
  static Mat<double, 2, 9> jacobian(const Model& h, const Vec2d& p) {
    const Vec3d q = h * Vec3d{{p[0], p[1], 1}};
    const double x[3] = {p[0] / q[2], p[1] / q[2], 1 / q[2]};
    Mat<double, 2, 9> j{};
    for (std::size_t k = 0; k < 3; ++k) {
      j(0, k) = j(1, 3 + k) = x[k];
      j(0, 6 + k) = -x[k] * q[0] / q[2];
      j(1, 6 + k) = -x[k] * q[1] / q[2];
    }
    return j;
  }
};

template <std::size_t N>
struct AffineCase {
  static constexpr std::size_t kPoint = N;
  using Model = Mat<double, N, N + 1>;
  using Result = gslam::Estimate<Model, N*(N + 1)>;
  static Model truth(std::mt19937& g) {
    Model a;
    for (double& value : a.values) value = gslam::randomUniform(g, -0.4, 0.4);
    for (std::size_t k = 0; k < N; ++k) {
      a(k, k) += 1;
      a(k, N) *= 200;
    }
    return a;
  }
  static Vec<double, N> apply(const Model& a, const Vec<double, N>& p) {
    Vec<double, N + 1> homogeneous;
    homogeneous.setSegment(0, p);
    homogeneous[N] = 1;
    return a * homogeneous;
  }
  static Mat<double, N, N*(N + 1)> jacobian(const Model&, const Vec<double, N>& p) {
    Mat<double, N, N*(N + 1)> j{};
    for (std::size_t r = 0; r < N; ++r) {
      for (std::size_t k = 0; k <= N; ++k) j(r, r * (N + 1) + k) = k < N ? p[k] : 1;
    }
    return j;
  }
};

struct Affine2DCase : AffineCase<2> {
  static Result estimate(const Pairs<2>& pairs, const EstimateOptions& options) {
    return gslam::estimateAffine2D(pairs.first, pairs.second, options);
  }
};

struct Affine3DCase : AffineCase<3> {
  static Result estimate(const Pairs<3>& pairs, const EstimateOptions& options) {
    return gslam::estimateAffine3D(pairs.first, pairs.second, options);
  }
};

struct RigidCase {
  static constexpr std::size_t kPoint = 3;
  using Model = SE3d;
  using Result = gslam::Rigid3DEstimate;
  static Model truth(std::mt19937& g) { return gslam::randomOf<SE3d>(g, 300.0); }
  static Vec3d apply(const Model& t, const Vec3d& p) { return t * p; }
  static Result estimate(const Pairs<3>& pairs, const EstimateOptions& options) {
    return gslam::estimateRigid3D(pairs.first, pairs.second, options);
  }
  static Mat<double, 3, 6> jacobian(const Model& t, const Vec3d& p) { return t.actionJacobian(p); }
};

struct SimilarityCase {
  static constexpr std::size_t kPoint = 3;
  using Model = SIM3d;
  using Result = gslam::Similarity3DEstimate;
  static Model truth(std::mt19937& g) { return gslam::randomOf<SIM3d>(g, 300.0, 3.0); }
  static Vec3d apply(const Model& s, const Vec3d& p) { return s * p; }
  static Result estimate(const Pairs<3>& pairs, const EstimateOptions& options) {
    return gslam::estimateSimilarity3D(pairs.first, pairs.second, options);
  }
  static Mat<double, 3, 7> jacobian(const Model& s, const Vec3d& p) { return s.actionJacobian(p); }
};

/// Pairs of a case with its own random truth.
template <class Case>
Pairs<Case::kPoint> makePairsOf(std::mt19937& generator, const Recipe& recipe,
                                typename Case::Model& truth) {
  truth = Case::truth(generator);
  return makePairs<Case::kPoint>(generator, recipe, [&truth](const Vec<double, Case::kPoint>& p) {
    return Case::apply(truth, p);
  });
}

/// How far two maps are apart, at most, at the corners and the centre of where points are.
template <class Case>
double distanceOf(const typename Case::Model& a, const typename Case::Model& b) {
  double largest = 0;
  for (unsigned corner = 0; corner <= 1u << Case::kPoint; ++corner) {
    Vec<double, Case::kPoint> p;
    for (std::size_t k = 0; k < Case::kPoint; ++k) {
      p[k] = corner == 1u << Case::kPoint ? 250 : ((corner >> k & 1u) != 0 ? 500 : 0);
    }
    largest = std::max(largest, (Case::apply(a, p) - Case::apply(b, p)).norm());
  }
  return largest;
}

/// Points of which some lie near a plane.
struct PlaneData {
  Vec4d plane;
  std::vector<Vec3d> points;
  std::vector<std::uint8_t> is_inlier;

  PlaneData(std::mt19937& generator, const Recipe& recipe) {
    const Vec3d n = gslam::randomDirection<double>(generator);
    const Vec3d middle = {{250, 250, 250}};
    plane = {{n[0], n[1], n[2], -n.dot(middle)}};
    for (std::size_t i = 0; i < recipe.count; ++i) {
      Vec3d p = randomPoint<3>(generator, 0, 500);
      const bool is_outlier = gslam::randomUniform(generator, 0.0, 1.0) < recipe.outliers;
      if (!is_outlier) {
        const double off = recipe.noise * gslam::randomNormal<double, 1>(generator)[0];
        p += (off - n.dot(p) - plane[3]) * n;
      }
      points.push_back(p);
      is_inlier.push_back(is_outlier ? 0 : 1);
    }
    if (plane[3] < 0) plane = -1.0 * plane;
  }
};

using Cases =
    ::testing::Types<HomographyCase, Affine2DCase, Affine3DCase, RigidCase, SimilarityCase>;

}  // namespace estimate_test

#endif  // GSLAM_ESTIMATOR_TESTS_ESTIMATE_CASES_H
