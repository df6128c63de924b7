// One camera: whatever OpenCV opens.
//
//     a folder or archive of images, in natural order of their names: frame2.png before frame10.png
//     a pattern of names, cvmono:/data/*.jpg
//     a video, a number of a device (cvmono:0), a device file, an address (cvmono:rtsp://...)
#include <gslam/base/log_hook.h>
#include <gslam/core/opencv.h>
#include <gslam/datasets/formats.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <mutex>
#include <opencv2/videoio.hpp>
#include <opencv2/videoio/registry.hpp>
#include <utility>

#include "../reading/decode.h"
#include "../reading/image_list.h"
#include "../reading/looks_like.h"
#include "camera_parameters.h"
#include "natural_order.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr double kUsualVideoRate = 30;
constexpr double kLeastRate = 1e-6, kMostRate = 1e6;
constexpr double kMostFrames = 1e7;

struct Options {
  double rate = 0;  // frames a second; 0: as the video says, else kUsualVideoRate
  int every = 1;    // takes each such frame
  Svar parameters;
};

Options optionsOf(const Svar& parameters) {
  Options options;
  options.rate = parameters.get<double>("rate", 0);
  options.every = parameters.get<int>("every", 1);
  options.parameters = parameters;
  const bool is_rate = options.rate >= kLeastRate && options.rate <= kMostRate;
  if (!is_rate && options.rate != 0) {
    throw ArgumentError("rate", "is not from 1e-6 to 1e6 frames a second, nor 0 (as it is stated)");
  }
  if (options.every < 1) {
    throw ArgumentError("every", "is " + std::to_string(options.every) + ", expected 1 or more");
  }
  return options;
}

/// @param shape  of the images, see overrideCamera()
DatasetInfo infoOf(const std::string& name, const Options& options, Remarks& remarks,
                   const std::function<ImageShape()>& shape) {
  DatasetInfo info;
  info.name = name;
  info.format = "cvmono";
  info.body = "the camera";
  CameraSensor camera;
  camera.name = "camera";
  if (!overrideCamera(options.parameters, camera, remarks, shape)) {
    remarks.say("the camera is not calibrated; give one with the parameter 'camera'");
  }
  info.sensors.cameras.push_back(camera);
  return info;
}

// Of a video or device, which may not say it.
ImageShape sizeOnly(int width, int height) {
  ImageShape shape;
  if (width > 0 && height > 0) {
    shape.width = width;
    shape.height = height;
  }
  return shape;
}

std::int64_t stampAt(std::size_t frame, double rate) {
  return static_cast<std::int64_t>(std::llround(double(frame) * 1e9 / rate));
}

// A calibration must be for the images that there are.
void checkCamera(const CameraSensor& sensor, int width, int height, const std::string& name) {
  if (!sensor.camera.isValid()) return;
  if (sensor.camera.width() == width && sensor.camera.height() == height) return;
  throw FileError(name, "has images of " + std::to_string(width) + " x " + std::to_string(height) +
                            " pixels, but the camera is calibrated for " +
                            std::to_string(sensor.camera.width()) + " x " +
                            std::to_string(sensor.camera.height()));
}

// --- images ---

std::unique_ptr<Dataset> openImages(std::shared_ptr<const FileTree> tree,
                                    std::vector<std::string> names, const std::string& title,
                                    Remarks remarks, const Options& options) {
  std::sort(names.begin(), names.end(), isBeforeNaturally);
  Sequence sequence;
  sequence.remarks = std::move(remarks);
  sequence.info = infoOf(title, options, sequence.remarks,
                         [&]() { return shapeOf(readImage(*tree, names.front())); });
  const double rate = options.rate > 0 ? options.rate : kUsualVideoRate;
  sequence.info.clock = "the number of the image, by the rate";
  if (options.rate <= 0) sequence.remarks.say("images have no stamps: taken as 30 a second");
  ImageFiles files{std::move(tree), {}};
  for (std::size_t i = 0; i < names.size(); i += static_cast<std::size_t>(options.every)) {
    sequence.stamps.push_back(stampAt(i, rate));
    files.names.push_back(names[i]);
  }
  loadImageFiles(sequence, std::move(files));
  return deliver(std::move(sequence), prefetchOf(options.parameters));
}

bool matches(const char* name, const char* pattern) {
  for (; *pattern != '\0'; ++name, ++pattern) {
    if (*pattern == '*') {
      for (;; ++name) {
        if (matches(name, pattern + 1)) return true;
        if (*name == '\0') return false;
      }
    }
    if (*name == '\0' || (*pattern != '?' && *pattern != *name)) return false;
  }
  return *name == '\0';
}

std::unique_ptr<Dataset> openPattern(const std::string& path, const Options& options) {
  const std::string folder = folderOf(path), pattern = nameIn(path);
  const std::string root = folder.empty() ? (path[0] == '/' ? "/" : ".") : folder;
  std::shared_ptr<const FileTree> tree = FileTree::open(root);
  std::vector<std::string> names;
  for (const std::string& name : tree->files("")) {
    if (isImageName(name) && matches(name.c_str(), pattern.c_str())) names.push_back(name);
  }
  if (names.empty()) throw FileError(path, "matches no image, expected png, jpg or others");
  const std::string title = tree->baseName();
  return openImages(std::move(tree), std::move(names), title, Remarks(), options);
}

