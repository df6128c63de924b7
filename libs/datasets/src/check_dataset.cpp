#include <gslam/base/error.h>
#include <gslam/core/stamp.h>
#include <gslam/datasets/check_dataset.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace {

// What is hardly right of a sensor that stands on the earth.
constexpr double kLeastGravity = 5, kMostGravity = 15;  // m/s^2, as the usual length
constexpr double kMostTurning = 10;                     // rad/s, as the usual length
constexpr double kLeastDepth = 0.02, kMostDepth = 200;  // metres, as the usual depth
constexpr double kMostSpeed = 200;                      // m/s
constexpr std::size_t kMostUnreadable = 1000;           // in a row, where the end is not known

// Complaints, counted by what they say.
class Complaints {
 public:
  void add(const std::string& sentence, const std::string& where) {
    for (Entry& entry : entries_) {
      if (entry.sentence != sentence) continue;
      ++entry.count;
      return;
    }
    entries_.push_back({sentence, where, 1});
  }

  std::vector<std::string> sentences() const {
    std::vector<std::string> all;
    for (const Entry& entry : entries_) {
      std::string text = entry.where.empty() ? entry.sentence : entry.where + ": " + entry.sentence;
      if (entry.count > 1) text += " (and " + std::to_string(entry.count - 1) + " more like it)";
      all.push_back(std::move(text));
    }
    return all;
  }

 private:
  struct Entry {
    std::string sentence, where;
    std::size_t count;
  };
  std::vector<Entry> entries_;
};

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool isFinite(const Vec3d& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

bool isOneColour(const Image& image) {
  const std::size_t pixel = std::size_t(image.channels()) * pixelTypeSize(image.type());
  const std::uint8_t* const first = image.bytes(0);
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* const row = image.bytes(y);
    if (!std::equal(first, first + pixel, row)) return false;
    if (!std::equal(row + pixel, row + image.rowBytes(), row)) return false;
  }
  return true;
}

// Some pixels of a depth image, metres; 0 is none.
void collectDepth(const CameraImage& image, std::vector<double>& depths) {
  const Image& pixels = image.image;
  for (int y = pixels.height() / 8; y < pixels.height(); y += std::max(1, pixels.height() / 8)) {
    for (int x = pixels.width() / 8; x < pixels.width(); x += std::max(1, pixels.width() / 8)) {
      double value = 0;
      if (pixels.type() == PixelType::u16) value = pixels.at<std::uint16_t>(x, y);
      if (pixels.type() == PixelType::f32) value = double(pixels.at<float>(x, y));
      if (value > 0 && std::isfinite(value)) depths.push_back(value * image.depth_scale);
    }
  }
}

class Check {
 public:
  Check(Dataset& dataset, const CheckOptions& options) : dataset_(dataset), options_(options) {
    cameras_.resize(dataset.info().sensors.cameras.size());
  }

  DatasetCheck run() {
    const std::size_t total = dataset_.info().frame_count;
    dataset_.seek(0);
    for (std::size_t done = 0; !isStopped(); ++done) {
      if (!readFrame(done)) break;
      if (options_.progress) options_.progress(done + 1, total);
    }
    if (!result_.is_stopped) compareCounts(total);
    checkUnits();
    checkGroundTruth();
    result_.errors = errors_.sentences();
    result_.warnings = warnings_.sentences();
    return std::move(result_);
  }

 private:
  bool isStopped() {
    result_.is_stopped = options_.stop != nullptr && *options_.stop;
    return result_.is_stopped;
  }

  // Whether there was one, be it that it could not be read.
  bool readFrame(std::size_t place) {
    const std::size_t total = dataset_.info().frame_count;
    const bool is_endless = total > 0 ? place > total : failures_in_a_row_ > kMostUnreadable;
    if (is_endless) return false;
    try {
      const std::shared_ptr<const Frame> frame = dataset_.next();
      if (frame == nullptr) return false;
      failures_in_a_row_ = 0;
      checkFrame(*frame);
    } catch (const FileError& error) {
      addUnreadable(place, std::string(error.what()).substr(error.path().size() + 2), error.path());
    } catch (const std::exception& error) {
      addUnreadable(place, error.what(), "");
    }
    return true;
  }

