#include <gslam/optimizer/files/bal.h>

#include "files/bundle_text.h"
#include "files/text_writer.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::TextReader;

struct BalCounts {
  std::size_t cameras, points, observations;
};

// Each number takes a digit and a space at least, so that no more is allocated than is there.
BalCounts readBalCounts(TextReader& in) {
  const char* const begin = in.place();
  const auto cameras = in.below("the number of cameras", detail::kMostThings);
  const auto points = in.below("the number of points", detail::kMostThings);
  const auto observations = in.below("the number of observations", detail::kMostThings);
  if (8 * observations + 18 * cameras + 6 * points > in.rest() + 1) {
    in.throwAt(begin, "the file is too short for " + std::to_string(cameras) + " cameras, " +
                          std::to_string(points) + " points and " + std::to_string(observations) +
                          " observations");
  }
  return {static_cast<std::size_t>(cameras), static_cast<std::size_t>(points),
          static_cast<std::size_t>(observations)};
}

void readBalCamera(TextReader& in, Bundle& bundle) {
  in.hasWord();
  const char* const begin = in.place();
  Vec3d rotation{}, translation{};
  for (double& value : rotation.values) value = in.number("a part of a rotation vector");
  for (double& value : translation.values) value = in.number("a part of a translation");
  const double f = in.number("a focal length");
  const double k1 = in.number("k1"), k2 = in.number("k2");
  try {
    const SE3d pose = detail::poseOfBackwardCamera(SE3d(SO3d::exp(rotation), translation));
    if (!detail::isFinitePose(pose)) in.failAt(begin, "begins a camera that is too far away");
    bundle.T_world_body.push_back(pose);
    bundle.cameras.push_back(detail::radialCamera(f, k1, k2));
  } catch (const ArgumentError& error) {
    in.failAt(begin, std::string("begins a camera that cannot be: ") + error.what());
  }
}

Bundle readBalText(TextReader& in) {
  const BalCounts counts = readBalCounts(in);
  Bundle bundle;
  detail::reserveObservations(bundle, counts.observations);
  for (std::size_t i = 0; i < counts.observations; ++i) {
    const auto pose = static_cast<std::uint32_t>(in.below("a camera's number", counts.cameras));
    const auto point = static_cast<std::uint32_t>(in.below("a point's number", counts.points));
    const double x = in.number("x of an observation"), y = in.number("y of an observation");
    detail::addObservation(bundle, pose, point, pose, {x, -y});
  }
  bundle.T_world_body.reserve(counts.cameras);
  bundle.cameras.reserve(counts.cameras);
  for (std::size_t i = 0; i < counts.cameras; ++i) readBalCamera(in, bundle);
  bundle.camera_freedom.assign(counts.cameras, detail::radialFreedom());
  bundle.points.resize(counts.points);
  for (Vec3d& point : bundle.points) {
    for (double& value : point.values) value = in.number("a coordinate of a point");
  }
  in.expectEnd();
  return bundle;
}

}  // namespace

Bundle parseBal(const std::string& text, const std::string& name) {
  TextReader in(text, name, false);
  return readBalText(in);
}

Bundle readBal(const std::string& path) {
  return parseBal(detail::readTextFile(path), path);
}

void writeBal(const Bundle& bundle, const std::string& path) {
  const std::vector<std::uint32_t> camera_of = detail::cameraOfEachPose(bundle, "BAL");
  std::vector<detail::RadialParameters> parameters;
  for (std::size_t i = 0; i < camera_of.size(); ++i) {
    if (camera_of[i] == IdMap::kNone) {
      throw ArgumentError("T_world_body[" + std::to_string(i) + "]",
                          "sees nothing, so that it is not known which camera is its own");
    }
    parameters.push_back(
        detail::radialParametersOf(bundle.cameras[camera_of[i]], camera_of[i], "BAL"));
  }
  detail::TextWriter out(path);
  out << camera_of.size() << ' ' << bundle.points.size() << ' ' << bundle.pixels.size() << '\n';
  for (std::size_t i = 0; i < bundle.pixels.size(); ++i) {
    const std::uint32_t pose = bundle.observation_pose[i];
    const Vec2d from_centre = bundle.pixels[i] - parameters[pose].centre;
    out << pose << ' ' << bundle.observation_point[i] << ' ' << from_centre[0] << ' '
        << -from_centre[1] << '\n';
  }
  for (std::size_t i = 0; i < camera_of.size(); ++i) {
    const SE3d pose = detail::backwardCameraOfPose(bundle.T_world_body[i]);
    for (const double value : pose.rotation().log().values) out << value << '\n';
    for (const double value : pose.translation().values) out << value << '\n';
    out << parameters[i].f << '\n' << parameters[i].k1 << '\n' << parameters[i].k2 << '\n';
  }
  for (const Vec3d& point : bundle.points) {
    for (const double value : point.values) out << value << '\n';
  }
  out.commit();
}

}  // namespace v1
}  // namespace gslam
