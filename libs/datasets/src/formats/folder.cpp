// Users' own cameras: a folder with dataset.yaml, which libs/datasets/README.md explains.
#include <gslam/core/detail/field_reader.h>
#include <gslam/core/geodesy.h>
#include <gslam/core/parameters.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/datasets/formats.h>
#include <gslam/svar_formats/yaml.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../reading/camera_words.h"
#include "../reading/decode.h"
#include "../reading/image_list.h"
#include "../reading/looks_like.h"
#include "camera_parameters.h"
#include "gnss_samples.h"
#include "natural_order.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr const char* kDescription = "dataset.yaml";

Svar cameraFields() {
  return Svar::object({{"name", ""},
                       {"images", ""},
                       {"camera", ""},
                       {"calibration", ""},
                       {"calibration_camera", 0},
                       {"T_body_camera", Svar::array()},
                       {"kind", ""},
                       {"depth_scale", 0.001},
                       {"rate", 0.0}});
}

// What dataset.yaml may have, with what stands for what it has not.
Svar fields() {
  return Svar::object({{"name", ""},
                       {"licence", ""},
                       {"body", ""},
                       {"clock", ""},
                       {"stamps", "nanoseconds"},
                       {"tolerance", 0.0},
                       {"cameras", Svar::array()},
                       {"imu", Svar::object({{"samples", ""},
                                             {"T_body_imu", Svar::array()},
                                             {"gyro_noise", 0.0},
                                             {"accel_noise", 0.0},
                                             {"gyro_bias_walk", 0.0},
                                             {"accel_bias_walk", 0.0}})},
                       {"gnss", Svar::object({{"samples", ""}, {"antenna", Svar::array()}})},
                       {"ground_truth", ""}});
}

class FolderReader {
 public:
  FolderReader(std::shared_ptr<const FileTree> tree, const Svar& parameters)
      : tree_(std::move(tree)), parameters_(parameters) {
    try {
      description_ = completeParameters(
          fields(), parseYaml(tree_->text(kDescription), tree_->nameOf(kDescription)));
    } catch (const SvarError& error) {
      fail(error.what());
    }
    readUnit();
  }

  std::unique_ptr<Dataset> open() {
    DatasetInfo& info = sequence_.info;
    info.name = description_.get<std::string>("name");
    if (info.name.empty()) info.name = tree_->baseName();
    info.format = "folder";
    info.licence = description_.get<std::string>("licence");
    info.body = description_.get<std::string>("body");
    info.clock = description_.get<std::string>("clock");
    readImu();
    readGnss();
    readGroundTruth();
    std::vector<std::string> names = readCameras();
    loadImageFiles(sequence_, {tree_, std::move(names)});
    return deliver(std::move(sequence_), prefetchOf(parameters_));
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw ParseError(tree_->nameOf(kDescription), 0, 0, problem);
  }

  void readUnit() {
    const std::string name = description_.get<std::string>("stamps");
    for (const StampUnit unit : {StampUnit::nanoseconds, StampUnit::microseconds,
                                 StampUnit::milliseconds, StampUnit::seconds}) {
      if (name == stampUnitName(unit)) {
        unit_ = unit;
        return;
      }
    }
    fail("stamps is '" + name + "', expected nanoseconds, microseconds, milliseconds or seconds");
  }

  std::int64_t readStamp(detail::FieldReader& in) const {
    return in.stamp(stampUnitName(unit_), 3 * static_cast<int>(unit_));
  }

  double finite(double number, const std::string& field) const {
    if (!std::isfinite(number)) fail(field + " has a number that is not finite");
    return number;
  }

  // A number from 0 on, as noise densities are.
  double numberOf(const Svar& object, const std::string& name, const std::string& field) const {
    const double number = finite(object.get<double>(name), field + name);
    if (number < 0) fail(field + name + " is below 0");
    return number;
  }

  // tx ty tz qx qy qz qw, or the rows of a 4 x 4 or 3 x 4 matrix.
  SE3d poseOf(const Svar& value, const std::string& field) const {
    std::vector<double> n;
    try {
      n = value.as<std::vector<double>>();
      if (n.empty()) return SE3d();
      for (const double number : n) finite(number, field);
      if (n.size() == 16 && !(n[12] == 0 && n[13] == 0 && n[14] == 0 && n[15] == 1)) {
        fail(field + " has no 0 0 0 1 at its end, expected a matrix row by row");
      }
      if (n.size() == 7)
        return SE3d(SO3d::fromQuaternion(n[3], n[4], n[5], n[6]), {{n[0], n[1], n[2]}});
      if (n.size() == 12 || n.size() == 16) {
        return SE3d(
            SO3d::fromMatrix(Mat3d{{n[0], n[1], n[2], n[4], n[5], n[6], n[8], n[9], n[10]}}, 1e-3),
            {{n[3], n[7], n[11]}});
      }
    } catch (const Error& error) {
      fail(field + " is no pose: " + error.what());
    }
    fail(field + " has " + std::to_string(n.size()) +
         " numbers, expected tx ty tz qx qy qz qw, or a matrix of 3 or 4 rows of 4");
  }

