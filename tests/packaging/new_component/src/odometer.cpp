#include <gslam/odometer.h>

namespace gslam {
inline namespace v1 {

double hiddenHelper(const Vec3d& a, const Vec3d& b);

double hiddenHelper(const Vec3d& a, const Vec3d& b) {
  return (a - b).norm();
}

void Odometer::add(const Vec3d& position) {
  if (started_) length_ += hiddenHelper(position, last_);
  last_ = position;
  started_ = true;
}

}  // namespace v1
}  // namespace gslam