std::unique_ptr<Dataset> openImageFolder(const std::string& path, const Options& options) {
  std::shared_ptr<const FileTree> tree = FileTree::open(path);
  Remarks remarks;
  const Place place = findImageFolder(*tree, remarks);
  if (!place.is_found) throw FileError(path, "has no images, expected png, jpg or others");
  const std::string title = tree->baseName();
  tree = below(std::move(tree), place.folder);
  std::vector<std::string> names = tree->files("");
  names.erase(std::remove_if(names.begin(), names.end(),
                             [](const std::string& name) { return !isImageName(name); }),
              names.end());
  return openImages(std::move(tree), std::move(names), title, std::move(remarks), options);
}

// --- videos ---

// A video, read frame by frame; a jump decodes what is between, or from the key frame before.
class Video {
 public:
  Video(std::string path, int every) : path_(std::move(path)), every_(every) {
    if (open()) return;
    throw FileError(path_, "cannot be opened as a video, nor as anything else that OpenCV reads");
  }

  double get(cv::VideoCaptureProperties property) const { return capture_.get(property); }

  /// @param is_last  whether the video says that there is none after it
  Image load(std::size_t frame, bool is_last) {
    const std::lock_guard<std::mutex> lock(mutex_);
    try {
      Image image = read(frame * static_cast<std::size_t>(every_));
      if (is_last && every_ == 1) sayEnd();
      return image;
    } catch (const cv::Exception& error) {
      throw FileError(path_, "frame " + std::to_string(frame) + " cannot be decoded: " + error.err);
    }
  }

 private:
  static constexpr std::size_t kMostSkipped = 100;

  // Other backends complain on stderr of files that are not theirs.
  bool open() {
    const bool has_ffmpeg = cv::videoio_registry::hasBackend(cv::CAP_FFMPEG);
    next_ = 0;
    return capture_.open(path_, has_ffmpeg ? cv::CAP_FFMPEG : cv::CAP_ANY);
  }

  Image read(std::size_t wanted) {
    if (wanted < next_ || wanted > next_ + kMostSkipped) jumpTo(wanted);
    for (; next_ < wanted; ++next_) {
      if (!capture_.grab()) fail(next_);
    }
    cv::Mat pixels;
    if (!capture_.read(pixels)) fail(next_);
    ++next_;
    Image image = fromOpenCv(pixels.clone());  // the decoder writes its own memory again
    if (!has_shape_) shape_ = shapeOf(image);
    has_shape_ = true;
    checkShape(image, shape_, path_);
    return image;
  }

  // Where it does not land on the frame, it goes there from the beginning.
  void jumpTo(std::size_t frame) {
    const bool is_there =
        capture_.set(cv::CAP_PROP_POS_FRAMES, double(frame)) &&
        std::llround(capture_.get(cv::CAP_PROP_POS_FRAMES)) == static_cast<long long>(frame);
    if (is_there) {
      next_ = frame;
    } else if (!open()) {
      fail(frame);
    }
  }

  void sayEnd() {
    if (is_end_known_) return;
    is_end_known_ = true;
    if (!capture_.grab()) return;
    ++next_;
    detail::logParts(LogLevel::warning, __FILE__, __LINE__,
                     {path_.c_str(), " goes on after the number of frames that it states"});
  }

  [[noreturn]] void fail(std::size_t frame) {
    next_ = frame + 1;
    throw FileError(path_, "frame " + std::to_string(frame) +
                               " cannot be decoded: the video ends early, or is damaged");
  }

  std::string path_;
  int every_;
  std::mutex mutex_;
  cv::VideoCapture capture_;
  std::size_t next_ = 0;
  ImageShape shape_;
  bool has_shape_ = false, is_end_known_ = false;
};

// How many frames it states; a frame takes a byte at least.
std::size_t frameCount(const Video& video, const std::string& path) {
  const double count = video.get(cv::CAP_PROP_FRAME_COUNT);
  std::error_code unknown;
  const double bytes = double(std::filesystem::file_size(path, unknown));
  if (count >= 1 && count <= kMostFrames && (unknown || count <= bytes)) return std::size_t(count);
  throw FileError(path, "does not say how many frames it has, or too many, expected a video file");
}

