// Instantiates the templates of GSLAM::geometry; compiled alone under every compiler and standard
// by tests/headers.
#include <gslam/geometry.h>

#include <ostream>

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

template gslam::SO3<float> gslam::SO3<double>::cast<float>() const;
template gslam::SE3<float> gslam::SE3<double>::cast<float>() const;
template gslam::SIM3<double> gslam::SIM3<float>::cast<double>() const;

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
