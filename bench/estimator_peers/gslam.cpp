// Our own solvers.
#include <gslam/estimator/solvers.h>

#include <array>
#include <cstddef>
#include <vector>

#include "measure.h"

namespace {

using gslam::Mat3d;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::Span;
using gslam::Vec2d;
using gslam::Vec3d;

template <class Matrix>
Numbers numbersOf(const Matrix& m) {
  return Numbers(m.data(), m.data() + sizeof(m) / sizeof(double));
}
Numbers numbersOf(const SO3d& rotation) {
  return numbersOf(rotation.matrix());
}
Numbers numbersOf(const SE3d& pose) {
  Numbers numbers = numbersOf(pose.rotation());
  for (std::size_t i = 0; i < 3; ++i) numbers.push_back(pose.translation()[i]);
  return numbers;
}
Numbers numbersOf(const SIM3d& similarity) {
  Numbers numbers = numbersOf(SE3d(similarity.rotation(), similarity.translation()));
  numbers.push_back(similarity.scale());
  return numbers;
}

struct Input {
  std::vector<Vec3d> first, second, points, origins;
  std::vector<Vec2d> first_plane, second_plane;
  SO3d rotation;
  SE3d pose;
};

// Those of maps of a plane have z = 0 and are no rays.
std::vector<Vec2d> inPlane(const std::vector<Vec3d>& bearings) {
  std::vector<Vec2d> result;
  for (const Vec3d& v : bearings) {
    const double z = v[2] == 0 ? 1 : v[2];
    result.push_back({v[0] / z, v[1] / z});
  }
  return result;
}

struct TakesInstance {
  static Input prepare(const Instance& instance) {
    return {instance.first,           instance.second,
            instance.points,          instance.origins,
            inPlane(instance.first),  inPlane(instance.second),
            instance.pose.rotation(), instance.pose};
  }
};

// Solutions of a minimal solver.
template <class Model, std::size_t kMost>
struct Several : TakesInstance {
  struct Output {
    std::array<Model, kMost> models;
    std::size_t count;
  };
  static Models models(const Output& output) {
    Models models;
    for (std::size_t i = 0; i < output.count; ++i) models.push_back(numbersOf(output.models[i]));
    return models;
  }
};

// One solution at most.
template <class Model>
struct One : TakesInstance {
  struct Output {
    Model model;
    std::size_t count;
  };
  static Models models(const Output& output) {
    return output.count == 0 ? Models() : Models{numbersOf(output.model)};
  }
};

template <class Model, std::size_t kMost,
          std::size_t (*solver)(Span<const Vec3d>, Span<const Vec3d>, std::array<Model, kMost>&)>
struct OfViews : Several<Model, kMost> {
  static void solve(const Input& in, typename Several<Model, kMost>::Output& out) {
    out.count = solver(in.first, in.second, out.models);
  }
};
template <std::size_t kMost,
          std::size_t (*solver)(Span<const Vec3d>, Span<const Vec3d>, std::array<SE3d, kMost>&)>
struct OfPoints : Several<SE3d, kMost> {
  static void solve(const Input& in, typename Several<SE3d, kMost>::Output& out) {
    out.count = solver(in.second, in.points, out.models);
  }
};
template <class Model, std::size_t (*solver)(Span<const Vec2d>, Span<const Vec2d>, Model&)>
struct OfPlanes : One<Model> {
  static void solve(const Input& in, typename One<Model>::Output& out) {
    out.count = solver(in.first_plane, in.second_plane, out.model);
  }
};

struct SevenPoints : Several<Mat3d, 3> {
  static void solve(const Input& in, Output& out) {
    out.count = gslam::fundamental7pt(in.first_plane, in.second_plane, out.models);
  }
};
struct EssentialEight : One<Mat3d> {
  static void solve(const Input& in, Output& out) {
    out.count = gslam::essential8pt(in.first, in.second, out.model);
  }
};
struct VerticalRelative : Several<SE3d, 4> {
  static void solve(const Input& in, Output& out) {
    const Vec3d down = {0, 1, 0};
    out.count =
        gslam::relativePose3ptVertical(in.first, in.second, down, in.rotation * down, out.models);
  }
};
struct TwoRotation : One<SO3d> {
  static void solve(const Input& in, Output& out) {
    out.count = gslam::rotation2pt(in.first, in.second, out.model);
  }
};
const bool kViews[] = {
    addSolver<OfPlanes<Mat3d, gslam::fundamental8pt>>("f8", "gslam", of<essentialInstances, 8>,
                                                      scaleFreeDistance),
    addSolver<EssentialEight>("f8", "gslam_essential", of<essentialInstances, 8>,
                              scaleFreeDistance),
    addSolver<SevenPoints>("f7", "gslam", of<fundamentalInstances, 7>, scaleFreeDistance),
    addSolver<OfViews<Mat3d, 10, gslam::essential5pt>>("e5", "gslam", of<essentialInstances, 5>,
                                                       scaleFreeDistance),
    addSolver<OfViews<Mat3d, 10, gslam::essential5ptNister>>(
        "e5", "gslam_nister", of<essentialInstances, 5>, scaleFreeDistance),
    addSolver<OfViews<Mat3d, 10, gslam::essential5ptStewenius>>(
        "e5", "gslam_stewenius", of<essentialInstances, 5>, scaleFreeDistance),
    addSolver<OfViews<SO3d, 20, gslam::rotation5ptKneip>>("e5_kneip", "gslam",
                                                          relativeRotationInstances, plainDistance),
    addSolver<VerticalRelative>("relative_3pt_vertical", "gslam", of<verticalInstances, 3>,
                                poseDistance),
    addSolver<TwoRotation>("rotation_2pt", "gslam", pureRotationInstances, plainDistance),
    addSolver<OfPlanes<Mat3d, gslam::homography4pt>>("h4", "gslam", homographyInstances,
                                                     scaleFreeDistance),
    addSolver<OfPlanes<Mat3d, gslam::homographyDlt>>("h4", "gslam_dlt", homographyInstances,
                                                     scaleFreeDistance)};

struct Epnp : One<SE3d> {
  static void solve(const Input& in, Output& out) {
    out.count = gslam::epnp(in.second, in.points, out.model);
  }
};
struct KnownRotation : One<SE3d> {
  static void solve(const Input& in, Output& out) {
    out.count = gslam::p2pKnownRotation(in.second, in.points, in.rotation, out.model);
  }
};
struct KnownVertical : Several<SE3d, 2> {
  static void solve(const Input& in, Output& out) {
    const Vec3d down = {0, 1, 0};
    out.count = gslam::p2pKnownVertical(in.second, in.points, in.rotation * down, down, out.models);
  }
};
struct Gp3p : Several<SE3d, 8> {
  static void solve(const Input& in, Output& out) {
    out.count = gslam::gp3p(in.origins, in.second, in.points, out.models);
  }
};
struct Gpnp : Several<SE3d, 4> {
  static void solve(const Input& in, Output& out) {
    out.count = gslam::gpnp(in.origins, in.second, in.points, out.models);
  }
};
using P3p = OfPoints<4, gslam::p3p>;
using Sqpnp = OfPoints<4, gslam::sqpnp>;
const bool kPoses[] = {
    addSolver<P3p>("p3p", "gslam", of<absoluteInstances, 3>, poseDistance),
    addSolver<P3p>("p3p_collinear", "gslam", collinearInstances, poseDistance),
    addSolver<OfPoints<4, gslam::p3pKneip>>("p3p_kneip", "gslam", of<absoluteInstances, 3>,
                                            poseDistance),
    addSolver<OfPoints<4, gslam::p3pGao>>("p3p_gao", "gslam", of<absoluteInstances, 3>,
                                          poseDistance),
    addSolver<Epnp>("epnp_6", "gslam", of<absoluteInstances, 6>, poseDistance),
    addSolver<Epnp>("epnp_6_planar", "gslam", of<planarInstances, 6>, poseDistance),
    addSolver<Sqpnp>("sqpnp_6", "gslam", of<absoluteInstances, 6>, poseDistance),
    addSolver<Sqpnp>("sqpnp_6_planar", "gslam", of<planarInstances, 6>, poseDistance),
    addSolver<Gp3p>("gp3p", "gslam", of<rigInstances, 3>, poseDistance),
    addSolver<Gpnp>("gpnp_10", "gslam", of<rigInstances, 10>, poseDistance),
    addSolver<Gpnp>("gpnp_10_planar", "gslam", of<planarRigInstances, 10>, poseDistance),
    addSolver<KnownRotation>("p2p_rotation", "gslam", of<absoluteInstances, 2>, poseDistance),
    addSolver<KnownVertical>("p2p_vertical", "gslam", of<absoluteInstances, 2>, poseDistance)};

template <std::size_t (*solver)(const SE3d&, const Vec3d&, const Vec3d&, Vec3d&)>
struct Triangulation : One<Vec3d> {
  static void solve(const Input& in, Output& out) {
    out.count = solver(in.pose, in.first[0], in.second[0], out.model);
  }
};
struct Similarity : One<SIM3d> {
  static void solve(const Input& in, Output& out) {
    out.count = gslam::similarity3D(in.first, in.second, out.model);
  }
};
struct Affine3D : One<gslam::Mat<double, 3, 4>> {
  static void solve(const Input& in, Output& out) {
    out.count = gslam::affine3D(in.first, in.second, out.model);
  }
};
struct Plane : One<gslam::Vec4d> {
  static void solve(const Input& in, Output& out) {
    out.count = gslam::planeFromPoints(in.first, out.model);
  }
};
const bool kPoints[] = {
    addSolver<Triangulation<gslam::triangulateMidpoint>>("t2_midpoint", "gslam",
                                                         triangulationInstances, plainDistance),
    addSolver<Triangulation<gslam::triangulateOptimal>>("t2_optimal", "gslam",
                                                        triangulationInstances, plainDistance),
    addSolver<Triangulation<gslam::triangulateLinear>>("t2_linear", "gslam", triangulationInstances,
                                                       plainDistance),
    addSolver<Similarity>("similarity_3", "gslam", similarityInstances, poseDistance),
    addSolver<OfPlanes<gslam::Mat<double, 2, 3>, gslam::affine2D>>(
        "affine_2d", "gslam", affine2DInstances, plainDistance),
    addSolver<Affine3D>("affine_3d", "gslam", affine3DInstances, plainDistance),
    addSolver<Plane>("plane_3", "gslam", planeInstances, scaleFreeDistance)};

}  // namespace
