// Views of a pair of cameras, rectified where they are not.
#include <gslam/base/error.h>
#include <gslam/base/parallel.h>
#include <gslam/geometry/rectify.h>
#include <gslam/geometry/undistort.h>

#include <cmath>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <utility>

#include "features/feature_extractor.h"
#include "features/grey_image.h"
#include "features/stereo_matcher.h"
#include "features/view_makers.h"

namespace visual {
namespace {

using gslam::CameraImage;
using gslam::CameraSensor;
using gslam::SE3d;
using gslam::Vec3d;

constexpr double kSameRow = 1e-6;  // radians, and parts of the baseline: both are one row

// One camera of the pair, and all that is done with its images.
class Side {
 public:
  Side(const CameraSensor& sensor, std::size_t camera, const Options& options)
      : camera_(camera),
        name_(sensor.name),
        grey_(sensor.camera.width(), sensor.camera.height()),
        extractor_(makeFeatureExtractor(options.features, options.workers)) {}

  void rectify(const gslam::Camera& camera, const gslam::Camera& rectified,
               const gslam::Mat3d& R_rectified_camera) {
    undistorter_.emplace(camera, rectified, R_rectified_camera.transpose());
    rectified_.create(rectified.height(), rectified.width(), CV_8UC1);
  }

  // The image of a frame, if it can be used.
  const CameraImage* imageIn(const gslam::Frame& frame, std::string& problem) const {
    const CameraImage* const image = imageOf(frame, camera_, name_, problem);
    return image != nullptr && grey_.accepts(*image, problem) ? image : nullptr;
  }

  void extract(const CameraImage& image, const GreyRange& range) {
    const cv::Mat* grey = &grey_.make(image, range);
    if (undistorter_) {
      undistorter_->apply(
          gslam::ImageSpan<const std::uint8_t>{grey->data, grey->cols, grey->rows, 1,
                                               std::ptrdiff_t(grey->step[0])},
          gslam::ImageSpan<std::uint8_t>::dense(rectified_.data, rectified_.cols, rectified_.rows),
          std::uint8_t(0), oneThread());
      grey = &rectified_;
    }
    extractor_->extract(*grey, content.features, content.descriptors);
  }

  StereoSide found() { return {content.features, content.descriptors, extractor_->pyramid()}; }
  std::size_t camera() const noexcept { return camera_; }

  gslam::KeyframeContent content;

 private:
  static gslam::ParallelOptions oneThread() {
    gslam::ParallelOptions options;
    options.threads = 1;
    return options;
  }

  std::size_t camera_;
  std::string name_;
  GreyImage grey_;
  std::optional<gslam::Undistorter> undistorter_;
  cv::Mat rectified_;
  std::unique_ptr<FeatureExtractor> extractor_;
};

bool isRectified(const gslam::Camera& left, const gslam::Camera& right, const SE3d& T_left_right) {
  const Vec3d& t = T_left_right.translation();
  const double least = kSameRow * t[0];
  return left.modelName() == "pinhole" && left == right &&
         T_left_right.rotation().log().norm() < kSameRow && std::fabs(t[1]) <= least &&
         std::fabs(t[2]) <= least;
}

// The one that stands to the left first.
CameraChoice inOrder(const gslam::SensorRig& rig, CameraChoice cameras) {
  const CameraSensor &a = rig.cameras[cameras.first], &b = rig.cameras[cameras.second];
  if ((a.T_body_camera.inverse() * b.T_body_camera).translation()[0] < 0) {
    std::swap(cameras.first, cameras.second);
  }
  return cameras;
}

class StereoMaker : public ViewMaker {
 public:
  StereoMaker(const gslam::SensorRig& rig, const CameraChoice& cameras, const Options& options)
      : workers_(options.workers),
        left_(rig.cameras[cameras.first], cameras.first, options),
        right_(rig.cameras[cameras.second], cameras.second, options),
        eye_(makeEye(rig.cameras[cameras.first], rig.cameras[cameras.second], options)),
        matcher_(eye_.camera.parameter("fx"), eye_.baseline) {}

  const Eye& eye() const noexcept override { return eye_; }

  std::shared_ptr<const View> make(const gslam::Frame& frame, std::string& problem) override {
    const CameraImage* const left = left_.imageIn(frame, problem);
    const CameraImage* const right = left == nullptr ? nullptr : right_.imageIn(frame, problem);
    if (right == nullptr) return nullptr;
    range_.widen(left->image);
    range_.widen(right->image);
    gslam::ParallelOptions threads;
    threads.threads = unsigned(workers_);
    gslam::parallelFor(
        0, 2,
        [&](std::size_t i) {
          i == 0 ? left_.extract(*left, range_) : right_.extract(*right, range_);
        },
        threads);
    std::vector<float> depth, right_u;
    matcher_.match(left_.found(), right_.found(), depth, right_u);
    const auto view = viewOf(frame, std::exchange(left_.content, {}), left_.camera(), eye_);
    view->depth = std::move(depth);
    view->right_u = std::move(right_u);
    return view;
  }

 private:
  Eye makeEye(const CameraSensor& left, const CameraSensor& right, const Options& options) {
    const SE3d T_left_right = left.T_body_camera.inverse() * right.T_body_camera;
    Eye eye;
    eye.kind = SensorKind::stereo;
    eye.camera = left.camera;
    eye.T_body_camera = left.T_body_camera;
    eye.baseline = T_left_right.translation()[0];
    if (!isRectified(left.camera, right.camera, T_left_right)) {
      const auto r = gslam::rectifyStereo(left.camera, right.camera, T_left_right.rotation(),
                                          T_left_right.translation());
      if (r.is_vertical) {
        throw gslam::ArgumentError("sensor", "is stereo, but camera '" + right.name +
                                                 "' stands above or below camera '" + left.name +
                                                 "', expected cameras side by side");
      }
      left_.rectify(left.camera, r.camera, r.R_rectified_left);
      right_.rectify(right.camera, r.camera, r.R_rectified_right);
      eye.camera = r.camera;
      eye.T_body_camera =
          left.T_body_camera *
          SE3d(gslam::SO3d::fromMatrix(r.R_rectified_left.transpose()), Vec3d{0, 0, 0});
      eye.baseline = r.baseline;
    }
    eye.focal = focalOfEye(eye.camera, left.name);
    eye.far = options.mapping.far_baselines * eye.baseline;
    eye.levels = Levels(options.features.scale, options.features.levels);
    return eye;
  }

  int workers_;
  Side left_, right_;
  Eye eye_;
  GreyRange range_;
  StereoMatcher matcher_;
};

}  // namespace

std::unique_ptr<ViewMaker> makeStereo(const gslam::SensorRig& rig, const CameraChoice& cameras,
                                      const Options& options) {
  return std::make_unique<StereoMaker>(rig, inOrder(rig, cameras), options);
}

}  // namespace visual
