#include "tracking/feature_picture.h"

#include <gslam/core/opencv.h>

#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "features/grey_image.h"

namespace visual {
namespace {

using gslam::CameraImage;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

const cv::Scalar kSeesPoint(60, 220, 60);
const cv::Scalar kSeesNothing(150, 150, 150);

const CameraImage* photographAt(const gslam::Frame& frame, const SE3d& T_body_eye) {
  const CameraImage* nearest = nullptr;
  double least = 0;
  for (const CameraImage& image : frame.images) {
    if (!gslam::isPhotographic(image.kind) || image.image.empty()) continue;
    const double distance = (image.T_body_camera.translation() - T_body_eye.translation()).norm();
    if (nearest != nullptr && !(distance < least)) continue;
    nearest = &image;
    least = distance;
  }
  return nearest;
}

// Where pixels of the eye are in the photograph, which may be turned and distorted.
class PixelMap {
 public:
  PixelMap(const Eye& eye, const CameraImage& photograph)
      : eye_(eye),
        photograph_(photograph),
        R_photograph_eye_((photograph.T_body_camera.inverse() * eye.T_body_camera).rotation()) {}

  std::optional<Vec2d> operator()(const Vec2d& pixel) const {
    Vec3d ray;
    Vec2d found;
    if (!eye_.camera.unproject(pixel, ray)) return std::nullopt;
    if (!photograph_.camera.project(R_photograph_eye_ * ray, found)) return std::nullopt;
    return found;
  }

 private:
  const Eye& eye_;
  const CameraImage& photograph_;
  gslam::SO3d R_photograph_eye_;
};

cv::Mat greyOf(const CameraImage& photograph) {
  GreyImage maker(photograph.image.width(), photograph.image.height());
  std::string problem;
  if (!maker.accepts(photograph, problem)) return cv::Mat();
  GreyRange range;
  range.widen(photograph.image);
  cv::Mat picture;
  cv::cvtColor(maker.make(photograph, range), picture, cv::COLOR_GRAY2RGB);
  return picture;
}

}  // namespace

CameraImage drawFeatures(const gslam::Frame& frame, const View& view, const Eye& eye,
                         const Tracked& tracked) {
  CameraImage drawn;
  const CameraImage* const photograph = photographAt(frame, eye.T_body_camera);
  if (photograph == nullptr) return drawn;
  const cv::Mat picture = greyOf(*photograph);
  if (picture.empty()) return drawn;

  std::vector<bool> sees_point(view.size(), false);
  for (const Match& match : tracked.matches) sees_point[match.feature] = true;
  const PixelMap place(eye, *photograph);
  for (std::size_t i = 0; i < view.size(); ++i) {
    const std::optional<Vec2d> at = place(view.pixel(i));
    if (!at.has_value()) continue;
    const cv::Point centre(cvRound((*at)[0]), cvRound((*at)[1]));
    if (sees_point[i]) {
      cv::circle(picture, centre, 3, kSeesPoint, cv::FILLED, cv::LINE_AA);
    } else {
      cv::circle(picture, centre, 2, kSeesNothing, 1, cv::LINE_AA);
    }
  }
  drawn = *photograph;
  drawn.image = gslam::fromOpenCv(picture);
  drawn.kind = gslam::ImageKind::rgb;
  return drawn;
}

}  // namespace visual
