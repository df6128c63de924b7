#include <gslam/optimizer/files/g2o.h>

#include "files/pose_graph_text.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::TextReader;
using detail::TextWriter;

constexpr const char* kG2oTags =
    "VERTEX_SE2, EDGE_SE2, VERTEX_SE3:QUAT, EDGE_SE3:QUAT, VERTEX_SIM3:QUAT, EDGE_SIM3:QUAT or FIX";

// Information of half the rotation vector is that of the whole one times 2 for each of its axes.
template <std::size_t N>
Mat<double, N, N> scaledRotation(Mat<double, N, N> m, double factor) {
  for (std::size_t r = 0; r < N; ++r) {
    for (std::size_t c = 0; c < N; ++c) {
      if (r >= 3 && r < 6) m(r, c) *= factor;
      if (c >= 3 && c < 6) m(r, c) *= factor;
    }
  }
  return m;
}

SE3d readQuaternionPose(TextReader& in) {
  Vec3d t{};
  Vec4d q{};
  for (double& value : t.values) value = in.number("a part of a translation");
  const char* const begin = in.hasWord() ? in.place() : nullptr;
  for (double& value : q.values) value = in.number("a part of a quaternion");
  if (!(std::fabs(q.norm() - 1) < 0.1)) {
    in.failAt(begin, "begins a quaternion of norm " + std::to_string(q.norm()) + ", expected 1");
  }
  return SE3d(SO3d::fromQuaternion(q[0], q[1], q[2], q[3]), t);
}
void writeQuaternionPose(const SE3d& pose, TextWriter& out) {
  out.list(pose.translation(), 3).list(pose.rotation().quaternion(), 4);
}

struct G2oPlane {
  using Group = SE2d;
  static constexpr const char* kVertex = "VERTEX_SE2";
  static constexpr const char* kEdge = "EDGE_SE2";
  static constexpr bool kHasFix = true;
  static bool isVertex(std::string_view tag) { return tag == kVertex; }
  static bool isEdge(std::string_view tag) { return tag == kEdge; }
  static SE2d readPose(TextReader& in) {
    const double x = in.number("x"), y = in.number("y"), angle = in.number("an angle");
    return SE2d(SO2d::fromAngle(angle), {x, y});
  }
  static void writePose(const SE2d& pose, TextWriter& out) {
    out.list(pose.translation(), 2) << ' ' << pose.rotation().angle();
  }
  static Mat3d readInformation(TextReader& in) { return detail::readUpperTriangle<3>(in); }
  static void writeInformation(const Mat3d& m, TextWriter& out) {
    detail::writeUpperTriangle(m, out);
  }
};

struct G2oSpace {
  using Group = SE3d;
  static constexpr const char* kVertex = "VERTEX_SE3:QUAT";
  static constexpr const char* kEdge = "EDGE_SE3:QUAT";
  static constexpr bool kHasFix = true;
  static bool isVertex(std::string_view tag) { return tag == kVertex; }
  static bool isEdge(std::string_view tag) { return tag == kEdge; }
  static SE3d readPose(TextReader& in) { return readQuaternionPose(in); }
  static void writePose(const SE3d& pose, TextWriter& out) { writeQuaternionPose(pose, out); }
  static SE3d::Jacobian readInformation(TextReader& in) {
    return scaledRotation(detail::readUpperTriangle<6>(in), 0.5);
  }
  static void writeInformation(const SE3d::Jacobian& m, TextWriter& out) {
    detail::writeUpperTriangle(scaledRotation(m, 2), out);
  }
};

struct G2oScaled {
  using Group = SIM3d;
  static constexpr const char* kVertex = "VERTEX_SIM3:QUAT";
  static constexpr const char* kEdge = "EDGE_SIM3:QUAT";
  static constexpr bool kHasFix = true;
  static bool isVertex(std::string_view tag) { return tag == kVertex; }
  static bool isEdge(std::string_view tag) { return tag == kEdge; }
  static SIM3d readPose(TextReader& in) {
    const SE3d pose = readQuaternionPose(in);
    const char* const begin = in.hasWord() ? in.place() : nullptr;
    const double scale = in.number("a scale");
    if (!(scale > 0)) in.failAt(begin, "is a scale, expected one above 0");
    return SIM3d(pose, scale);
  }
  static void writePose(const SIM3d& pose, TextWriter& out) {
    writeQuaternionPose(pose.rigid(), out);
    out << ' ' << pose.scale();
  }
  static SIM3d::Jacobian readInformation(TextReader& in) {
    return scaledRotation(detail::readUpperTriangle<7>(in), 0.5);
  }
  static void writeInformation(const SIM3d::Jacobian& m, TextWriter& out) {
    detail::writeUpperTriangle(scaledRotation(m, 2), out);
  }
};

struct WriteG2o {
  void operator()(const PoseGraph<SE2d>& graph) { detail::writeGraph<G2oPlane>(graph, out); }
  void operator()(const PoseGraph<SE3d>& graph) { detail::writeGraph<G2oSpace>(graph, out); }
  void operator()(const PoseGraph<SIM3d>& graph) { detail::writeGraph<G2oScaled>(graph, out); }
  TextWriter& out;
};

}  // namespace

AnyPoseGraph parseG2o(const std::string& text, const std::string& name) {
  TextReader in(text, name, true);
  return detail::readGraphOf<G2oPlane, G2oScaled, G2oSpace>(in, kG2oTags);
}

AnyPoseGraph readG2o(const std::string& path) {
  return parseG2o(detail::readTextFile(path), path);
}

void writeG2o(const AnyPoseGraph& graph, const std::string& path) {
  std::visit([](const auto& any) { detail::checkGraphArrays(any, "g2o"); }, graph);
  TextWriter out(path);
  std::visit(WriteG2o{out}, graph);
  out.commit();
}

}  // namespace v1
}  // namespace gslam