  Vec3d pointOf(const Svar& value, const std::string& field) const {
    try {
      const auto n = value.as<std::vector<double>>();
      if (n.empty()) return Vec3d{};
      if (n.size() == 3) {
        return Vec3d{{finite(n[0], field), finite(n[1], field), finite(n[2], field)}};
      }
    } catch (const SvarError&) {  // said below
    }
    fail(field + " is no point, expected three numbers");
  }

  std::vector<std::string> readCameras() {
    const Svar list = description_["cameras"];
    if (list.size() == 0) fail("has no cameras, expected a list of at least one");
    std::vector<std::vector<ListedImage>> images;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string field = "cameras." + std::to_string(i);
      Svar camera;
      try {
        camera = completeParameters(cameraFields(), list[i]);
      } catch (const SvarError& error) {
        fail(field + ": " + error.what());
      }
      images.push_back(imagesOf(camera, field));
      sequence_.info.sensors.cameras.push_back(sensorOf(camera, field, i, images.back()));
    }
    return makeFrames(sequence_, images, nanosecondsOf(description_.get<double>("tolerance")));
  }

  std::int64_t nanosecondsOf(double seconds) const {
    if (!(seconds >= 0 && seconds <= 1)) fail("tolerance is not from 0 to 1 second");
    return static_cast<std::int64_t>(seconds * 1e9 + 0.5);
  }

  CameraSensor sensorOf(const Svar& camera, const std::string& field, std::size_t i,
                        const std::vector<ListedImage>& images) {
    CameraSensor sensor;
    sensor.name = camera.get<std::string>("name");
    if (sensor.name.empty()) sensor.name = "camera" + std::to_string(i);
    for (const CameraSensor& other : sequence_.info.sensors.cameras) {
      if (other.name == sensor.name) fail(field + ".name is '" + sensor.name + "' again");
    }
    sensor.rate = numberOf(camera, "rate", field + ".");
    if (sensor.rate != 0 && !(sensor.rate >= 1e-6 && sensor.rate <= 1e6)) {
      fail(field + ".rate is not from 1e-6 to 1e6 images a second");
    }
    const std::string kind = camera.get<std::string>("kind");
    if (kind == "depth") {
      sensor.kind = ImageKind::depth;
      sensor.depth_scale = numberOf(camera, "depth_scale", field + ".");
      if (!(sensor.depth_scale > 0)) fail(field + ".depth_scale is not above 0");
    } else if (!kind.empty()) {
      fail(field + ".kind is '" + kind + "', expected depth, or nothing for other images");
    }
    const std::string words = camera.get<std::string>("camera"),
                      file = camera.get<std::string>("calibration");
    if (!words.empty() && !file.empty()) fail(field + " has both camera and calibration");
    try {
      if (!words.empty()) sensor.camera = cameraOfWords(words);
    } catch (const ArgumentError& error) {
      fail(field + "." + error.what());
    }
    if (!file.empty()) {
      const CameraSensor read = cameraOfFile(tree_->text(file), tree_->nameOf(file),
                                             camera.get<int>("calibration_camera"),
                                             shapeOfFirst(*tree_, images), sequence_.remarks);
      sensor.camera = read.camera;
      sensor.T_body_camera = read.T_body_camera;
    }
    if (camera["T_body_camera"].size() > 0) {
      sensor.T_body_camera = poseOf(camera["T_body_camera"], field + ".T_body_camera");
    }
    return sensor;
  }

  // A list of stamps and files, which are beside it; or a folder, whose files have the stamps as
  // names; or a folder with a rate.
  std::vector<ListedImage> imagesOf(const Svar& camera, const std::string& field) {
    const std::string name = joined("", camera.get<std::string>("images"));
    if (name.empty()) fail(field + ".images is missing, expected a list or a folder");
    std::vector<ListedImage> images;
    if (tree_->has(name)) {
      images = readImageList(*tree_, name, unit_, folderOf(name));
    } else if (tree_->hasFolder(name)) {
      images = imagesIn(name, camera.get<double>("rate"));
    } else {
      fail(field + ".images is '" + name + "', which does not exist");
    }
    if (images.empty()) throw FileError(tree_->nameOf(name), "has no images");
    tidy(images, *tree_, name, sequence_.remarks);
    return images;
  }

  std::vector<ListedImage> imagesIn(const std::string& folder, double rate) const {
    std::vector<std::string> names = tree_->files(folder);
    std::sort(names.begin(), names.end(), isBeforeNaturally);
    std::vector<ListedImage> images;
    for (const std::string& name : names) {
      if (!isImageName(name)) continue;
      ListedImage image;
      image.file = joined(folder, name);
      image.stamp = rate > 0 ? static_cast<std::int64_t>(double(images.size()) * 1e9 / rate + 0.5)
                             : stampOfName(image.file);
      images.push_back(std::move(image));
    }
    return images;
  }

  std::int64_t stampOfName(const std::string& file) const {
    const std::string name = nameIn(file);
    try {
      return parseStamp(name.substr(0, name.rfind('.')), unit_);
    } catch (const Error& error) {
      throw FileError(tree_->nameOf(file), std::string("its name is no stamp (") + error.what() +
                                               "); a list, or a rate, would do");
    }
  }

  void readImu() {
    const Svar imu = description_["imu"];
    const std::string file = imu.get<std::string>("samples");
    if (file.empty()) return;
    SensorRig& rig = sequence_.info.sensors;
    rig.has_imu = true;
    rig.imu.T_body_imu = poseOf(imu["T_body_imu"], "imu.T_body_imu");
    rig.imu.gyro_noise = numberOf(imu, "gyro_noise", "imu.");
    rig.imu.accel_noise = numberOf(imu, "accel_noise", "imu.");
    rig.imu.gyro_bias_walk = numberOf(imu, "gyro_bias_walk", "imu.");
    rig.imu.accel_bias_walk = numberOf(imu, "accel_bias_walk", "imu.");
    const std::string text = tree_->text(file), name = tree_->nameOf(file);
    detail::FieldReader in(text, name, "stamp, gyro x y z (rad/s), acceleration x y z (m/s^2)");
    while (in.nextLine()) {
      ImuSample sample;
      sample.stamp = readStamp(in);
      for (std::size_t i = 0; i < 3; ++i) sample.gyro[i] = in.number("gyro");
      for (std::size_t i = 0; i < 3; ++i) sample.accel[i] = in.number("acceleration");
      in.endLine();
      sequence_.imu.push_back(sample);
    }
    sortByStamp(sequence_.imu, file, sequence_.remarks);
  }

  void readGnss() {
    const Svar gnss = description_["gnss"];
    const std::string file = gnss.get<std::string>("samples");
    if (file.empty()) return;
    sequence_.info.sensors.has_gnss = true;
    sequence_.info.sensors.gnss_antenna = pointOf(gnss["antenna"], "gnss.antenna");
    const std::string text = tree_->text(file), name = tree_->nameOf(file);
    detail::FieldReader in(text, name,
                           "stamp, latitude, longitude (degrees), altitude, and perhaps "
                           "sigmas east, north, up (m)");
    while (in.nextLine()) {
      const char* const at = in.place();
      const std::int64_t stamp = readStamp(in);
      const double latitude = in.number("latitude"), longitude = in.number("longitude"),
                   altitude = in.number("altitude");
      if (!isPlace(latitude, longitude)) in.fail(at, "is no place, expected degrees");
      GnssSample sample = gnssSample(stamp, geodeticOfDegrees(latitude, longitude, altitude));
      const bool has_sigmas = !in.isLineEnd();
      for (std::size_t i = 0; i < 3 && has_sigmas; ++i) {
        const char* const sigma_at = in.place();
        const double sigma = in.number("sigma");
        if (!(sigma > 0)) in.fail(sigma_at, "a sigma is not above 0");
        sample.covariance(i, i) = sigma * sigma;
      }
      in.endLine();
      sequence_.gnss.push_back(sample);
    }
    sortByStamp(sequence_.gnss, file, sequence_.remarks);
  }

  void readGroundTruth() {
    const std::string file = description_.get<std::string>("ground_truth");
    if (file.empty()) return;
    TrajectoryFileOptions options;
    options.duplicates = DuplicateStamps::keep_first;
    sequence_.info.ground_truth = parseTrajectory(tree_->text(file), tree_->nameOf(file), options);
  }

  std::shared_ptr<const FileTree> tree_;
  Svar parameters_, description_;
  StampUnit unit_ = StampUnit::nanoseconds;
  Sequence sequence_;
};

std::unique_ptr<Dataset> openDescribedFolder(const std::string& path, const Svar& parameters) {
  std::shared_ptr<const FileTree> tree = FileTree::open(path);
  const Place place = findFolder(*tree, 1, [](const FileTree& files, const std::string& folder) {
    return files.has(joined(folder, kDescription));
  });
  if (!place.is_found) throw FileError(tree->root(), "has no dataset.yaml, expected one");
  return FolderReader(below(std::move(tree), place.folder), parameters).open();
}

}  // namespace
}  // namespace reading

DatasetFactory folderFactory() {
  DatasetFactory factory;
  factory.name = "folder";
  factory.description = "Your own cameras: a folder that dataset.yaml describes";
  factory.parameters = reading::commonParameters();
  factory.recognizes = reading::recognizesAs(factory.name);
  factory.open = reading::openDescribedFolder;
  return factory;
}

}  // namespace v1
}  // namespace gslam