std::unique_ptr<Dataset> openVideo(const std::string& path, const Options& options) {
  Sequence sequence;
  const std::string name = nameIn(path);
  const auto video = std::make_shared<Video>(path, options.every);
  const int width = int(video->get(cv::CAP_PROP_FRAME_WIDTH)),
            height = int(video->get(cv::CAP_PROP_FRAME_HEIGHT));
  sequence.info = infoOf(name.substr(0, name.rfind('.')), options, sequence.remarks,
                         [&]() { return sizeOnly(width, height); });
  double rate = options.rate;
  if (rate <= 0) {
    rate = video->get(cv::CAP_PROP_FPS);
    sequence.info.clock = "time from the start, by the rate that the video states";
  } else {
    sequence.info.clock = "the number of the frame, by the rate";
  }
  if (!(rate > 0 && rate < 1e6)) {
    rate = kUsualVideoRate;
    sequence.remarks.say("the video does not say how many frames it has a second: taken as 30");
  }
  const std::size_t count = frameCount(*video, path);
  checkCamera(sequence.info.sensors.cameras[0], width, height, path);
  sequence.info.sensors.cameras[0].kind = ImageKind::bgr;
  for (std::size_t i = 0; i < count; i += static_cast<std::size_t>(options.every)) {
    sequence.stamps.push_back(stampAt(i, rate));
  }
  const std::size_t last = sequence.stamps.size() - 1;
  sequence.load = [video, last](std::size_t frame, std::size_t) {
    return video->load(frame, frame == last);
  };
  sequence.in_order = true;
  return deliver(std::move(sequence), prefetchOf(options.parameters));
}

// --- devices ---

class Device final : public Dataset {
 public:
  Device(const std::string& what, cv::VideoCapture capture, const Options& options)
      : capture_(std::move(capture)), what_(what), every_(options.every) {
    Remarks remarks;
    const int width = int(capture_.get(cv::CAP_PROP_FRAME_WIDTH)),
              height = int(capture_.get(cv::CAP_PROP_FRAME_HEIGHT));
    info_ = infoOf(what, options, remarks, [&]() { return sizeOnly(width, height); });
    info_.clock = "POSIX time at which the image arrived";
    info_.is_live = true;
    info_.sensors.cameras[0].kind = ImageKind::bgr;
    info_.sensors.cameras[0].rate = std::max(0.0, capture_.get(cv::CAP_PROP_FPS));
    checkCamera(info_.sensors.cameras[0], width, height, what);
    info_.remarks = remarks.sentences();
  }

  const DatasetInfo& info() const override { return info_; }

  std::shared_ptr<const Frame> next() override {
    cv::Mat pixels;
    for (int i = 0; i < every_; ++i) {
      if (!capture_.read(pixels) || pixels.empty()) return nullptr;  // unplugged, or closed
    }
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto frame = std::make_shared<Frame>();
    frame->id = next_id_++;
    frame->stamp = std::max<std::int64_t>(
        last_stamp_ + 1, std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
    last_stamp_ = frame->stamp;
    CameraImage image;
    image.image = fromOpenCv(pixels.clone());
    image.kind = kindOf(image.image, what_);
    image.camera = info_.sensors.cameras[0].camera;
    image.name = info_.sensors.cameras[0].name;
    frame->images.push_back(std::move(image));
    return frame;
  }

  void seek(std::size_t) override { throw Error(what_ + " is a device: it cannot be wound"); }

 private:
  cv::VideoCapture capture_;
  std::string what_;
  int every_;
  DatasetInfo info_;
  std::uint64_t next_id_ = 0;
  std::int64_t last_stamp_ = 0;
};

std::unique_ptr<Dataset> openDevice(const std::string& what, const Options& options) {
  const bool is_number =
      what.size() < 4 && what.find_first_not_of("0123456789") == std::string::npos;
  cv::VideoCapture capture;
  const bool is_open = is_number ? capture.open(std::stoi(what)) : capture.open(what);
  if (!is_open) throw Error("cvmono: camera '" + what + "' cannot be opened");
  return std::unique_ptr<Dataset>(new Device(what, std::move(capture), options));
}

// --- which of them ---

bool isDevice(const std::string& path) {
  const bool is_number =
      path.size() < 4 && path.find_first_not_of("0123456789") == std::string::npos;
  const bool is_address = path.find("://") != std::string::npos;
  return !path.empty() && (is_number || is_address || path.compare(0, 5, "/dev/") == 0);
}

std::unique_ptr<Dataset> openCvMono(const std::string& path, const Svar& parameters) {
  const Options options = optionsOf(parameters);
  if (isFolderOrArchive(path)) return openImageFolder(path, options);  // be its name a number
  if (isDevice(path)) return openDevice(path, options);
  if (nameIn(path).find_first_of("*?") != std::string::npos) return openPattern(path, options);
  return openVideo(path, options);
}

}  // namespace
}  // namespace reading

DatasetFactory cvMonoFactory() {
  DatasetFactory factory;
  factory.name = "cvmono";
  factory.description = "One camera: folders and patterns of images, videos, devices (OpenCV)";
  factory.parameters = reading::commonParameters();
  factory.parameters.set("rate", 0.0);
  factory.parameters.set("every", 1);
  reading::addCameraParameters(factory.parameters);
  factory.recognizes = reading::recognizesAs(factory.name);
  factory.open = reading::openCvMono;
  return factory;
}

}  // namespace v1
}  // namespace gslam
