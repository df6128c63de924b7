#include <gslam/optimizer/files/colmap.h>

#include <filesystem>

#include "files/bundle_text.h"
#include "files/colmap_cameras.h"
#include "files/text_writer.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::TextWriter;

// Ids of a file: those that are there, else numbers from 1 on, as COLMAP counts.
std::int64_t colmapId(const IdMap& ids, std::size_t index) {
  if (ids.empty()) return static_cast<std::int64_t>(index) + 1;
  return ids.idOf(static_cast<std::uint32_t>(index));
}

void writeColmapCameras(const Bundle& bundle, const std::vector<detail::ColmapCamera>& cameras,
                        TextWriter& out) {
  out << "# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n";
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    out << colmapId(bundle.camera_ids, i) << ' ' << cameras[i].model << ' '
        << bundle.cameras[i].width() << ' ' << bundle.cameras[i].height();
    out.list(cameras[i].values, cameras[i].values.size()) << '\n';
  }
}

// Gives each observation its number in its image.
std::vector<std::size_t> writeColmapImages(const Bundle& bundle,
                                           const std::vector<std::uint32_t>& camera_of,
                                           TextWriter& out) {
  out << "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n# POINTS2D[] as X Y POINT3D_ID\n";
  const detail::ObservationGroups seen(bundle.observation_pose, camera_of.size());
  std::vector<std::size_t> numbers(bundle.pixels.size());
  for (std::size_t i = 0; i < camera_of.size(); ++i) {
    if (camera_of[i] == IdMap::kNone) continue;
    const SE3d pose = bundle.T_world_body[i].inverse();
    const Vec4d& q = pose.rotation().quaternion();
    const std::int64_t id = colmapId(bundle.pose_ids, i);
    out << id << ' ' << q[3];
    out.list(q, 3).list(pose.translation(), 3);
    out << ' ' << colmapId(bundle.camera_ids, camera_of[i]) << ' ';
    if (bundle.image_names.empty() || bundle.image_names[i].empty()) {
      out << "image_" << id << '\n';
    } else {
      out << bundle.image_names[i] << '\n';
    }
    for (std::size_t k = seen.begins[i]; k < seen.begins[i + 1]; ++k) {
      const std::size_t observation = seen.order[k];
      const Vec2d& pixel = bundle.pixels[observation];
      numbers[observation] = k - seen.begins[i];
      if (k != seen.begins[i]) out << ' ';
      out << pixel[0] + 0.5 << ' ' << pixel[1] + 0.5 << ' '
          << colmapId(bundle.point_ids, bundle.observation_point[observation]);
    }
    out << '\n';
  }
  return numbers;
}

// Pixels from where a point is seen to where it should be; none where the camera does not see it.
bool colmapError(const Bundle& bundle, const std::vector<std::uint32_t>& camera_of,
                 std::size_t observation, double& error) {
  const std::uint32_t pose = bundle.observation_pose[observation];
  const Vec3d point =
      bundle.T_world_body[pose].inverse() * bundle.points[bundle.observation_point[observation]];
  Vec2d pixel{};
  if (!bundle.cameras[camera_of[pose]].project(point, pixel)) return false;
  error = (pixel - bundle.pixels[observation]).norm();
  return std::isfinite(error);
}

void writeColmapPoints(const Bundle& bundle, const std::vector<std::uint32_t>& camera_of,
                       const std::vector<std::size_t>& numbers, TextWriter& out) {
  out << "# POINT3D_ID X Y Z R G B ERROR TRACK[] as IMAGE_ID POINT2D_IDX\n";
  const detail::ObservationGroups seen(bundle.observation_point, bundle.points.size());
  for (std::size_t i = 0; i < bundle.points.size(); ++i) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t k = seen.begins[i]; k < seen.begins[i + 1]; ++k) {
      double error = 0;
      if (!colmapError(bundle, camera_of, seen.order[k], error)) continue;
      sum += error;
      ++count;
    }
    out << colmapId(bundle.point_ids, i);
    out.list(bundle.points[i], 3).list(detail::colorOf(bundle, i), 3);
    out << ' ' << (count == 0 ? -1 : sum / static_cast<double>(count));  // COLMAP: -1 is unknown
    for (std::size_t k = seen.begins[i]; k < seen.begins[i + 1]; ++k) {
      const std::size_t observation = seen.order[k];
      out << ' ' << colmapId(bundle.pose_ids, bundle.observation_pose[observation]) << ' '
          << numbers[observation];
    }
    out << '\n';
  }
}

void checkImageNames(const Bundle& bundle) {
  for (std::size_t i = 0; i < bundle.image_names.size(); ++i) {
    if (bundle.image_names[i].find_first_of("\n\r") == std::string::npos) continue;
    throw ArgumentError("image_names[" + std::to_string(i) + "]",
                        "has an end of line, which COLMAP's files cannot hold");
  }
}

}  // namespace

void writeColmap(const Bundle& bundle, const std::string& folder) {
  const std::vector<std::uint32_t> camera_of = detail::cameraOfEachPose(bundle, "COLMAP");
  checkImageNames(bundle);
  std::vector<detail::ColmapCamera> cameras;
  for (std::size_t i = 0; i < bundle.cameras.size(); ++i) {
    // Without freedom nothing is known of the aspect but that it is 1.
    CameraFreedom freedom;
    freedom.keeps_aspect = true;
    if (!bundle.camera_freedom.empty()) freedom = bundle.camera_freedom[i];
    cameras.push_back(detail::colmapCameraOf(bundle.cameras[i], freedom, i));
  }
  const std::filesystem::path place(folder);
  std::error_code error;
  std::filesystem::create_directories(place, error);
  if (error) throw FileError(folder, "cannot be made: " + error.message());
  TextWriter camera_file((place / "cameras.txt").string());
  TextWriter image_file((place / "images.txt").string());
  TextWriter point_file((place / "points3D.txt").string());
  writeColmapCameras(bundle, cameras, camera_file);
  const std::vector<std::size_t> numbers = writeColmapImages(bundle, camera_of, image_file);
  writeColmapPoints(bundle, camera_of, numbers, point_file);
  camera_file.commit();
  image_file.commit();
  point_file.commit();
}

}  // namespace v1
}  // namespace gslam
