// OpenGV, https://github.com/laurentkneip/opengv
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <opengv/absolute_pose/CentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/NoncentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/methods.hpp>
#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/relative_pose/methods.hpp>
#include <opengv/triangulation/methods.hpp>
#include <opengv/types.hpp>
#include <vector>

#include "eigen_input.h"
#include "measure.h"

namespace {

using opengv::absolute_pose::CentralAbsoluteAdapter;
using opengv::absolute_pose::NoncentralAbsoluteAdapter;
using opengv::relative_pose::CentralRelativeAdapter;

template <class Vectors>
Vectors listOf(const std::vector<gslam::Vec3d>& vectors) {
  Vectors result;
  for (const auto& v : vectors) result.push_back(toEigen(v));
  return result;
}

// Adapters hold references to what they are made of.
struct Relative {
  opengv::bearingVectors_t first, second;
  opengv::rotation_t rotation;
  mutable std::unique_ptr<CentralRelativeAdapter> adapter;

  explicit Relative(const Instance& instance)
      : first(listOf<opengv::bearingVectors_t>(instance.first)),
        second(listOf<opengv::bearingVectors_t>(instance.second)),
        rotation(toEigen(instance.pose.rotation().matrix())) {
    make();
  }
  Relative(const Relative& other)
      : first(other.first), second(other.second), rotation(other.rotation) {
    make();
  }
  Relative& operator=(const Relative&) = delete;
  ~Relative() = default;

 private:
  void make() { adapter = std::make_unique<CentralRelativeAdapter>(second, first); }
};

struct TakesRelative {
  static Relative prepare(const Instance& instance) { return Relative(instance); }
};

struct RelativeMatrices : TakesRelative {
  using Output = opengv::essentials_t;
  static Models models(const Output& output) { return modelsOfRows(output); }
};

struct EightPoints : RelativeMatrices {
  static void solve(const Relative& in, Output& out) {
    out.assign(1, opengv::relative_pose::eightpt(*in.adapter));
  }
};
struct SevenPoints : RelativeMatrices {
  static void solve(const Relative& in, Output& out) {
    out = opengv::relative_pose::sevenpt(*in.adapter);
  }
};
struct Nister : RelativeMatrices {
  static void solve(const Relative& in, Output& out) {
    out = opengv::relative_pose::fivept_nister(*in.adapter);
  }
};
struct Stewenius : TakesRelative {
  using Output = opengv::complexEssentials_t;
  static void solve(const Relative& in, Output& out) {
    out = opengv::relative_pose::fivept_stewenius(*in.adapter);
  }
  static Models models(const Output& output) {
    Models models;
    for (const auto& complex : output) models.push_back(numbersOfRows(complex.real()));
    return models;
  }
};
struct Kneip : TakesRelative {
  using Output = opengv::rotations_t;
  static void solve(const Relative& in, Output& out) {
    static const std::vector<int> all = {0, 1, 2, 3, 4};
    out = opengv::relative_pose::fivept_kneip(*in.adapter, all);
  }
  static Models models(const Output& output) { return modelsOfRows(output); }
};
struct TwoRotation : TakesRelative {
  using Output = opengv::rotation_t;
  static void solve(const Relative& in, Output& out) {
    out = opengv::relative_pose::twopt_rotationOnly(*in.adapter);
  }
  static Models models(const Output& output) { return {numbersOfRows(output)}; }
};
const bool kRelative[] = {
    addSolver<EightPoints>("f8", "opengv", of<essentialInstances, 8>, scaleFreeDistance),
    addSolver<SevenPoints>("f7", "opengv", of<essentialInstances, 7>, scaleFreeDistance),
    addSolver<Nister>("e5", "opengv_nister", of<essentialInstances, 5>, scaleFreeDistance),
    addSolver<Stewenius>("e5", "opengv_stewenius", of<essentialInstances, 5>, scaleFreeDistance),
    addSolver<Kneip>("e5_kneip", "opengv", relativeRotationInstances, plainDistance),
    addSolver<TwoRotation>("rotation_2pt", "opengv", pureRotationInstances, plainDistance)};

// Its adapter takes T_first_second.
struct TriangulationInput : Relative {
  explicit TriangulationInput(const Instance& instance) : Relative(instance) {
    const gslam::SE3d pose = instance.pose.inverse();
    located = std::make_shared<CentralRelativeAdapter>(first, second, toEigen(pose.translation()),
                                                       toEigen(pose.rotation().matrix()));
  }
  TriangulationInput(const TriangulationInput& other) : Relative(other) {
    located = std::make_shared<CentralRelativeAdapter>(first, second, other.located->gett12(),
                                                       other.located->getR12());
  }
  TriangulationInput& operator=(const TriangulationInput&) = delete;
  ~TriangulationInput() = default;

