// OpenCV's calib3d.
#include <cstddef>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "measure.h"

namespace {

using Points2 = std::vector<cv::Point2d>;
using Points3 = std::vector<cv::Point3d>;

const cv::Matx33d kNoCamera = cv::Matx33d::eye();

Numbers numbersOf(const cv::Mat& any) {
  const cv::Mat_<double> m(any);
  return Numbers(m.begin(), m.end());
}

Numbers poseOf(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  cv::Mat rotation;
  cv::Rodrigues(rotation_vector, rotation);
  Numbers numbers = numbersOf(rotation);
  for (const double number : numbersOf(translation)) numbers.push_back(number);
  return numbers;
}

struct Input {
  Points2 first, second;  // in the plane z = 1
  std::vector<cv::Point2f> first_float, second_float;
  Points3 points, first_points, second_points;
  cv::Matx34d first_projection, second_projection;
};

Points2 inPlane(const std::vector<gslam::Vec3d>& bearings) {
  Points2 result;
  for (const auto& v : bearings) result.emplace_back(v[0] / v[2], v[1] / v[2]);
  return result;
}

Points3 listOf(const std::vector<gslam::Vec3d>& points) {
  Points3 result;
  for (const auto& p : points) result.emplace_back(p[0], p[1], p[2]);
  return result;
}

Input inputOf(const Instance& instance) {
  Input in;
  in.first = inPlane(instance.first);
  in.second = inPlane(instance.second);
  in.first_float.assign(in.first.begin(), in.first.end());
  in.second_float.assign(in.second.begin(), in.second.end());
  in.points = listOf(instance.points);
  in.first_points = listOf(instance.first);
  in.second_points = listOf(instance.second);
  in.first_projection = cv::Matx34d(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);
  const gslam::Mat3d r = instance.pose.rotation().matrix();
  for (int i = 0; i < 3; ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (int j = 0; j < 3; ++j) in.second_projection(i, j) = r(row, static_cast<std::size_t>(j));
    in.second_projection(i, 3) = instance.pose.translation()[row];
  }
  return in;
}

// Matrices that stand below each other, as OpenCV gives several.
struct GivesMatrices {
  using Output = cv::Mat;
  static Input prepare(const Instance& instance) { return inputOf(instance); }
  static Models models(const cv::Mat& stacked) {
    Models models;
    for (int r = 0; r + 3 <= stacked.rows; r += 3) {
      models.push_back(numbersOf(stacked.rowRange(r, r + 3)));
    }
    return models;
  }
};
struct EightPoints : GivesMatrices {
  static void solve(const Input& in, cv::Mat& out) {
    out = cv::findFundamentalMat(in.first, in.second, cv::FM_8POINT);
  }
};
struct SevenPoints : GivesMatrices {
  static void solve(const Input& in, cv::Mat& out) {
    out = cv::findFundamentalMat(in.first, in.second, cv::FM_7POINT);
  }
};
struct FivePoints : GivesMatrices {
  static void solve(const Input& in, cv::Mat& out) {
    out = cv::findEssentialMat(in.first, in.second, kNoCamera, cv::RANSAC, 0.99, 1e-3);
  }
};
struct FourPoints : GivesMatrices {
  static void solve(const Input& in, cv::Mat& out) {
    out = cv::getPerspectiveTransform(in.first_float, in.second_float);
  }
};
const bool kMatrices[] = {
    addSolver<EightPoints>("f8", "opencv", of<essentialInstances, 8>, scaleFreeDistance),
    addSolver<SevenPoints>("f7", "opencv", of<essentialInstances, 7>, scaleFreeDistance),
    addSolver<FivePoints>("e5", "opencv", of<essentialInstances, 5>, scaleFreeDistance),
    addSolver<FourPoints>("h4", "opencv", homographyInstances, scaleFreeDistance)};

struct Vectors {
  std::vector<cv::Mat> rotations, translations;
};
struct GivesPoses {
  using Output = Vectors;
  static Input prepare(const Instance& instance) { return inputOf(instance); }
  static Models models(const Vectors& vectors) {
    Models models;
    for (std::size_t i = 0; i < vectors.rotations.size(); ++i) {
      models.push_back(poseOf(vectors.rotations[i], vectors.translations[i]));
    }
    return models;
  }
};
template <int kMethod>
struct P3p : GivesPoses {
  static void solve(const Input& in, Vectors& out) {
    out = Vectors();
    cv::solveP3P(in.points, in.second, kNoCamera, cv::noArray(), out.rotations, out.translations,
                 kMethod);
  }
};
template <int kMethod>
struct Pnp : GivesPoses {
  static void solve(const Input& in, Vectors& out) {
    out.rotations.assign(1, cv::Mat());
    out.translations.assign(1, cv::Mat());
    cv::solvePnP(in.points, in.second, kNoCamera, cv::noArray(), out.rotations[0],
                 out.translations[0], false, kMethod);
  }
};
using Ap3p = P3p<cv::SOLVEPNP_AP3P>;
using Gao = P3p<cv::SOLVEPNP_P3P>;
using Epnp = Pnp<cv::SOLVEPNP_EPNP>;
using Sqpnp = Pnp<cv::SOLVEPNP_SQPNP>;
const bool kPoses[] = {
    addSolver<Ap3p>("p3p", "opencv_ap3p", of<absoluteInstances, 3>, poseDistance),
    addSolver<Gao>("p3p_gao", "opencv", of<absoluteInstances, 3>, poseDistance),
    addSolver<Ap3p>("p3p_collinear", "opencv_ap3p", collinearInstances, poseDistance),
    addSolver<Epnp>("epnp_6", "opencv", of<absoluteInstances, 6>, poseDistance),
    addSolver<Epnp>("epnp_6_planar", "opencv", of<planarInstances, 6>, poseDistance),
    addSolver<Sqpnp>("sqpnp_6", "opencv", of<absoluteInstances, 6>, poseDistance),
    addSolver<Sqpnp>("sqpnp_6_planar", "opencv", of<planarInstances, 6>, poseDistance)};

struct Triangulation {
  using Output = cv::Mat;
  static Input prepare(const Instance& instance) { return inputOf(instance); }
  static void solve(const Input& in, cv::Mat& out) {
    cv::triangulatePoints(in.first_projection, in.second_projection, in.first, in.second, out);
  }
  static Models models(const cv::Mat& homogeneous) {
    const Numbers h = numbersOf(homogeneous);
    return {{h[0] / h[3], h[1] / h[3], h[2] / h[3]}};
  }
};
const bool kTriangulation =
    addSolver<Triangulation>("t2_linear", "opencv", triangulationInstances, plainDistance);

struct Affine2D {
  using Output = cv::Mat;
  static Input prepare(const Instance& instance) {
    Input in;
    for (const auto& p : instance.first) {
      in.first_float.emplace_back(static_cast<float>(p[0]), static_cast<float>(p[1]));
    }
    for (const auto& p : instance.second) {
      in.second_float.emplace_back(static_cast<float>(p[0]), static_cast<float>(p[1]));
    }
    return in;
  }
  static void solve(const Input& in, cv::Mat& out) {
    out = cv::getAffineTransform(in.first_float, in.second_float);
  }
  static Models models(const cv::Mat& affine) { return {numbersOf(affine)}; }
};
const bool kAffine = addSolver<Affine2D>("affine_2d", "opencv", affine2DInstances, plainDistance);

// The loop, as MAGSAC++.
struct RobustInput {
  Points2 first, second;
  Points3 points;
};

Points2 pixelsOf(const std::vector<gslam::Vec2d>& pixels) {
  Points2 result;
  for (const auto& p : pixels) result.emplace_back(p[0], p[1]);
  return result;
}

struct TakesScene {
  static RobustInput prepare(const Scene& scene) {
    return {pixelsOf(scene.first), pixelsOf(scene.second), listOf(scene.points)};
  }
};

const cv::Matx33d kCamera(kFocal, 0, kCentreX, 0, kFocal, kCentreY, 0, 0, 1);
constexpr int kMost = static_cast<int>(kIterations);

struct RelativePose : TakesScene {
  static Found run(const RobustInput& in) {
    cv::Mat inliers, rotation, translation;
    const cv::Mat e = cv::findEssentialMat(in.first, in.second, kCamera, cv::USAC_MAGSAC,
                                           kConfidence, kThreshold, kMost, inliers);
    if (e.rows != 3) return {};
    cv::recoverPose(e, in.first, in.second, kCamera, rotation, translation, inliers);
    Numbers numbers = numbersOf(rotation);
    for (const double number : numbersOf(translation)) numbers.push_back(number);
    return {numbers, {}};
  }
};
struct Fundamental : TakesScene {
  static Found run(const RobustInput& in) {
    const cv::Mat f = cv::findFundamentalMat(in.first, in.second, cv::USAC_MAGSAC, kThreshold,
                                             kConfidence, kMost);
    return {f.rows == 3 ? numbersOf(f) : Numbers(), {}};
  }
};
struct Homography : TakesScene {
  static Found run(const RobustInput& in) {
    const cv::Mat h = cv::findHomography(in.first, in.second, cv::USAC_MAGSAC, kThreshold,
                                         cv::noArray(), kMost, kConfidence);
    return {h.rows == 3 ? numbersOf(h) : Numbers(), {}};
  }
};
struct AbsolutePose : TakesScene {
  static Found run(const RobustInput& in) {
    cv::UsacParams params;
    params.confidence = kConfidence;
    params.maxIterations = kMost;
    params.score = cv::SCORE_METHOD_MAGSAC;
    params.threshold = kThreshold;
    params.loMethod = cv::LOCAL_OPTIM_SIGMA;
    cv::Mat camera(kCamera), rotation, translation, inliers;
    if (!cv::solvePnPRansac(in.points, in.second, camera, cv::noArray(), rotation, translation,
                            inliers, params)) {
      return {};
    }
    return {poseOf(rotation, translation), {}};
  }
};
const bool kRobust =
    addRobustRows<RelativePose, Fundamental, Homography, AbsolutePose>("opencv_magsac");

}  // namespace
