#include <gslam/optimizer/files/colmap.h>

#include <limits>

#include "files/bundle_text.h"
#include "files/colmap_cameras.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::TextReader;

constexpr std::int64_t kNoPoint = -1;

// A feature of an image, and the point that it is said to be of.
struct ColmapFeature {
  Vec2d pixel;
  std::int64_t point;
  const char* place;
  bool is_used;  // whether the point says so too
};

struct ColmapImages {
  std::vector<std::uint32_t> camera_of;
  std::vector<std::size_t> begins = {0};  // of features, one more than images
  std::vector<ColmapFeature> features;
};

// Gives an id that is new its index.
std::uint32_t addId(TextReader& in, const char* what, IdMap& ids) {
  const char* const begin = in.hasWord() ? in.place() : nullptr;
  const std::int64_t id = in.integer(what);
  const std::size_t count = ids.size();
  const std::uint32_t index = ids.add(id);
  if (index < count) in.failAt(begin, std::string("is ") + what + " that is there already");
  return index;
}

std::uint32_t indexOfId(TextReader& in, const char* what, const IdMap& ids) {
  const char* const begin = in.hasWord() ? in.place() : nullptr;
  const std::uint32_t index = ids.indexOf(in.integer(what));
  if (index == IdMap::kNone) in.failAt(begin, std::string("is ") + what + " that is not there");
  return index;
}

void readColmapCameras(TextReader& in, Bundle& bundle) {
  constexpr std::uint64_t kMostPixels = std::numeric_limits<int>::max();
  for (; in.hasLine(); in.expectLineEnd()) {
    addId(in, "a camera's id", bundle.camera_ids);
    const detail::ColmapModel* const model = detail::colmapModelNamed(in.word("a camera model"));
    if (model == nullptr) {
      in.fail("is a camera model that is not supported, expected one of " +
              detail::colmapModelNames());
    }
    const char* const begin = in.place();
    in.skipWord();
    const int width = static_cast<int>(in.below("a width", kMostPixels));
    const int height = static_cast<int>(in.below("a height", kMostPixels));
    std::vector<double> values(model->parameters);
    for (double& value : values) value = in.number("a parameter of the camera");
    try {
      bundle.cameras.push_back(detail::cameraOfColmap(*model, width, height, values));
    } catch (const ArgumentError& error) {
      in.failAt(begin, std::string("camera cannot be: ") + error.what());
    }
    bundle.camera_freedom.push_back(detail::freedomOfColmap(*model));
  }
}

SE3d readColmapPose(TextReader& in) {
  const char* const begin = in.hasWord() ? in.place() : nullptr;
  Vec4d q{};
  Vec3d t{};
  for (double& value : q.values) value = in.number("a part of a quaternion");
  for (double& value : t.values) value = in.number("a part of a translation");
  if (!(std::fabs(q.norm() - 1) < 0.1)) {
    in.failAt(begin, "begins a quaternion of norm " + std::to_string(q.norm()) + ", expected 1");
  }
  const SE3d pose = SE3d(SO3d::fromQuaternion(q[1], q[2], q[3], q[0]), t).inverse();
  if (!detail::isFinitePose(pose)) in.failAt(begin, "begins a pose that is too far away");
  return pose;
}

void readColmapFeatures(TextReader& in, ColmapImages& images) {
  while (in.hasWord()) {
    ColmapFeature feature{};
    feature.place = in.place();
    const double x = in.number("x of a feature"), y = in.number("y of a feature");
    feature.pixel = {x - 0.5, y - 0.5};
    feature.point = in.integer("a point's id");
    images.features.push_back(feature);
  }
  images.begins.push_back(images.features.size());
}

ColmapImages readColmapImages(TextReader& in, Bundle& bundle) {
  ColmapImages images;
  while (in.hasLine()) {
    addId(in, "an image's id", bundle.pose_ids);
    bundle.T_world_body.push_back(readColmapPose(in));
    images.camera_of.push_back(indexOfId(in, "a camera's id", bundle.camera_ids));
    if (!in.hasWord()) in.failEnd("the name of an image");
    bundle.image_names.emplace_back(in.restOfLine());
    in.skipLine();
    readColmapFeatures(in, images);  // the next line, be it empty
    in.skipLine();
  }
  return images;
}

void readColmapTrack(TextReader& in, std::uint32_t point, std::int64_t id, ColmapImages& images,
                     Bundle& bundle) {
  while (in.hasWord()) {
    const std::uint32_t image = indexOfId(in, "an image's id", bundle.pose_ids);
    const char* const begin = in.hasWord() ? in.place() : nullptr;
    const std::size_t first = images.begins[image], count = images.begins[image + 1] - first;
    ColmapFeature& feature =
        images.features[first + static_cast<std::size_t>(in.below("a feature's number", count))];
    if (feature.point != id) {
      in.failAt(begin, "is a feature of point " + std::to_string(feature.point) +
                           " in the file of images, expected point " + std::to_string(id));
    }
    if (feature.is_used) in.failAt(begin, "is a feature that this point had already");
    feature.is_used = true;
    detail::addObservation(bundle, image, point, images.camera_of[image], feature.pixel);
  }
}

void readColmapPoints(TextReader& in, ColmapImages& images, Bundle& bundle) {
  for (; in.hasLine(); in.expectLineEnd()) {
    const std::uint32_t point = addId(in, "a point's id", bundle.point_ids);
    Vec3d position{};
    for (double& value : position.values) value = in.number("a coordinate of a point");
    bundle.points.push_back(position);
    bundle.colors.push_back(detail::readColor(in));
    in.number("the error of a point");
    readColmapTrack(in, point, bundle.point_ids.idOf(point), images, bundle);
  }
}

std::string inFolder(const std::string& folder, const char* file) {
  const bool has_slash = folder.empty() || folder.back() == '/';
  return folder + (has_slash ? "" : "/") + file;
}

}  // namespace

Bundle parseColmap(const std::string& cameras, const std::string& images, const std::string& points,
                   const std::string& name) {
  const std::string cameras_name = inFolder(name, "cameras.txt");
  const std::string images_name = inFolder(name, "images.txt");
  const std::string points_name = inFolder(name, "points3D.txt");
  Bundle bundle;
  TextReader camera_reader(cameras, cameras_name, true);
  readColmapCameras(camera_reader, bundle);
  TextReader image_reader(images, images_name, true);
  ColmapImages read = readColmapImages(image_reader, bundle);
  TextReader point_reader(points, points_name, true);
  readColmapPoints(point_reader, read, bundle);
  for (const ColmapFeature& feature : read.features) {
    if (feature.point == kNoPoint || feature.is_used) continue;
    image_reader.failAt(feature.place, "begins a feature of point " +
                                           std::to_string(feature.point) +
                                           ", which does not know of it");
  }
  return bundle;
}

Bundle readColmap(const std::string& folder) {
  return parseColmap(detail::readTextFile(inFolder(folder, "cameras.txt")),
                     detail::readTextFile(inFolder(folder, "images.txt")),
                     detail::readTextFile(inFolder(folder, "points3D.txt")), folder);
}

}  // namespace v1
}  // namespace gslam
