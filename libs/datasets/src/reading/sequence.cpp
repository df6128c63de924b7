#include "sequence.h"

#include <gslam/base/error.h>
#include <gslam/core/stamp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <utility>

#include "decode.h"
#include "prefetcher.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

template <class T>
std::vector<std::int64_t> stampsOf(const std::vector<T>& samples) {
  std::vector<std::int64_t> stamps(samples.size());
  std::transform(samples.begin(), samples.end(), stamps.begin(),
                 [](const T& sample) { return sample.stamp; });
  return stamps;
}

std::string secondsOf(std::int64_t nanoseconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g s", double(nanoseconds) * 1e-9);
  return text;
}

// The usual time from one stamp to the next; 0 where there are too few.
std::int64_t usualStep(const std::vector<std::int64_t>& stamps) {
  if (stamps.size() < 2) return 0;
  std::vector<std::int64_t> steps(stamps.size());
  std::adjacent_difference(stamps.begin(), stamps.end(), steps.begin());
  const auto middle = steps.begin() + 1 + (steps.end() - steps.begin() - 1) / 2;
  std::nth_element(steps.begin() + 1, middle, steps.end());
  return *middle;
}

double rateOf(std::int64_t step) {
  return step > 0 ? 1e9 / double(step) : 0;
}

void saySteps(const std::string& things, const std::vector<std::int64_t>& stamps,
              Remarks& remarks) {
  const std::int64_t usual = usualStep(stamps);
  if (usual <= 0 || stamps.size() < 10) return;
  std::size_t gaps = 0, longest = 1;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const std::int64_t step = stamps[i] - stamps[i - 1];
    if (step > 2 * usual) ++gaps;
    if (step > stamps[longest] - stamps[longest - 1]) longest = i;
  }
  if (gaps == 0) return;
  remarks.say("the " + things + " have " + std::to_string(gaps) + (gaps == 1 ? " gap" : " gaps") +
              " of more than twice the usual " + secondsOf(usual) + ", the longest " +
              secondsOf(stamps[longest] - stamps[longest - 1]) + " before number " +
              std::to_string(longest) + " at " + secondsText(stamps[longest]) + " s");
}

void sayOutside(const Sequence& sequence, Remarks& remarks) {
  const std::vector<std::int64_t>& stamps = sequence.stamps;
  const Trajectory& truth = sequence.info.ground_truth;
  if (!truth.empty()) {
    const auto outside = std::count_if(stamps.begin(), stamps.end(), [&](std::int64_t stamp) {
      return stamp < truth.front().stamp || stamp > truth.back().stamp;
    });
    if (outside > 0) {
      remarks.say(std::to_string(outside) + " of " + std::to_string(stamps.size()) +
                  " frames are not in the time of the ground truth, " +
                  secondsText(truth.front().stamp) + " to " + secondsText(truth.back().stamp) +
                  " s");
    }
  }
  const auto later = [&](const auto& samples, const std::string& things) {
    const auto count = std::count_if(samples.begin(), samples.end(), [&](const auto& sample) {
      return sample.stamp > stamps.back();
    });
    if (count > 0) {
      remarks.say(std::to_string(count) + " of " + std::to_string(samples.size()) + " " + things +
                  " come after the last frame, and go out with none");
    }
  };
  later(sequence.imu, "inertial samples");
  later(sequence.gnss, "satellite positions");
}

// So that differences are no larger than a number can be.
void checkSpan(std::int64_t first, std::int64_t last, const std::string& what) {
  const auto span = static_cast<std::uint64_t>(last) - static_cast<std::uint64_t>(first);
  if (span <= std::uint64_t(1) << 62) return;
  throw Error(what + " are from " + secondsText(first) + " to " + secondsText(last) +
              " s, expected less than 146 years");
}

template <class Samples>
void checkSamples(const Samples& samples, const Sequence& sequence, const std::string& what) {
  if (samples.empty()) return;
  checkSpan(std::min(samples.front().stamp, sequence.stamps.front()),
            std::max(samples.back().stamp, sequence.stamps.back()), what);
}

void checkStamps(const Sequence& sequence) {
  const std::vector<std::int64_t>& stamps = sequence.stamps;
  const std::string name = "dataset '" + sequence.info.name + "'";
  if (stamps.empty()) throw Error(name + " has no frame" + sequence.remarks.asReason());
  if (std::adjacent_find(stamps.begin(), stamps.end(), std::greater_equal<>()) != stamps.end()) {
    throw Error("the frames of " + name + " are not in the order of their stamps");
  }
  checkSpan(stamps.front(), stamps.back(), "the frames of " + name);
  checkSamples(sequence.imu, sequence, "frames and inertial samples of " + name);
  checkSamples(sequence.gnss, sequence, "frames and satellite positions of " + name);
}

