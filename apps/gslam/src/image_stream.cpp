#include "image_stream.h"

#include <gslam/core/frame.h>
#include <gslam/core/opencv.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "dataset_option.h"
#include "natural_order.h"
#include "stdout_guard.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using gslam::FileError;
using gslam::ImageKind;

constexpr const char* kExpected = "expected an image, a folder of images or a dataset";

bool hasImageSuffix(const fs::path& path) {
  static const char* const suffixes[] = {".png", ".jpg", ".jpeg", ".bmp",  ".tif", ".tiff",
                                         ".pgm", ".ppm", ".pnm",  ".webp", ".jp2"};
  std::string suffix = path.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(std::begin(suffixes), std::end(suffixes), suffix) != std::end(suffixes);
}

std::vector<std::string> imagesIn(const std::string& folder) {
  std::vector<std::string> images;
  std::error_code problem;
  fs::directory_iterator at(folder, problem);
  if (problem) throw FileError(folder, "cannot be read: " + problem.message());
  for (; at != fs::directory_iterator(); at.increment(problem)) {
    if (hasImageSuffix(at->path()) && at->is_regular_file(problem)) {
      images.push_back(at->path().string());
    }
  }
  std::sort(images.begin(), images.end(), isBefore);
  return images;
}

class Files : public ImageSequence {
 public:
  Files(std::vector<std::string> names, std::size_t every)
      : names_(std::move(names)), every_(every) {}

  bool next(SourceImage& image) override {
    if (at_ >= names_.size()) return false;
    image.name = names_[at_];
    image.pixels.release();
    at_ += std::min(every_, names_.size() - at_);
    return true;
  }
  std::uint64_t count() const override { return (names_.size() + every_ - 1) / every_; }

 private:
  const std::vector<std::string> names_;
  const std::size_t every_;
  std::size_t at_ = 0;
};

// Whether it is a picture of the world as eyes see it.
bool isPicture(ImageKind kind) {
  return kind <= ImageKind::bayer || kind == ImageKind::infrared;
}

cv::Mat brightnessOf(const cv::Mat& pixels, ImageKind kind) {
  static const int codes[] = {-1,
                              cv::COLOR_RGB2GRAY,
                              cv::COLOR_BGR2GRAY,
                              cv::COLOR_RGBA2GRAY,
                              cv::COLOR_BGRA2GRAY,
                              cv::COLOR_BayerBG2GRAY};
  const int code = kind <= ImageKind::bayer ? codes[static_cast<int>(kind)] : -1;
  if (code < 0) return pixels;
  cv::Mat grey;
  cv::cvtColor(pixels, grey, code);
  return grey;
}

// Of a file and of a dataset alike, so that words are the same.
cv::Mat greyOf(const cv::Mat& pixels, ImageKind kind, const std::string& name) {
  if (pixels.depth() != CV_8U && pixels.depth() != CV_16U) {
    throw FileError(name, "has pixels of " + cv::typeToString(pixels.type()) +
                              ", expected 8 or 16 bits without a sign");
  }
  try {
    cv::Mat grey = brightnessOf(pixels, kind);
    if (grey.depth() == CV_16U) grey.convertTo(grey, CV_8U, 255.0 / 65535);
    return grey;
  } catch (const cv::Exception& error) {
    throw FileError(name, "cannot be made grey: " + error.err);
  }
}

// The first camera of a dataset that takes pictures.
class Frames : public ImageSequence {
 public:
  Frames(std::string name, std::unique_ptr<gslam::Dataset> dataset, std::size_t every)
      : name_(std::move(name)), dataset_(std::move(dataset)), every_(every) {
    const gslam::DatasetInfo& info = dataset_->info();
    frame_count_ = info.is_live ? 0 : info.frame_count;
    for (const gslam::CameraSensor& sensor : info.sensors.cameras) {
      if (camera_.empty() && isPicture(sensor.kind)) camera_ = sensor.name;
    }
  }

  bool next(SourceImage& image) override {
    while (const std::shared_ptr<const gslam::Frame> frame = nextFrame()) {
      const gslam::CameraImage* const seen = pictureOf(*frame);
      if (seen == nullptr || seen->image.empty()) continue;
      image.name = name_ + ":" + std::to_string(frame->id);
      image.pixels = greyOf(gslam::toOpenCv(seen->image), seen->kind, image.name);
      return true;
    }
    return false;
  }
  std::uint64_t count() const override { return (frame_count_ + every_ - 1) / every_; }
  bool isLive() const override { return dataset_->info().is_live; }

 private:
  std::shared_ptr<const gslam::Frame> nextFrame() {
    const StdoutGuard guard;  // what plugins print
    if (frame_count_ != 0 && every_ > 1) {
      if (next_ >= frame_count_) return nullptr;
      dataset_->seek(next_);
      next_ += std::min(every_, frame_count_ - next_);
      return dataset_->next();
    }
    for (std::size_t i = 1; i < every_ && !is_first_; ++i) {
      if (dataset_->next() == nullptr) return nullptr;
    }
    is_first_ = false;
    return dataset_->next();
  }

