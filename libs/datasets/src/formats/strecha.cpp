// Strecha's multi-view benchmark.
//
// C. Strecha et al., "On benchmarking camera calibration and multi-view stereo for high resolution
// imagery", CVPR 2008. <image>.camera has the rows of K, a line of the distortion, which is 0, the
// rows of R, the centre of the camera, and the size of the image; X_camera = R^T (X_world -
// centre). Copies with smaller images have images/K.txt for them.
#include <gslam/base/error.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/datasets/formats.h>
#include <gslam/geometry/nearest_rotation.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../calibration/formats.h"
#include "../reading/file_tree.h"
#include "../reading/looks_like.h"
#include "../reading/second.h"
#include "../reading/sequence.h"
#include "number_file.h"
#include "sequences.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

const char* const kEnding = ".camera";

struct StrechaCamera {
  double fx, fy, cx, cy;
  int width, height;
  SE3d T_world_camera;
};

// Whether all are within a thousandth of a pixel, or their 1e-6th part.
bool isSameModel(const StrechaCamera& a, const StrechaCamera& b) {
  const auto isNear = [](double x, double y) { return std::fabs(x - y) <= 1e-6 * std::fabs(x); };
  return a.width == b.width && a.height == b.height && isNear(a.fx, b.fx) && isNear(a.fy, b.fy) &&
         isNear(a.cx, b.cx) && isNear(a.cy, b.cy);
}

StrechaCamera readCamera(const FileTree& tree, const std::string& file) {
  const std::string source = tree.nameOf(file);
  const std::vector<double> v =
      readNumbers(tree, file, 26, "K (9), 0 0 0, R (9), the centre (3), width and height");
  const std::vector<double> k = intrinsicsOfRows(v, source);
  if (v[9] != 0 || v[10] != 0 || v[11] != 0) {
    throw ParseError(source, 4, 0, "the distortion is not 0 0 0, as it is of Strecha's images");
  }
  Mat3d rotation{};
  for (std::size_t i = 0; i < 9; ++i) rotation.values[i] = v[12 + i];
  const NearestRotation<double> nearest = nearestRotation(rotation);
  if (!(nearest.distance <= kMatrixTolerance)) {
    throw ParseError(source, 5, 0, "rows 5 to 7 are no rotation");
  }
  const bool is_size = v[24] >= 1 && v[24] <= 1e6 && v[25] >= 1 && v[25] <= 1e6 &&
                       v[24] == std::floor(v[24]) && v[25] == std::floor(v[25]);
  if (!is_size) throw ParseError(source, 9, 0, "the size of the image is not two whole numbers");
  return {k[0],
          k[1],
          k[2],
          k[3],
          static_cast<int>(v[24]),
          static_cast<int>(v[25]),
          SE3d(nearest.rotation, {{v[21], v[22], v[23]}})};
}

class StrechaReader {
 public:
  StrechaReader(const std::string& path, const Svar& parameters)
      : tree_(FileTree::open(path)), parameters_(parameters) {
    folder_ = onlyFolder(*tree_, "strecha", "has no <image>.camera");
  }

  std::unique_ptr<Dataset> open() {
    DatasetInfo& info = sequence_.info;
    info.name = folder_.empty() ? tree_->baseName() : nameIn(folder_);
    info.format = "strecha";
    info.licence = "for research; whoever publishes results cites Strecha et al., CVPR 2008";
    info.body = "the camera";
    info.clock = "1 s an image: photos have no stamps here, and no order";
    sequence_.remarks.say("there are no stamps: images are taken to be 1 s apart, by name");
    listImages();
    readCameras();
    addCamera();
    loadImageFiles(sequence_, {tree_, names_});
    return deliver(std::move(sequence_), prefetchOf(parameters_));
  }

 private:
  std::string below(const std::string& name) const { return joined(folder_, name); }

  std::vector<std::string> imagesIn(const std::string& folder) const {
    std::vector<std::string> images;
    for (const std::string& name : tree_->files(folder)) {
      if (isImageName(name)) images.push_back(name);
    }
    return images;
  }