void complete(Sequence& sequence) {
  checkStamps(sequence);
  const std::vector<std::int64_t>& stamps = sequence.stamps;
  DatasetInfo& info = sequence.info;
  const std::vector<std::int64_t> inertial = stampsOf(sequence.imu);
  const double rate = rateOf(usualStep(stamps));
  for (CameraSensor& camera : info.sensors.cameras) {
    if (camera.rate == 0) camera.rate = rate;
  }
  if (info.sensors.imu.rate == 0) info.sensors.imu.rate = rateOf(usualStep(inertial));
  info.frame_count = stamps.size();
  info.first_stamp = stamps.front();
  info.last_stamp = stamps.back();
  saySteps("frames", stamps, sequence.remarks);
  saySteps("inertial samples", inertial, sequence.remarks);
  sayOutside(sequence, sequence.remarks);
  info.remarks = sequence.remarks.sentences();
}

// Samples after one stamp, up to another.
template <class T>
std::vector<T> samplesBetween(const std::vector<T>& samples, std::int64_t after, bool has_after,
                              std::int64_t last) {
  const auto isBefore = [](std::int64_t stamp, const T& sample) { return stamp < sample.stamp; };
  const auto begin = has_after ? std::upper_bound(samples.begin(), samples.end(), after, isBefore)
                               : samples.begin();
  return std::vector<T>(begin, std::upper_bound(begin, samples.end(), last, isBefore));
}

class SequenceDataset final : public Dataset {
 public:
  SequenceDataset(Sequence sequence, const Prefetch& prefetch)
      : sequence_(std::move(sequence)),
        images_(sequence_.stamps.size(),
                sequence_.in_order ? std::min(prefetch.threads, 1) : prefetch.threads,
                prefetch.frames, [this](std::size_t frame) { return load(frame); }) {}

  const DatasetInfo& info() const override { return sequence_.info; }

  std::shared_ptr<const Frame> next() override {
    const std::size_t index = images_.position();
    if (index == sequence_.stamps.size()) return nullptr;
    const auto frame = std::make_shared<Frame>();
    frame->images = images_.next();  // may throw: the samples go out with the next one then
    frame->id = index;
    frame->stamp = sequence_.stamps[index];
    addSamples(*frame);
    if (!sequence_.priors.empty()) addPrior(sequence_.priors[index], *frame);
    samples_from_ = index + 1;
    return frame;
  }

  void seek(std::size_t index) override {
    if (index > sequence_.stamps.size()) {
      throw ArgumentError("index", "is " + std::to_string(index) + ", but there are " +
                                       std::to_string(sequence_.stamps.size()) + " frames");
    }
    images_.seek(index);
    samples_from_ = index;
  }

 private:
  void addSamples(Frame& frame) const {
    const bool has_before = samples_from_ > 0;
    const std::int64_t before = has_before ? sequence_.stamps[samples_from_ - 1] : 0;
    frame.imu = samplesBetween(sequence_.imu, before, has_before, frame.stamp);
    frame.gnss = samplesBetween(sequence_.gnss, before, has_before, frame.stamp);
    frame.imu_calibration = sequence_.info.sensors.imu;
  }

  static void addPrior(const Prior& prior, Frame& frame) {
    frame.has_prior = prior.is_known;
    if (prior.is_known) frame.prior = prior.pose;
  }

  std::vector<CameraImage> load(std::size_t frame) const {
    const std::vector<CameraSensor>& cameras = sequence_.info.sensors.cameras;
    std::vector<CameraImage> images;
    images.reserve(cameras.size());
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      Image pixels = sequence_.load(frame, i);
      if (pixels.empty()) continue;
      CameraImage image;
      image.image = std::move(pixels);
      image.camera = cameras[i].camera;
      image.T_body_camera = cameras[i].T_body_camera;
      image.depth_scale = cameras[i].depth_scale;
      image.kind = cameras[i].kind;
      image.name = cameras[i].name;
      if (!sequence_.exposures.empty()) {
        image.exposure = sequence_.exposures[frame * cameras.size() + i];
      }
      images.push_back(std::move(image));
    }
    return images;
  }

  const Sequence sequence_;
  std::size_t samples_from_ = 0;  // the first frame whose samples did not go out
  Prefetcher images_;             // its threads call load()
};