  // The file stands in the place, so that the same of many is one complaint.
  void addUnreadable(std::size_t place, const std::string& problem, const std::string& file) {
    ++unreadable_;
    ++failures_in_a_row_;
    errors_.add("cannot be read: " + problem,
                "frame " + std::to_string(place) + (file.empty() ? "" : " (" + file + ")"));
  }

  void checkFrame(const Frame& frame) {
    const std::string where =
        "frame " + std::to_string(frame.id) + " at " + secondsText(frame.stamp) + " s";
    if (result_.frames > 0) {
      if (frame.stamp <= result_.last_stamp) {
        errors_.add("its stamp is not after that of the frame before", where);
      }
      if (frame.stamp > result_.last_stamp) {
        result_.longest_step = std::max(result_.longest_step, frame.stamp - result_.last_stamp);
      }
    } else {
      result_.first_stamp = frame.stamp;
    }
    checkSamples(frame, where);
    for (const CameraImage& image : frame.images) checkImage(image, where);
    checkCameras(frame, where);
    ++result_.frames;
    result_.last_stamp = frame.stamp;
  }

  void checkSamples(const Frame& frame, const std::string& where) {
    checkOrder(frame.imu, frame.stamp, "an inertial sample", where);
    checkOrder(frame.gnss, frame.stamp, "a satellite position", where);
    for (const ImuSample& sample : frame.imu) {
      if (!isFinite(sample.gyro) || !isFinite(sample.accel)) {
        errors_.add("an inertial sample has numbers that are not finite", where);
        continue;
      }
      turning_.push_back(sample.gyro.norm());
      gravity_.push_back(sample.accel.norm());
    }
    for (const GnssSample& sample : frame.gnss) {
      const Geodetic& place = sample.position;
      const bool is_place = std::fabs(place.latitude) <= 1.5707964 &&
                            std::fabs(place.longitude) <= 6.2831854 &&
                            std::isfinite(place.altitude);
      if (sample.fix != GnssFix::none && !is_place) {
        errors_.add("a satellite position is no place (radians are expected)", where);
      }
    }
    result_.imu_samples += frame.imu.size();
    result_.gnss_samples += frame.gnss.size();
  }

  template <class Samples>
  void checkOrder(const Samples& samples, std::int64_t stamp, const std::string& what,
                  const std::string& where) {
    std::int64_t before = result_.frames > 0 ? result_.last_stamp : INT64_MIN;
    for (const auto& sample : samples) {
      if (sample.stamp < before || sample.stamp > stamp) {
        errors_.add(what + " is not between it and the frame before, or not in order", where);
      }
      before = sample.stamp;
    }
  }

  void checkImage(const CameraImage& image, const std::string& where) {
    ++result_.images;
    const std::string name = "the image of camera '" + image.name + "'";
    if (image.image.empty()) {
      errors_.add(name + " has no pixels", where);
      return;
    }
    if (image.camera.isValid() && (image.image.width() != image.camera.width() ||
                                   image.image.height() != image.camera.height())) {
      errors_.add(name + " is " + image.image.text() + ", but the camera is calibrated for " +
                      std::to_string(image.camera.width()) + " x " +
                      std::to_string(image.camera.height()),
                  where);
    }
    if (isPhotographic(image.kind) && isOneColour(image.image)) {
      warnings_.add(name + " has one colour everywhere", where);
    }
    if (image.kind == ImageKind::depth) checkDepth(image, name, where);
  }

  void checkDepth(const CameraImage& image, const std::string& name, const std::string& where) {
    const PixelType type = image.image.type();
    if (image.image.channels() != 1 || (type != PixelType::u16 && type != PixelType::f32)) {
      errors_.add(name + " is " + image.image.text() + ", expected one channel of u16 or f32",
                  where);
      return;
    }
    if (!(image.depth_scale > 0)) errors_.add(name + " has no depth scale", where);
    if (isOneColour(image.image)) warnings_.add(name + " is the same everywhere", where);
    collectDepth(image, depths_);
  }

