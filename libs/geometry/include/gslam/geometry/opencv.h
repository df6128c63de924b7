#ifndef GSLAM_GEOMETRY_OPENCV_H
#define GSLAM_GEOMETRY_OPENCV_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <algorithm>
#include <cstddef>
#include <opencv2/core/affine.hpp>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

/// @file
/// To and from OpenCV's small types, for those who have it. No other header of GSLAM includes this
/// one. Everything is copied.
///
/// The rvec and tvec of solvePnP and calibrateCamera are T_camera_object:
///
///     const gslam::SE3d T_camera_object = gslam::fromRodrigues(cv::Vec3d(rvec), cv::Vec3d(tvec));

namespace gslam {
inline namespace v1 {

/// @{
/// A copy for OpenCV.
/// @param x  what is copied
template <class T, std::size_t N>
cv::Vec<T, static_cast<int>(N)> toOpenCv(const Vec<T, N>& x) {
  return cv::Vec<T, static_cast<int>(N)>(x.values);
}
template <class T, std::size_t R, std::size_t C>
cv::Matx<T, static_cast<int>(R), static_cast<int>(C)> toOpenCv(const Mat<T, R, C>& x) {
  return cv::Matx<T, static_cast<int>(R), static_cast<int>(C)>(x.values);
}
/// The rotation matrix.
template <class T>
cv::Matx<T, 3, 3> toOpenCv(const SO3<T>& x) {
  return toOpenCv(x.matrix());
}
template <class T>
cv::Affine3<T> toOpenCv(const SE3<T>& x) {
  return cv::Affine3<T>(toOpenCv(x.matrix()));
}
/// The rotation vector, axis times angle: rvec.
template <class T>
cv::Vec<T, 3> toRodrigues(const SO3<T>& x) {
  return toOpenCv(x.log());
}
/// @}

/// @{
/// A copy.
/// @param x  what is copied
/// @throws ArgumentError what is no rotation or pose is refused as by the functions from matrices
template <class T, int N>
Vec<T, static_cast<std::size_t>(N)> fromOpenCv(const cv::Vec<T, N>& x) {
  Vec<T, static_cast<std::size_t>(N)> result;
  std::copy(x.val, x.val + N, result.values);
  return result;
}
template <class T, int R, int C>
Mat<T, static_cast<std::size_t>(R), static_cast<std::size_t>(C)> fromOpenCv(
    const cv::Matx<T, R, C>& x) {
  Mat<T, static_cast<std::size_t>(R), static_cast<std::size_t>(C)> result;
  std::copy(x.val, x.val + R * C, result.values);
  return result;
}
template <class T>
Vec<T, 2> fromOpenCv(const cv::Point_<T>& x) {
  return {{x.x, x.y}};
}
template <class T>
Vec<T, 3> fromOpenCv(const cv::Point3_<T>& x) {
  return {{x.x, x.y, x.z}};
}
template <class T>
SE3<T> fromOpenCv(const cv::Affine3<T>& x) {
  return SE3<T>::fromMatrix(fromOpenCv(x.matrix));
}
/// @}

/// The rotation of a rotation vector, as cv::Rodrigues() has it.
/// @param rvec  axis times angle, radians
/// @throws ArgumentError when an element is not finite
template <class T>
SO3<T> fromRodrigues(const cv::Vec<T, 3>& rvec) {
  return SO3<T>::exp(fromOpenCv(rvec));
}
/// The transform x -> R x + t.
/// @param rvec  axis times angle, radians
/// @param tvec  translation
/// @throws ArgumentError when an element of rvec is not finite
template <class T>
SE3<T> fromRodrigues(const cv::Vec<T, 3>& rvec, const cv::Vec<T, 3>& tvec) {
  return SE3<T>(fromRodrigues(rvec), fromOpenCv(tvec));
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_OPENCV_H