template <class Sample>
void sortSamples(std::vector<Sample>& samples, const std::string& file, Remarks& remarks) {
  const auto isBefore = [](const Sample& a, const Sample& b) { return a.stamp < b.stamp; };
  std::size_t late = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (isBefore(samples[i], samples[i - 1])) ++late;
  }
  if (late > 0) {
    remarks.say(std::to_string(late) + " lines of " + file +
                " have an earlier stamp than the line before: they are sorted");
    std::stable_sort(samples.begin(), samples.end(), isBefore);
  }
  const auto isTwin = [&](const Sample& a, const Sample& b) {
    if (a.stamp != b.stamp) return false;
    remarks.skip("samples of " + file + " that have the stamp of another",
                 secondsText(b.stamp) + " s");
    return true;
  };
  samples.erase(std::unique(samples.begin(), samples.end(), isTwin), samples.end());
}

// A camera's model must be for the images that it has.
void checkSize(const CameraSensor& camera, const Image& image, const std::string& name) {
  const bool fits = !camera.camera.isValid() || (camera.camera.width() == image.width() &&
                                                 camera.camera.height() == image.height());
  if (fits) return;
  throw FileError(name, "is " + image.text() + ", but the calibration of camera '" + camera.name +
                            "' is for " + std::to_string(camera.camera.width()) + " x " +
                            std::to_string(camera.camera.height()) + " pixels");
}

void checkDepth(const Image& image, const std::string& name) {
  const bool is_depth =
      image.channels() == 1 && (image.type() == PixelType::u16 || image.type() == PixelType::f32);
  if (is_depth) return;
  throw FileError(name, "is " + image.text() + ", expected depth: one channel of u16 or f32");
}

}  // namespace

Svar commonParameters() {
  const Prefetch standard;
  return Svar::object({{"threads", standard.threads}, {"ahead", standard.frames}});
}

Prefetch prefetchOf(const Svar& parameters) {
  Prefetch prefetch;
  const auto read = [&](const char* name, int least, int most, int& value) {
    value = parameters.get<int>(name, value);
    if (value >= least && value <= most) return;
    throw ArgumentError(name, "is " + std::to_string(value) + ", expected " +
                                  std::to_string(least) + " to " + std::to_string(most));
  };
  read("threads", 0, 256, prefetch.threads);
  read("ahead", 1, 100000, prefetch.frames);
  return prefetch;
}

std::int64_t toleranceOf(const Svar& parameters, double usual, int most) {
  const double seconds = parameters.get<double>("tolerance", usual);
  if (seconds >= 0 && seconds <= most) return std::llround(seconds * 1e9);
  throw ArgumentError("tolerance", "is " + std::to_string(seconds) + ", expected 0 to " +
                                       std::to_string(most) + " seconds");
}

std::unique_ptr<Dataset> deliver(Sequence sequence, const Prefetch& prefetch) {
  complete(sequence);
  return std::unique_ptr<Dataset>(new SequenceDataset(std::move(sequence), prefetch));
}

void loadImageFiles(Sequence& sequence, ImageFiles files) {
  std::vector<CameraSensor>& cameras = sequence.info.sensors.cameras;
  const std::size_t count = cameras.size();
  std::vector<ImageShape> shapes(count);
  for (std::size_t camera = 0; camera < count; ++camera) {
    std::size_t first = camera;
    while (first < files.names.size() && files.names[first].empty()) first += count;
    if (first >= files.names.size()) continue;
    const Image image = readImage(*files.tree, files.names[first]);
    const std::string name = files.tree->nameOf(files.names[first]);
    checkSize(cameras[camera], image, name);
    shapes[camera] = shapeOf(image);
    if (cameras[camera].kind == ImageKind::depth) {
      checkDepth(image, name);
    } else {
      cameras[camera].kind = kindOf(image, name);
    }
  }
  const auto shared = std::make_shared<const ImageFiles>(std::move(files));
  sequence.load = [shared, shapes, count](std::size_t frame, std::size_t camera) {
    const std::string& file = shared->names[frame * count + camera];
    if (file.empty()) return Image();
    return readImage(*shared->tree, file, &shapes[camera]);
  };
}

void sortByStamp(std::vector<ImuSample>& samples, const std::string& file, Remarks& remarks) {
  sortSamples(samples, file, remarks);
}

void sortByStamp(std::vector<GnssSample>& samples, const std::string& file, Remarks& remarks) {
  sortSamples(samples, file, remarks);
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