  void checkCameras(const Frame& frame, const std::string& where) {
    const std::vector<CameraSensor>& cameras = dataset_.info().sensors.cameras;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      if (findImage(frame, cameras[i].name) == nullptr) {
        warnings_.add("it has no image of camera '" + cameras[i].name + "'", where);
      } else {
        ++cameras_[i];
      }
    }
  }

  void compareCounts(std::size_t total) {
    const std::size_t read = result_.frames + unreadable_;
    if (total != 0 && read != total) {
      errors_.add(
          "there are " + std::to_string(read) + " frames, but it says " + std::to_string(total),
          "");
    }
    if (result_.frames == 0) errors_.add("no frame can be read", "");
    const DatasetInfo& info = dataset_.info();
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      if (cameras_[i] == 0 && result_.frames > 0) {
        errors_.add("camera '" + info.sensors.cameras[i].name + "' has no image at all", "");
      }
    }
    if (info.sensors.has_imu && result_.imu_samples == 0) {
      errors_.add("it says that it has an inertial unit, but no frame has a sample", "");
    }
    if (info.sensors.has_gnss && result_.gnss_samples == 0) {
      errors_.add("it says that it has satellite positions, but no frame has one", "");
    }
  }

  void checkUnits() {
    const auto complain = [&](const char* what, double median, double least, double most,
                              const char* unit) {
      if (median >= least && median <= most) return;
      warnings_.add(std::string(what) + " is usually " + std::to_string(median) + " " + unit +
                        ": is it of another unit?",
                    "");
    };
    if (!gravity_.empty()) {
      complain("acceleration", medianOf(gravity_), kLeastGravity, kMostGravity, "m/s^2");
      complain("turning", medianOf(turning_), 0, kMostTurning, "rad/s");
    }
    if (!depths_.empty()) complain("depth", medianOf(depths_), kLeastDepth, kMostDepth, "m");
  }

  void checkGroundTruth() {
    const Trajectory& truth = dataset_.info().ground_truth;
    if (truth.empty() || result_.frames == 0) return;
    if (truth.back().stamp < result_.first_stamp || truth.front().stamp > result_.last_stamp) {
      warnings_.add("the ground truth is of another time: " + secondsText(truth.front().stamp) +
                        " to " + secondsText(truth.back().stamp) + " s, the frames " +
                        secondsText(result_.first_stamp) + " to " +
                        secondsText(result_.last_stamp) + " s",
                    "");
    }
    for (const StampedPose& pose : truth) {
      if (isFinite(pose.pose.translation())) continue;
      errors_.add("the pose is not finite", "ground truth at " + secondsText(pose.stamp) + " s");
    }
    for (std::size_t i = 1; i < truth.size(); ++i) {
      const double seconds = (double(truth[i].stamp) - double(truth[i - 1].stamp)) * 1e-9;
      const double metres = (truth[i].pose.translation() - truth[i - 1].pose.translation()).norm();
      if (metres > kMostSpeed * seconds && metres > 0.1) {
        warnings_.add("it jumps faster than " + std::to_string(int(kMostSpeed)) + " m/s",
                      "ground truth at " + secondsText(truth[i].stamp) + " s");
      }
    }
  }

  Dataset& dataset_;
  const CheckOptions& options_;
  DatasetCheck result_;
  Complaints errors_, warnings_;
  std::size_t unreadable_ = 0, failures_in_a_row_ = 0;
  std::vector<std::size_t> cameras_;  // images of each
  std::vector<double> gravity_, turning_, depths_;
};

}  // namespace

DatasetCheck checkDataset(Dataset& dataset, const CheckOptions& options) {
  if (dataset.info().is_live) {
    throw ArgumentError("dataset", "is a device, whose frames have no end: it cannot be checked");
  }
  return Check(dataset, options).run();
}

}  // namespace v1
}  // namespace gslam