  const gslam::CameraImage* pictureOf(const gslam::Frame& frame) const {
    if (!camera_.empty()) return gslam::findImage(frame, camera_);
    for (const gslam::CameraImage& image : frame.images) {
      if (isPicture(image.kind)) return &image;
    }
    return nullptr;
  }

  const std::string name_;
  const std::unique_ptr<gslam::Dataset> dataset_;
  const std::size_t every_;
  std::size_t frame_count_ = 0;  // 0: not known
  std::string camera_;
  std::size_t next_ = 0;
  bool is_first_ = true;
};

}  // namespace

cv::Mat greyPixels(const SourceImage& image) {
  if (!image.pixels.empty()) return image.pixels;
  cv::Mat pixels;
  try {
    pixels = cv::imread(image.name, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw FileError(image.name, "cannot be decoded as an image: " + error.err);
  }
  if (pixels.empty()) throw FileError(image.name, "cannot be decoded, expected an image");
  const int channels = pixels.channels();
  if (channels == 1) return greyOf(pixels, ImageKind::grey, image.name);
  return greyOf(pixels, channels == 4 ? ImageKind::bgra : ImageKind::bgr, image.name);
}

void ImageStream::declare(Options& options) {
  options.arg<std::size_t>("every", 1, "only each so many-th image of a folder or dataset")
      .range(1, 1000000000)
      .group("What");
  declareDataset(options);
}

ImageStream::ImageStream(const Options& options, const std::vector<std::string>& words)
    : options_(options), every_(options.get<std::size_t>("every")) {
  if (words.empty()) throw gslam::ConfigError("IMAGES", std::string("must be given, ") + kExpected);
  std::vector<std::string> files;
  for (const std::string& word : words) add(word, files);
  endFiles(files);
}

// Files wait until something else comes, so that --every counts all of them.
void ImageStream::endFiles(std::vector<std::string>& files) {
  if (!files.empty()) sequences_.push_back(std::make_unique<Files>(std::move(files), every_));
  files.clear();
}

void ImageStream::add(const std::string& word, std::vector<std::string>& files) {
  std::error_code problem;
  if (!options_.get<std::string>("format").empty()) return addDataset(word, files);
  if (fs::is_directory(word, problem) && addFolder(word, files)) return;
  if (fs::is_regular_file(word, problem) && cv::haveImageReader(word)) {
    files.push_back(word);
    return;
  }
  addDataset(word, files);
}

// False: it is a dataset, or nothing.
bool ImageStream::addFolder(const std::string& word, std::vector<std::string>& files) {
  const std::vector<std::string> images = imagesIn(word);
  if (images.empty()) return false;
  try {
    // These two are for folders of images: but all of one size, or with positions.
    const StdoutGuard guard;
    const std::string kind = findDataset(plugins_, options_, word).factory.name;
    if (kind != "cvmono" && kind != "photos") return false;
  } catch (const FileError&) {
    // nothing else recognizes it
  }
  files.insert(files.end(), images.begin(), images.end());
  return true;
}

void ImageStream::addDataset(const std::string& word, std::vector<std::string>& files) {
  endFiles(files);
  const StdoutGuard guard;  // what plugins print
  std::error_code problem;
  const bool is_there = fs::exists(word, problem);
  const bool is_path = is_there || word.find('/') != std::string::npos;
  const bool is_named = !options_.get<std::string>("format").empty() ||
                        (!is_there && word.find(':') != std::string::npos);
  std::unique_ptr<gslam::FoundDataset> found;
  try {
    found = std::make_unique<gslam::FoundDataset>(findDataset(plugins_, options_, word));
  } catch (const FileError&) {
    if (is_named) throw;
    throw FileError(
        word,
        std::string(is_there ? "is nothing that can be read, " : "does not exist, ") + kExpected);
  } catch (const gslam::Error& error) {
    if (is_named || is_path) throw;
    throw FileError(word, std::string("does not exist, ") + kExpected + "; and " + error.what());
  }
  const gslam::Svar parameters =
      completeOption(found->factory.parameters, options_, "dataset-param");
  sequences_.push_back(
      std::make_unique<Frames>(word, gslam::openDataset(*found, parameters), every_));
}

bool ImageStream::next(SourceImage& image) {
  for (; at_ < sequences_.size(); ++at_) {
    if (sequences_[at_]->next(image)) return true;
  }
  return false;
}

std::uint64_t ImageStream::count() const {
  std::uint64_t all = 0;
  for (const auto& sequence : sequences_) {
    const std::uint64_t count = sequence->count();
    if (count == 0) return 0;
    all += count;
  }
  return all;
}

bool ImageStream::isLive() const {
  return std::any_of(sequences_.begin(), sequences_.end(),
                     [](const auto& sequence) { return sequence->isLive(); });
}

}  // namespace app
