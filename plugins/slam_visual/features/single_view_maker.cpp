// Views of one camera, alone or with a depth camera.
#include <limits>
#include <utility>

#include "features/depth_reader.h"
#include "features/feature_extractor.h"
#include "features/grey_image.h"
#include "features/view_makers.h"

namespace visual {
namespace {

using gslam::CameraImage;
using gslam::CameraSensor;

Eye eyeOf(const CameraSensor& sensor, const Options& options) {
  Eye eye;
  eye.camera = sensor.camera;
  eye.T_body_camera = sensor.T_body_camera;
  eye.focal = focalOfEye(sensor.camera, sensor.name);
  eye.levels = Levels(options.features.scale, options.features.levels);
  return eye;
}

class MonoMaker : public ViewMaker {
 public:
  MonoMaker(const gslam::SensorRig& rig, const CameraChoice& cameras, const Options& options)
      : eye_(eyeOf(rig.cameras[cameras.first], options)),
        camera_(cameras.first),
        name_(rig.cameras[cameras.first].name),
        grey_(eye_.camera.width(), eye_.camera.height()),
        extractor_(makeFeatureExtractor(options.features, options.workers)) {}

  const Eye& eye() const noexcept override { return eye_; }

  std::shared_ptr<const View> make(const gslam::Frame& frame, std::string& problem) override {
    const std::shared_ptr<View> view = find(frame, problem);
    if (view == nullptr) return nullptr;
    view->depth.assign(view->size(), 0);
    view->right_u.assign(view->size(), std::numeric_limits<float>::quiet_NaN());
    return view;
  }

 protected:
  // Without depth.
  std::shared_ptr<View> find(const gslam::Frame& frame, std::string& problem) {
    const CameraImage* const image = imageOf(frame, camera_, name_, problem);
    if (image == nullptr || !grey_.accepts(*image, problem)) return nullptr;
    range_.widen(image->image);
    gslam::KeyframeContent content;
    extractor_->extract(grey_.make(*image, range_), content.features, content.descriptors);
    return viewOf(frame, std::move(content), camera_, eye_);
  }

  Eye eye_;

 private:
  std::size_t camera_;
  std::string name_;
  GreyRange range_;
  GreyImage grey_;
  std::unique_ptr<FeatureExtractor> extractor_;
};

class RgbdMaker : public MonoMaker {
 public:
  RgbdMaker(const gslam::SensorRig& rig, const CameraChoice& cameras, const Options& options)
      : MonoMaker(rig, cameras, options),
        depth_camera_(cameras.second),
        depth_name_(rig.cameras[cameras.second].name),
        reader_(withDepth(eye_, options), rig.cameras[cameras.second].camera,
                rig.cameras[cameras.second].T_body_camera) {}

  std::shared_ptr<const View> make(const gslam::Frame& frame, std::string& problem) override {
    const CameraImage* const image = imageOf(frame, depth_camera_, depth_name_, problem);
    if (image == nullptr || !reader_.accepts(*image, problem)) return nullptr;
    const std::shared_ptr<View> view = find(frame, problem);
    if (view != nullptr) reader_.read(*image, view->features(), view->depth, view->right_u);
    return view;
  }

 private:
  static const Eye& withDepth(Eye& eye, const Options& options) {
    eye.kind = SensorKind::rgbd;
    eye.baseline = options.depth_baseline;
    eye.far = options.mapping.far_baselines * eye.baseline;
    return eye;
  }

  std::size_t depth_camera_;
  std::string depth_name_;
  DepthReader reader_;
};

}  // namespace

std::unique_ptr<ViewMaker> makeMono(const gslam::SensorRig& rig, const CameraChoice& cameras,
                                    const Options& options) {
  return std::make_unique<MonoMaker>(rig, cameras, options);
}

std::unique_ptr<ViewMaker> makeRgbd(const gslam::SensorRig& rig, const CameraChoice& cameras,
                                    const Options& options) {
  return std::make_unique<RgbdMaker>(rig, cameras, options);
}

}  // namespace visual
