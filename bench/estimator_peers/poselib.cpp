// PoseLib, https://github.com/PoseLib/PoseLib
#include <PoseLib/poselib.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

#include "eigen_input.h"
#include "measure.h"

namespace {

using Poses = std::vector<poselib::CameraPose>;

Numbers numbersOf(const poselib::CameraPose& pose) {
  return numbersOfPose(pose.Rt());
}

struct GivesPoses {
  using Output = Poses;
  static EigenInput prepare(const Instance& instance) { return EigenInput(instance); }
  static Models models(const Poses& poses) {
    Models models;
    for (const auto& pose : poses) models.push_back(numbersOf(pose));
    return models;
  }
};

struct GivesMatrices {
  using Output = Matrices;
  static EigenInput prepare(const Instance& instance) { return EigenInput(instance); }
  static Models models(const Matrices& matrices) { return modelsOfRows(matrices); }
};

struct EightPoints : GivesMatrices {
  static void solve(const EigenInput& in, Matrices& out) {
    out.resize(1);
    poselib::essential_matrix_8pt(in.first, in.second, &out[0]);
  }
};
const bool kF8 =
    addSolver<EightPoints>("f8", "poselib", of<essentialInstances, 8>, scaleFreeDistance);

struct SevenPoints : GivesMatrices {
  static void solve(const EigenInput& in, Matrices& out) {
    out.clear();
    poselib::relpose_7pt(in.first, in.second, &out);
  }
};
const bool kF7 =
    addSolver<SevenPoints>("f7", "poselib", of<fundamentalInstances, 7>, scaleFreeDistance);

struct FivePoints : GivesMatrices {
  static void solve(const EigenInput& in, Matrices& out) {
    out.clear();
    poselib::relpose_5pt(in.first, in.second, &out);
  }
};
const bool kE5 =
    addSolver<FivePoints>("e5", "poselib", of<essentialInstances, 5>, scaleFreeDistance);

struct FourPoints : GivesMatrices {
  static void solve(const EigenInput& in, Matrices& out) {
    out.resize(1);
    poselib::homography_4pt(in.first, in.second, &out[0], false);
  }
};
const bool kH4 = addSolver<FourPoints>("h4", "poselib", homographyInstances, scaleFreeDistance);

struct P3p : GivesPoses {
  static void solve(const EigenInput& in, Poses& out) {
    out.clear();
    poselib::p3p(in.second, in.points, &out);
  }
};
struct LambdaTwist : GivesPoses {
  static void solve(const EigenInput& in, Poses& out) {
    out.clear();
    poselib::p3p_lambdatwist(in.second, in.points, &out);
  }
};
const bool kP3p = addSolver<P3p>("p3p", "poselib", of<absoluteInstances, 3>, poseDistance);
const bool kTwist =
    addSolver<LambdaTwist>("p3p", "poselib_twist", of<absoluteInstances, 3>, poseDistance);
const bool kLine = addSolver<P3p>("p3p_collinear", "poselib", collinearInstances, poseDistance);
const bool kLineTwist =
    addSolver<LambdaTwist>("p3p_collinear", "poselib_twist", collinearInstances, poseDistance);

struct Gp3p : GivesPoses {
  static void solve(const EigenInput& in, Poses& out) {
    out.clear();
    poselib::gp3p(in.origins, in.second, in.points, &out);
  }
};
const bool kGp3p = addSolver<Gp3p>("gp3p", "poselib", of<rigInstances, 3>, poseDistance);

struct VerticalAbsolute : GivesPoses {
  static void solve(const EigenInput& in, Poses& out) {
    const Eigen::Vector3d down(0, 1, 0);
    out.clear();
    poselib::up2p(in.second, in.points, in.rotation * down, down, &out);
  }
};
const bool kUp2p =
    addSolver<VerticalAbsolute>("p2p_vertical", "poselib", of<absoluteInstances, 2>, poseDistance);

struct VerticalRelative : GivesPoses {
  static void solve(const EigenInput& in, Poses& out) {
    const Eigen::Vector3d down(0, 1, 0);
    out.clear();
    poselib::relpose_upright_3pt(in.first, in.second, down, in.rotation * down, &out);
  }
};
const bool kUpright = addSolver<VerticalRelative>("relative_3pt_vertical", "poselib",
                                                  of<verticalInstances, 3>, poseDistance);

// The loop, with the same threshold, confidence and most iterations as everybody.
struct RobustInput {
  std::vector<Eigen::Vector2d> first, second;
  std::vector<Eigen::Vector3d> points;
};

RobustInput inputOf(const Scene& scene) {
  return {allToEigen(scene.first), allToEigen(scene.second), allToEigen(scene.points)};
}

poselib::RansacOptions ransac() {
  poselib::RansacOptions options;
  options.max_iterations = kIterations;
  options.min_iterations = 50;
  options.success_prob = kConfidence;
  return options;
}

poselib::Camera camera() {
  return poselib::Camera("PINHOLE", {kFocal, kFocal, kCentreX, kCentreY}, kWidth, kHeight);
}

poselib::RelativePoseOptions relativeOptions() {
  poselib::RelativePoseOptions options;
  options.ransac = ransac();
  options.max_error = kThreshold;
  return options;
}

struct RelativePose {
  static RobustInput prepare(const Scene& scene) { return inputOf(scene); }
  static Found run(const RobustInput& in) {
    poselib::CameraPose pose;
    std::vector<char> inliers;
    poselib::estimate_relative_pose(in.first, in.second, camera(), camera(), relativeOptions(),
                                    &pose, &inliers);
    return {numbersOf(pose), {}};
  }
};

struct Fundamental {
  static RobustInput prepare(const Scene& scene) { return inputOf(scene); }
  static Found run(const RobustInput& in) {
    Eigen::Matrix3d f;
    std::vector<char> inliers;
    poselib::estimate_fundamental(in.first, in.second, relativeOptions(), &f, &inliers);
    return {numbersOfRows(f), {}};
  }
};

struct Homography {
  static RobustInput prepare(const Scene& scene) { return inputOf(scene); }
  static Found run(const RobustInput& in) {
    poselib::HomographyOptions options;
    options.ransac = ransac();
    options.max_error = kThreshold;
    Eigen::Matrix3d h;
    std::vector<char> inliers;
    poselib::estimate_homography(in.first, in.second, options, &h, &inliers);
    return {numbersOfRows(h), {}};
  }
};

struct AbsolutePose {
  static RobustInput prepare(const Scene& scene) { return inputOf(scene); }
  static Found run(const RobustInput& in) {
    poselib::AbsolutePoseOptions options;
    options.ransac = ransac();
    options.max_error = kThreshold;
    poselib::Image image;
    image.camera = camera();
    std::vector<char> inliers;
    poselib::estimate_absolute_pose(in.second, in.points, options, &image, &inliers);
    return {numbersOf(image.pose), {}};
  }
};

const bool kRobust = addRobustRows<RelativePose, Fundamental, Homography, AbsolutePose>("poselib");

}  // namespace
