// What Ceres has for rotations: functions over arrays, w x y z, and over angle times axis.
#include <ceres/rotation.h>

#include "elements.h"
#include "measure.h"

namespace {

struct Points {
  using Point = Xyz;
  static Point point(const double* p) { return {p[0], p[1], p[2]}; }
};

struct Quaternion : So3, Points {
  using Group = std::array<double, 4>;
  using Tangent = Xyz;

  static Group make(const Element& e) {
    return {e.quaternion[3], e.quaternion[0], e.quaternion[1], e.quaternion[2]};
  }
  static Tangent tangent(const double* v) { return point(v); }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) {
    Group result;
    ceres::QuaternionProduct(a.data(), b.data(), result.data());
    return result;
  }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) {
    Point result;
    ceres::UnitQuaternionRotatePoint(a.data(), p.data(), result.data());
    return result;
  }
  BENCH_INLINE static Group exp(const Tangent& v) {
    Group result;
    ceres::AngleAxisToQuaternion(v.data(), result.data());
    return result;
  }
  BENCH_INLINE static Tangent log(const Group& a) {
    Tangent result;
    ceres::QuaternionToAngleAxis(a.data(), result.data());
    return result;
  }
  BENCH_INLINE static Group inverse(const Group& a) { return {a[0], -a[1], -a[2], -a[3]}; }
};

struct AngleAxis : So3, Points {
  using Group = Xyz;

  static Group make(const Element& e) { return point(&e.tangent[kFirst]); }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) {
    Point result;
    ceres::AngleAxisRotatePoint(a.data(), p.data(), result.data());
    return result;
  }
};

const auto kQuaternion = Cases<Quaternion>("ceres").mult().trans().exp().log().inverse();
const auto kAngleAxis = Cases<AngleAxis>("ceres_angle_axis").trans();

}  // namespace
