#include <gslam/geometry/euler.h>
#include <gslam/optimizer/files/toro.h>

#include "files/pose_graph_text.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::TextReader;
using detail::TextWriter;

constexpr const char* kToroTags =
    "VERTEX2, VERTEX, EDGE2, EDGE, ODOMETRY, EDGE_ODOMETRY, VERTEX3 or EDGE3";

struct ToroPlane {
  using Group = SE2d;
  static constexpr const char* kVertex = "VERTEX2";
  static constexpr const char* kEdge = "EDGE2";
  static constexpr bool kHasFix = false;
  static bool isVertex(std::string_view tag) { return tag == kVertex || tag == "VERTEX"; }
  static bool isEdge(std::string_view tag) {
    return tag == kEdge || tag == "EDGE" || tag == "ODOMETRY" || tag == "EDGE_ODOMETRY";
  }
  static SE2d readPose(TextReader& in) {
    const double x = in.number("x"), y = in.number("y"), angle = in.number("an angle");
    return SE2d(SO2d::fromAngle(angle), {x, y});
  }
  static void writePose(const SE2d& pose, TextWriter& out) {
    out.list(pose.translation(), 2) << ' ' << pose.rotation().angle();
  }
  // xx xy yy aa xa ya
  static Mat3d readInformation(TextReader& in) {
    double v[6];
    for (double& value : v) value = in.number("an element of an information");
    return {v[0], v[1], v[4], v[1], v[2], v[5], v[4], v[5], v[3]};
  }
  static void writeInformation(const Mat3d& m, TextWriter& out) {
    const double v[] = {m(0, 0), m(0, 1), m(1, 1), m(2, 2), m(0, 2), m(1, 2)};
    out.list(v, 6);
  }
};

struct ToroSpace {
  using Group = SE3d;
  static constexpr const char* kVertex = "VERTEX3";
  static constexpr const char* kEdge = "EDGE3";
  static constexpr bool kHasFix = false;
  static bool isVertex(std::string_view tag) { return tag == kVertex; }
  static bool isEdge(std::string_view tag) { return tag == kEdge; }
  static SE3d readPose(TextReader& in) {
    Vec3d t{}, angles{};
    for (double& value : t.values) value = in.number("a part of a translation");
    for (double& value : angles.values) value = in.number("roll, pitch or yaw");
    return SE3d(fromExtrinsicEuler(EulerSequence::xyz, angles), t);
  }
  static void writePose(const SE3d& pose, TextWriter& out) {
    out.list(pose.translation(), 3);
    out.list(extrinsicEulerOf(pose.rotation(), EulerSequence::xyz), 3);
  }
  static SE3d::Jacobian readInformation(TextReader& in) { return detail::readUpperTriangle<6>(in); }
  static void writeInformation(const SE3d::Jacobian& m, TextWriter& out) {
    detail::writeUpperTriangle(m, out);
  }
};

struct WriteToro {
  void operator()(const PoseGraph<SE2d>& graph) { detail::writeGraph<ToroPlane>(graph, out); }
  void operator()(const PoseGraph<SE3d>& graph) { detail::writeGraph<ToroSpace>(graph, out); }
  void operator()(const PoseGraph<SIM3d>&) {}  // was refused
  TextWriter& out;
};

}  // namespace

AnyPoseGraph parseToro(const std::string& text, const std::string& name) {
  TextReader in(text, name, true);
  return detail::readGraphOf<ToroPlane, ToroSpace>(in, kToroTags);
}

AnyPoseGraph readToro(const std::string& path) {
  return parseToro(detail::readTextFile(path), path);
}

void writeToro(const AnyPoseGraph& graph, const std::string& path) {
  if (std::holds_alternative<PoseGraph<SIM3d>>(graph)) {
    throw ArgumentError("graph", "has scales, which TORO files cannot hold");
  }
  std::visit([](const auto& any) { detail::checkGraphArrays(any, "TORO"); }, graph);
  TextWriter out(path);
  std::visit(WriteToro{out}, graph);
  out.commit();
}

}  // namespace v1
}  // namespace gslam
