// Instantiates the templates of GSLAM::geometry; compiled alone under every compiler and standard
// by tests/headers.
#include <gslam/geometry.h>
#include <gslam/geometry/batch.h>
#include <gslam/geometry/undistort.h>

#include <cstdint>
#include <ostream>
#include <vector>

template struct gslam::Vec<float, 2>;
template struct gslam::Vec<float, 3>;
template struct gslam::Vec<double, 3>;
template struct gslam::Vec<double, 4>;
template struct gslam::Mat<float, 3, 3>;
template struct gslam::Mat<double, 3, 3>;
template struct gslam::Mat<double, 3, 4>;
template class gslam::SO3<float>;
template class gslam::SO3<double>;
template class gslam::SE3<float>;
template class gslam::SE3<double>;
template class gslam::SIM3<float>;
template class gslam::SIM3<double>;

template class gslam::SO2<float>;
template class gslam::SO2<double>;
template class gslam::SE2<float>;
template class gslam::SE2<double>;
template class gslam::Spline<gslam::SE3d>;
template class gslam::PoseWithCovariance<gslam::SE3d>;

template gslam::SO3<float> gslam::SO3<double>::cast<float>() const;
template gslam::SE3<float> gslam::SE3<double>::cast<float>() const;
template gslam::SIM3<double> gslam::SIM3<float>::cast<double>() const;

// Kernels and function templates.
void instantiateBatches(std::vector<gslam::SE3d>& poses, std::vector<gslam::SO3f>& rotations);

void instantiateBatches(std::vector<gslam::SE3d>& poses, std::vector<gslam::SO3f>& rotations) {
  std::vector<gslam::Vec<double, 6>> tangents(poses.size());
  const gslam::Span<const gslam::SE3d> in(poses.data(), poses.size());
  const gslam::Span<gslam::SE3d> out(poses.data(), poses.size());
  gslam::composeMany<gslam::SE3d>(in, in, out);
  gslam::logMany<gslam::SE3d>(in, gslam::Span<gslam::Vec<double, 6>>(tangents.data(), 1));
  gslam::expMany<gslam::SE3d>(gslam::Span<const gslam::Vec<double, 6>>(tangents.data(), 1), out);
  gslam::inverseMany<gslam::SO3f>(
      gslam::Span<const gslam::SO3f>(rotations.data(), rotations.size()),
      gslam::Span<gslam::SO3f>(rotations.data(), rotations.size()));
}

double instantiateFunctions(std::vector<gslam::SE3d>& poses);

double instantiateFunctions(std::vector<gslam::SE3d>& poses) {
  const gslam::Mean<gslam::SE3d> mean = gslam::mean(poses);
  const gslam::SE3d middle =
      gslam::interpolate(poses[0], gslam::fromText<gslam::SE3d>(gslam::toText(poses[1])), 0.5);
  const auto nearest = gslam::nearestRotation(middle.rotation().matrix());
  return gslam::geodesicDistance(mean.value, middle) + gslam::rollPitchYawOf(nearest.rotation)[0];
}

template <class T>
void instantiateUndistorter(const gslam::Camera& camera, std::vector<T>& image) {
  const gslam::Undistorter undistorter(camera, camera);
  undistorter.apply(gslam::ImageSpan<const T>::dense(image.data(), 2, 2),
                    gslam::ImageSpan<T>::dense(image.data(), 2, 2));
}
template void instantiateUndistorter(const gslam::Camera&, std::vector<std::uint8_t>&);
template void instantiateUndistorter(const gslam::Camera&, std::vector<std::uint16_t>&);
template void instantiateUndistorter(const gslam::Camera&, std::vector<float>&);

template class gslam::FocalCamera<gslam::DoubleSphereProjection<float>>;
template class gslam::FocalCamera<gslam::DoubleSphereProjection<double>>;
template class gslam::FocalCamera<gslam::EquirectangularProjection<float>>;
template class gslam::FocalCamera<gslam::EquirectangularProjection<double>>;
template class gslam::FocalCamera<gslam::EucmProjection<float>>;
template class gslam::FocalCamera<gslam::EucmProjection<double>>;
template class gslam::FocalCamera<gslam::UcmProjection<float>>;
template class gslam::FocalCamera<gslam::UcmProjection<double>>;
template class gslam::FocalCamera<gslam::FovProjection<float>>;
template class gslam::FocalCamera<gslam::FovProjection<double>>;
template class gslam::FocalCamera<gslam::KannalaBrandtProjection<float>>;
template class gslam::FocalCamera<gslam::KannalaBrandtProjection<double>>;
template class gslam::FocalCamera<gslam::MeiProjection<float>>;
template class gslam::FocalCamera<gslam::MeiProjection<double>>;
template class gslam::FocalCamera<gslam::OrthographicProjection<float>>;
template class gslam::FocalCamera<gslam::OrthographicProjection<double>>;
template class gslam::FocalCamera<gslam::PinholeProjection<float>>;
template class gslam::FocalCamera<gslam::PinholeProjection<double>>;
template class gslam::FocalCamera<gslam::RadtanProjection<float, 4>>;
template class gslam::FocalCamera<gslam::RadtanProjection<double, 14>>;
template class gslam::OcamCamera<float>;
template class gslam::OcamCamera<double>;

// Member templates and friends, which the lines above leave out.
double instantiateGeometry(std::ostream& out, const gslam::SO3d& r, const gslam::Vec3d& v);

double instantiateGeometry(std::ostream& out, const gslam::SO3d& r, const gslam::Vec3d& v) {
  const gslam::Mat3d product = r.matrix() * gslam::Mat3d::identity();
  gslam::Vec3d sum = 2 * v + v / 3 - (-v * 0.5f).cross(product * v);
  out << v << product << r << (v == sum) << (v != sum) << (product == r.matrix())
      << (product != r.matrix());
  out << gslam::SE3d(r, v) << gslam::SIM3d(r, v, 2.0) << (product - product + -product);
  return r.log().dot(sum);
}
