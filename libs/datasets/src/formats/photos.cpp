// Photos from a drone or any other camera, with the positions that their EXIF data have.
#include <gslam/core/geodesy.h>
#include <gslam/datasets/formats.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "../reading/decode.h"
#include "../reading/image_list.h"
#include "../reading/looks_like.h"
#include "../reading/photo_facts.h"
#include "../reading/second.h"
#include "camera_parameters.h"
#include "gnss_samples.h"
#include "natural_order.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr std::int64_t kTwinStep = 1000000;
// What receivers of drones reach, metres and radians, one sigma; EXIF has no field for it.
constexpr double kSigmaAcross = 5, kSigmaUp = 10, kSigmaTurn = 0.1;
constexpr double kFilmWidth = 36;  // millimetres

struct Photo {
  ListedImage image;
  PhotoFacts facts;
};

// Camera to east, north and up: yaw is clockwise from north, pitch up from the horizon, roll
// clockwise as seen from behind the camera.
SO3d gimbalRotation(const PhotoFacts& facts) {
  const double yaw = radiansOfDegrees(facts.gimbal_yaw),
               pitch = radiansOfDegrees(facts.gimbal_pitch),
               roll = radiansOfDegrees(facts.gimbal_roll);
  const Vec3d forward{
      {std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch), std::sin(pitch)}};
  const Vec3d level{{std::cos(yaw), -std::sin(yaw), 0}};
  const Vec3d below = forward.cross(level);
  const Vec3d right = level * std::cos(roll) + below * std::sin(roll);
  const Vec3d down = forward.cross(right);
  Mat3d matrix;
  for (std::size_t i = 0; i < 3; ++i) {
    matrix(i, 0) = right[i];
    matrix(i, 1) = down[i];
    matrix(i, 2) = forward[i];
  }
  return SO3d::fromMatrix(matrix);
}

class Photos {
 public:
  Photos(std::shared_ptr<const FileTree> tree, const std::string& name, Remarks remarks,
         const Svar& parameters)
      : tree_(std::move(tree)), parameters_(parameters) {
    sequence_.remarks = std::move(remarks);
    DatasetInfo& info = sequence_.info;
    info.name = name;
    info.format = "photos";
    info.body = "the camera";
    CameraSensor camera;
    camera.name = "camera";
    info.sensors.cameras.push_back(camera);
  }

  std::unique_ptr<Dataset> open() {
    std::vector<std::string> names = tree_->files("");
    std::sort(names.begin(), names.end(), isBeforeNaturally);
    for (const std::string& name : names) {
      if (isImageName(name)) read(name);
    }
    if (photos_.empty()) throw FileError(tree_->root(), "has no images, expected photos");
    setStamps();
    std::vector<ListedImage> images;
    for (const Photo& photo : photos_) images.push_back(photo.image);
    std::vector<std::string> files = makeFrames(sequence_, {images}, 0);
    addPositions();
    setCamera();
    loadImageFiles(sequence_, {tree_, std::move(files)});
    return deliver(std::move(sequence_), prefetchOf(parameters_));
  }

 private:
  void read(const std::string& name) {
    Photo photo;
    photo.image.file = name;
    try {
      photo.facts = photoFacts(*tree_, name);
    } catch (const FileError& error) {
      sequence_.remarks.skip("photos that cannot be read", error.what());
      return;
    }
    photo.image.exposure = photo.facts.exposure;
    photos_.push_back(photo);
  }

  // The receiver's time, else the camera's, where all photos have it; else one a second.
  void setStamps() {
    const auto all = [&](std::int64_t PhotoFacts::*stamp) {
      return std::all_of(photos_.begin(), photos_.end(),
                         [&](const Photo& photo) { return photo.facts.*stamp != 0; });
    };
    std::int64_t PhotoFacts::*const stamp =
        all(&PhotoFacts::gps_stamp) ? &PhotoFacts::gps_stamp : &PhotoFacts::camera_stamp;
    const bool has_stamps = all(stamp);
    for (std::size_t i = 0; i < photos_.size(); ++i) {
      photos_[i].image.stamp =
          has_stamps ? photos_[i].facts.*stamp : static_cast<std::int64_t>(i) * kSecond;
    }
    if (!has_stamps) {
      sequence_.info.clock = "one photo a second, in the order of their names";
      sequence_.remarks.say("not every photo has a time: they are taken as one a second, by name");
      return;
    }
    sequence_.info.clock = stamp == &PhotoFacts::gps_stamp
                               ? "UTC of the receiver since 1970"
                               : "the camera's clock as if it were UTC, since 1970";
    std::stable_sort(photos_.begin(), photos_.end(),
                     [](const Photo& a, const Photo& b) { return a.image.stamp < b.image.stamp; });
    partTwins();
  }