  void listImages() {
    image_folder_ = below("images");
    images_ = imagesIn(image_folder_);
    if (!images_.empty()) return;
    image_folder_ = folder_;
    images_ = imagesIn(image_folder_);
    if (images_.empty()) throw FileError(tree_->nameOf(folder_), "has no images, nor has images/");
  }

  // All frames are of one camera: a photo with another model cannot be among them.
  void readCameras() {
    const std::string folder = strechaCameraFolder(*tree_, folder_);
    for (const std::string& image : images_) {
      const std::string file = joined(folder, image + kEnding);
      const std::int64_t stamp = static_cast<std::int64_t>(sequence_.stamps.size()) * kSecond;
      if (!tree_->has(file)) {
        sequence_.remarks.skip("images without a camera, whose pose is not known", image);
        continue;
      }
      const StrechaCamera camera = readCamera(*tree_, file);
      if (names_.empty()) first_ = camera;
      if (!isSameModel(first_, camera)) {
        sequence_.remarks.skip("images with another camera than the first one's", image);
        continue;
      }
      names_.push_back(joined(image_folder_, image));
      sequence_.stamps.push_back(stamp);
      sequence_.info.ground_truth.add(stamp, camera.T_world_camera);
    }
    if (names_.empty()) throw FileError(tree_->nameOf(folder), "has no .camera of an image");
  }

  void addCamera() {
    const ImageShape shape = shapeOfFile(*tree_, names_[0]);
    const Camera original = Camera::fromParameters("pinhole", first_.width, first_.height,
                                                   {first_.fx, first_.fy, first_.cx, first_.cy});
    const bool is_full_size = shape.width == first_.width && shape.height == first_.height;
    const Camera scaled = is_full_size ? original : original.resized(shape.width, shape.height);
    if (!is_full_size) checkRatio(shape);
    sequence_.info.sensors.cameras.push_back(cameraOf("camera", correctedBy(scaled, shape)));
  }

  void checkRatio(const ImageShape& shape) {
    const double x = double(shape.width) / first_.width, y = double(shape.height) / first_.height;
    sequence_.remarks.say("images are " + std::to_string(shape.width) + " x " +
                          std::to_string(shape.height) + ", cameras for " +
                          std::to_string(first_.width) + " x " + std::to_string(first_.height) +
                          ": they were scaled");
    if (std::fabs(x - y) * shape.width <= 1) return;
    sequence_.remarks.say("the images are not as wide for their height as the cameras say");
  }

  // K.txt is for the images beside it.
  Camera correctedBy(const Camera& scaled, const ImageShape& shape) {
    const std::string file = joined(image_folder_, "K.txt");
    if (!tree_->has(file)) return scaled;
    const Camera given = calibration::makeCamera(
        tree_->nameOf(file), 1, "pinhole", {shape.width, shape.height},
        intrinsicsOfRows(readNumbers(*tree_, file, 9, "the rows of K"), tree_->nameOf(file)));
    const std::vector<double> a = given.parameters(), b = scaled.parameters();
    double most = 0;
    for (std::size_t i = 0; i < 4; ++i) most = std::max(most, std::fabs(a[i] - b[i]));
    if (most > 1) {
      sequence_.remarks.say("K.txt, which was taken, differs from the cameras by up to " +
                            std::to_string(most) + " pixels");
    }
    return given;
  }

  std::shared_ptr<const FileTree> tree_;
  const Svar parameters_;
  std::string folder_;
  std::string image_folder_;
  std::vector<std::string> images_;
  std::vector<std::string> names_;  // of those that become frames
  StrechaCamera first_{};
  Sequence sequence_;
};

}  // namespace
}  // namespace reading

DatasetFactory strechaFactory() {
  DatasetFactory factory;
  factory.name = "strecha";
  factory.description = "Strecha's multi-view benchmark: photos with exact cameras";
  factory.parameters = reading::commonParameters();
  factory.recognizes = reading::recognizesAs("strecha");
  factory.open = [](const std::string& path, const Svar& parameters) {
    return reading::StrechaReader(path, parameters).open();
  };
  return factory;
}

}  // namespace v1
}  // namespace gslam
