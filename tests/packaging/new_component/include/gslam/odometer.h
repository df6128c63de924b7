#ifndef GSLAM_ODOMETER_H
#define GSLAM_ODOMETER_H

/// @file
/// Length of a path.

#include <gslam/geometry.h>
#include <gslam/odometer/export.h>
#include <gslam/odometer/version.h>

namespace gslam {
inline namespace v1 {

/// Adds up the steps between positions. Not for use by two threads at once.
class GSLAM_ODOMETER_EXPORT Odometer {
 public:
  /// Goes straight to a position, in metres.
  void add(const Vec3d& position);
  /// Length of the way so far, in metres.
  double length() const { return length_; }

 private:
  bool started_ = false;
  Vec3d last_;
  double length_ = 0;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ODOMETER_H