  // Cameras count whole seconds, and take several photos in one.
  void partTwins() {
    std::size_t twins = 0;
    for (std::size_t i = 1; i < photos_.size(); ++i) {
      std::int64_t& stamp = photos_[i].image.stamp;
      const std::int64_t before = photos_[i - 1].image.stamp;
      if (stamp > before) continue;
      stamp = before + kTwinStep;
      ++twins;
    }
    if (twins == 0) return;
    sequence_.remarks.say(std::to_string(twins) +
                          " photos have the time of another: they are taken as 1 ms later, in the "
                          "order of their names");
  }

  void addPositions() {
    sequence_.priors.resize(photos_.size());
    const auto first = std::find_if(photos_.begin(), photos_.end(),
                                    [](const Photo& photo) { return photo.facts.has_position; });
    if (first == photos_.end()) {
      sequence_.remarks.say("no photo has a position with an altitude");
      return;
    }
    const EnuFrame enu(first->facts.position);
    bool has_gimbal = false;
    for (std::size_t i = 0; i < photos_.size(); ++i) {
      const Photo& photo = photos_[i];
      if (!photo.facts.has_position) {
        sequence_.remarks.skip("positions that lack, have no altitude, or are no fix",
                               photo.image.file);
        continue;
      }
      sequence_.gnss.push_back(gnssSample(photo.image.stamp, photo.facts.position));
      if (!photo.facts.has_gimbal) continue;
      has_gimbal = true;
      sequence_.priors[i] = {true, priorOf(photo.facts, enu)};
    }
    sequence_.info.sensors.has_gnss = true;
    sequence_.remarks.say("altitudes are as EXIF has them, above the sea: nothing is corrected");
    if (!has_gimbal) return;
    sequence_.remarks.say(
        "priors of frames are metres east, north and up of the first photo's position, turned as "
        "the gimbal says; their covariance is a guess (5 m across, 10 m up, 6 degrees)");
  }

  static PoseWithCovariance<SE3d> priorOf(const PhotoFacts& facts, const EnuFrame& enu) {
    const SE3d pose(gimbalRotation(facts), enu.fromGeodetic(facts.position));
    SE3d::Jacobian covariance{};
    for (std::size_t i = 0; i < 6; ++i) {
      const double sigma = i < 2 ? kSigmaAcross : i == 2 ? kSigmaUp : kSigmaTurn;
      covariance(i, i) = sigma * sigma;
    }
    return PoseWithCovariance<SE3d>::fromCovarianceInWorldAxes(pose, covariance);
  }

  void setCamera() {
    CameraSensor& sensor = sequence_.info.sensors.cameras[0];
    const auto shape = [&]() { return shapeOf(readImage(*tree_, photos_.front().image.file)); };
    if (overrideCamera(parameters_, sensor, sequence_.remarks, shape)) return;
    const double focal = photos_.front().facts.focal_length_35mm;
    if (!(focal > 0)) {
      sequence_.remarks.say("the camera is not calibrated; give one with the parameter 'camera'");
      return;
    }
    const ImageShape images = shape();
    const int width = images.width, height = images.height;
    const double pixels = focal / kFilmWidth * std::max(width, height);
    sensor.camera = Camera::fromParameters("pinhole", width, height,
                                           {pixels, pixels, (width - 1) / 2.0, (height - 1) / 2.0});
    sequence_.remarks.say("the camera is a guess from EXIF's focal length of " +
                          std::to_string(std::lround(focal)) + " mm (as of film 36 mm wide), " +
                          photos_.front().facts.camera);
  }

  std::shared_ptr<const FileTree> tree_;
  Svar parameters_;
  std::vector<Photo> photos_;
  Sequence sequence_;
};

std::unique_ptr<Dataset> openPhotos(const std::string& path, const Svar& parameters) {
  std::shared_ptr<const FileTree> tree = FileTree::open(path);
  Remarks remarks;
  const Place place = findImageFolder(*tree, remarks);
  if (!place.is_found) throw FileError(path, "has no images, expected photos");
  const std::string name = tree->baseName();
  return Photos(below(std::move(tree), place.folder), name, std::move(remarks), parameters).open();
}

}  // namespace
}  // namespace reading

DatasetFactory photosFactory() {
  DatasetFactory factory;
  factory.name = "photos";
  factory.description = "Photos with the positions that their EXIF data have, as of drones";
  factory.parameters = reading::commonParameters();
  reading::addCameraParameters(factory.parameters);
  factory.recognizes = reading::recognizesAs(factory.name);
  factory.open = reading::openPhotos;
  return factory;
}

}  // namespace v1
}  // namespace gslam
