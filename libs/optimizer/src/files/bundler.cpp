#include <gslam/optimizer/files/bundler.h>

#include "files/bundle_text.h"
#include "files/text_writer.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::TextReader;

constexpr const char* kBundlerHeader = "# Bundle file v0.3";

void addUnregisteredCamera(Bundle& bundle) {
  bundle.T_world_body.emplace_back();
  bundle.pose_fixed.push_back(1);
  bundle.cameras.push_back(detail::radialCamera(1, 0, 0));
  bundle.camera_freedom.emplace_back();
}

void readBundlerCamera(TextReader& in, Bundle& bundle) {
  in.hasWord();
  const char* const begin = in.place();
  const double f = in.number("a focal length");
  const double k1 = in.number("k1"), k2 = in.number("k2");
  Mat3d rotation{};
  Vec3d translation{};
  for (double& value : rotation.values) value = in.number("an element of a rotation matrix");
  for (double& value : translation.values) value = in.number("a part of a translation");
  if (f == 0) return addUnregisteredCamera(bundle);
  try {
    constexpr double kTolerance = 1e-3;  // matrices are written with few digits
    const SE3d pose =
        detail::poseOfBackwardCamera(SE3d(SO3d::fromMatrix(rotation, kTolerance), translation));
    if (!detail::isFinitePose(pose)) in.failAt(begin, "begins a camera that is too far away");
    bundle.T_world_body.push_back(pose);
    bundle.pose_fixed.push_back(0);
    bundle.cameras.push_back(detail::radialCamera(f, k1, k2));
    bundle.camera_freedom.push_back(detail::radialFreedom());
  } catch (const ArgumentError& error) {
    in.failAt(begin, std::string("begins a camera that cannot be: ") + error.what());
  }
}

void readBundlerViews(TextReader& in, std::uint32_t point, Bundle& bundle) {
  // A view takes 8 bytes at least.
  const auto views = in.below("the length of a list of views", in.rest() / 8 + 2);
  for (std::uint64_t i = 0; i < views; ++i) {
    const char* const begin = in.hasWord() ? in.place() : nullptr;
    const auto pose =
        static_cast<std::uint32_t>(in.below("a camera's number", bundle.T_world_body.size()));
    if (bundle.pose_fixed[pose] != 0) {
      in.failAt(begin, "is a camera that was not registered, expected one that was");
    }
    bundle.observation_key.push_back(
        static_cast<std::uint32_t>(in.below("a feature's number", detail::kMostThings)));
    const double x = in.number("x of a view"), y = in.number("y of a view");
    detail::addObservation(bundle, pose, point, pose, {x, -y});
  }
}

void expectBundlerHeader(TextReader& in) {
  const char* const begin = in.place();
  const std::string_view header = in.restOfLine();
  if (header == kBundlerHeader) return;
  in.throwAt(begin, std::string("expected the line '") + kBundlerHeader + "'");
}

Bundle readBundlerText(TextReader& in) {
  expectBundlerHeader(in);
  in.hasWord();
  const char* const begin = in.place();
  const auto cameras = in.below("the number of cameras", detail::kMostThings);
  const auto points = in.below("the number of points", detail::kMostThings);
  if (30 * cameras + 14 * points > in.rest() + 1) {
    in.throwAt(begin, "the file is too short for " + std::to_string(cameras) + " cameras and " +
                          std::to_string(points) + " points");
  }
  Bundle bundle;
  for (std::uint64_t i = 0; i < cameras; ++i) readBundlerCamera(in, bundle);
  for (std::uint64_t i = 0; i < points; ++i) {
    Vec3d point{};
    for (double& value : point.values) value = in.number("a coordinate of a point");
    bundle.points.push_back(point);
    bundle.colors.push_back(detail::readColor(in));
    readBundlerViews(in, static_cast<std::uint32_t>(i), bundle);
  }
  in.expectEnd();
  return bundle;
}

void writeBundlerCamera(const SE3d& T_world_body, const detail::RadialParameters& parameters,
                        detail::TextWriter& out) {
  const SE3d pose = detail::backwardCameraOfPose(T_world_body);
  const Mat3d r = pose.rotation().matrix();
  const Vec3d& t = pose.translation();
  out << parameters.f << ' ' << parameters.k1 << ' ' << parameters.k2 << '\n';
  for (std::size_t i = 0; i < 3; ++i) {
    out << r(i, 0) << ' ' << r(i, 1) << ' ' << r(i, 2) << '\n';
  }
  out << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
}

}  // namespace

Bundle parseBundler(const std::string& text, const std::string& name) {
  TextReader in(text, name, false);
  return readBundlerText(in);
}

Bundle readBundler(const std::string& path) {
  return parseBundler(detail::readTextFile(path), path);
}

void writeBundler(const Bundle& bundle, const std::string& path) {
  const std::vector<std::uint32_t> camera_of = detail::cameraOfEachPose(bundle, "Bundler");
  std::vector<std::uint8_t> sees_any(camera_of.size(), 0);
  for (const std::uint32_t pose : bundle.observation_pose) sees_any[pose] = 1;
  std::vector<detail::RadialParameters> parameters(camera_of.size());  // f = 0: not registered
  for (std::size_t i = 0; i < camera_of.size(); ++i) {
    const bool is_fixed = !bundle.pose_fixed.empty() && bundle.pose_fixed[i] != 0;
    if (camera_of[i] == IdMap::kNone || (is_fixed && sees_any[i] == 0)) continue;
    parameters[i] =
        detail::radialParametersOf(bundle.cameras[camera_of[i]], camera_of[i], "Bundler");
  }
  const detail::ObservationGroups seen(bundle.observation_point, bundle.points.size());
  detail::TextWriter out(path);
  out << kBundlerHeader << '\n' << camera_of.size() << ' ' << bundle.points.size() << '\n';
  for (std::size_t i = 0; i < camera_of.size(); ++i) {
    if (parameters[i].f == 0) {
      out << "0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n";
    } else {
      writeBundlerCamera(bundle.T_world_body[i], parameters[i], out);
    }
  }
  std::vector<std::uint32_t> keys(camera_of.size(), 0);
  for (std::size_t i = 0; i < bundle.points.size(); ++i) {
    const Vec3d& p = bundle.points[i];
    const Vec3d color = detail::colorOf(bundle, i);
    out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    out << color[0] << ' ' << color[1] << ' ' << color[2] << '\n'
        << seen.begins[i + 1] - seen.begins[i];
    for (std::size_t k = seen.begins[i]; k < seen.begins[i + 1]; ++k) {
      const std::size_t observation = seen.order[k];
      const std::uint32_t pose = bundle.observation_pose[observation];
      const Vec2d pixel = bundle.pixels[observation] - parameters[pose].centre;
      const std::uint32_t key =
          bundle.observation_key.empty() ? keys[pose]++ : bundle.observation_key[observation];
      out << ' ' << pose << ' ' << key << ' ' << pixel[0] << ' ' << -pixel[1];
    }
    out << '\n';
  }
  out.commit();
}

}  // namespace v1
}  // namespace gslam