  std::shared_ptr<CentralRelativeAdapter> located;
};
struct Triangulates {
  using Output = opengv::point_t;
  static TriangulationInput prepare(const Instance& instance) {
    return TriangulationInput(instance);
  }
  static Models models(const Output& output) { return {numbersOfRows(output)}; }
};
struct Linear : Triangulates {
  static void solve(const TriangulationInput& in, Output& out) {
    out = opengv::triangulation::triangulate(*in.located, 0);
  }
};
struct Midpoint : Triangulates {
  static void solve(const TriangulationInput& in, Output& out) {
    out = opengv::triangulation::triangulate2(*in.located, 0);
  }
};
const bool kTriangulation[] = {
    addSolver<Linear>("t2_linear", "opengv", triangulationInstances, plainDistance),
    addSolver<Midpoint>("t2_midpoint", "opengv", triangulationInstances, plainDistance)};

// Of absolute poses it gives T_world_camera.
Numbers inverted(const opengv::transformation_t& pose) {
  const Eigen::Matrix3d rotation = pose.leftCols<3>().transpose();
  const Eigen::Vector3d translation = -rotation * pose.col(3);
  Numbers numbers = numbersOfRows(rotation);
  for (int i = 0; i < 3; ++i) numbers.push_back(translation(i));
  return numbers;
}

struct GivesPoses {
  using Output = opengv::transformations_t;
  static Models models(const Output& output) {
    Models models;
    for (const auto& pose : output) models.push_back(inverted(pose));
    return models;
  }
};

struct Absolute {
  opengv::bearingVectors_t bearings;
  opengv::points_t points;
  opengv::rotation_t rotation;
  std::unique_ptr<CentralAbsoluteAdapter> adapter;

  explicit Absolute(const Instance& instance)
      : bearings(listOf<opengv::bearingVectors_t>(instance.second)),
        points(listOf<opengv::points_t>(instance.points)),
        rotation(toEigen(instance.pose.rotation().matrix()).transpose()) {
    make();
  }
  Absolute(const Absolute& other)
      : bearings(other.bearings), points(other.points), rotation(other.rotation) {
    make();
  }
  Absolute& operator=(const Absolute&) = delete;
  ~Absolute() = default;

 private:
  void make() { adapter = std::make_unique<CentralAbsoluteAdapter>(bearings, points, rotation); }
};

struct TakesAbsolute : GivesPoses {
  static Absolute prepare(const Instance& instance) { return Absolute(instance); }
};
struct P3pKneip : TakesAbsolute {
  static void solve(const Absolute& in, Output& out) {
    out = opengv::absolute_pose::p3p_kneip(*in.adapter);
  }
};
struct P3pGao : TakesAbsolute {
  static void solve(const Absolute& in, Output& out) {
    out = opengv::absolute_pose::p3p_gao(*in.adapter);
  }
};
struct Epnp : TakesAbsolute {
  static void solve(const Absolute& in, Output& out) {
    out.assign(1, opengv::absolute_pose::epnp(*in.adapter));
  }
};
struct P2p : TakesAbsolute {
  static void solve(const Absolute& in, Output& out) {
    out.resize(1);
    out[0].leftCols<3>() = in.rotation;
    out[0].col(3) = opengv::absolute_pose::p2p(*in.adapter);
  }
};
const bool kAbsolute[] = {
    addSolver<P3pKneip>("p3p_kneip", "opengv", of<absoluteInstances, 3>, poseDistance),
    addSolver<P3pGao>("p3p_gao", "opengv", of<absoluteInstances, 3>, poseDistance),
    addSolver<Epnp>("epnp_6", "opengv", of<absoluteInstances, 6>, poseDistance),
    addSolver<Epnp>("epnp_6_planar", "opengv", of<planarInstances, 6>, poseDistance),
    addSolver<P2p>("p2p_rotation", "opengv", of<absoluteInstances, 2>, poseDistance)};

struct Rig {
  opengv::bearingVectors_t bearings;
  opengv::points_t points;
  std::vector<int> cameras;
  opengv::translations_t offsets;
  opengv::rotations_t rotations;
  std::unique_ptr<NoncentralAbsoluteAdapter> adapter;

  explicit Rig(const Instance& instance)
      : bearings(listOf<opengv::bearingVectors_t>(instance.second)),
        points(listOf<opengv::points_t>(instance.points)),
        cameras(instance.points.size()),
        offsets(listOf<opengv::translations_t>(instance.origins)),
        rotations(instance.points.size(), opengv::rotation_t::Identity()) {
    std::iota(cameras.begin(), cameras.end(), 0);
    make();
  }
  Rig(const Rig& other)
      : bearings(other.bearings),
        points(other.points),
        cameras(other.cameras),
        offsets(other.offsets),
        rotations(other.rotations) {
    make();
  }
  Rig& operator=(const Rig&) = delete;
  ~Rig() = default;

 private:
  void make() {
    adapter =
        std::make_unique<NoncentralAbsoluteAdapter>(bearings, cameras, points, offsets, rotations);
  }
};
struct TakesRig : GivesPoses {
  static Rig prepare(const Instance& instance) { return Rig(instance); }
};
struct Gp3p : TakesRig {
  static void solve(const Rig& in, Output& out) { out = opengv::absolute_pose::gp3p(*in.adapter); }
};
struct Gpnp : TakesRig {
  static void solve(const Rig& in, Output& out) {
    out.assign(1, opengv::absolute_pose::gpnp(*in.adapter));
  }
};
struct Upnp : TakesRig {
  static void solve(const Rig& in, Output& out) { out = opengv::absolute_pose::upnp(*in.adapter); }
};
const bool kRig[] = {
    addSolver<Gp3p>("gp3p", "opengv", of<rigInstances, 3>, poseDistance),
    addSolver<Gpnp>("gpnp_10", "opengv_gpnp", of<rigInstances, 10>, poseDistance),
    addSolver<Upnp>("gpnp_10", "opengv_upnp", of<rigInstances, 10>, poseDistance),
    addSolver<Gpnp>("gpnp_10_planar", "opengv_gpnp", of<planarRigInstances, 10>, poseDistance),
    addSolver<Upnp>("gpnp_10_planar", "opengv_upnp", of<planarRigInstances, 10>, poseDistance)};

}  // namespace
