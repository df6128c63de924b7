// The GSLAM of 2019 (github.com/zdzhaoyong/GSLAM), of which this project is the successor. Its SIM3
// has an inverse that does not compile.
#include <GSLAM/core/SIM3.h>

#include "elements.h"
#include "measure.h"

namespace {

template <class Kind, class Transform, class Vector>
struct Original : Kind {
  using Group = Transform;
  using Point = GSLAM::Point3d;
  using Tangent = Vector;

  static Point point(const double* p) { return Point(p[0], p[1], p[2]); }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) { return a * b; }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) { return a * p; }
  static void transMany(const Group& a, const Point* p, std::size_t n, Point* to) {
    transOneByOne<Original>(a, p, n, to);
  }
  BENCH_INLINE static Tangent log(const Group& a) { return a.log(); }
};

struct Rotation : Original<So3, GSLAM::SO3d, GSLAM::Point3d> {
  static Group make(const Element& e) {
    return {e.quaternion[0], e.quaternion[1], e.quaternion[2], e.quaternion[3]};
  }
  static Tangent tangent(const double* v) { return point(v); }
  BENCH_INLINE static Group exp(const Tangent& v) { return Group::exp(v); }
  BENCH_INLINE static Group inverse(const Group& a) { return a.inverse(); }
};

struct Rigid : Original<Se3, GSLAM::SE3d, GSLAM::Vector<double, 6>> {
  static Group make(const Element& e) { return {Rotation::make(e), point(e.translation.data())}; }
  static Tangent tangent(const double* v) { return Tangent(v); }
  BENCH_INLINE static Group exp(const Tangent& v) { return Group::exp(v); }
  BENCH_INLINE static Group inverse(const Group& a) { return a.inverse(); }
};

struct Similar : Original<Sim3, GSLAM::SIM3d, GSLAM::Vector<double, 7>> {
  static Group make(const Element& e) {
    return {Rotation::make(e), point(e.translation.data()), e.scale};
  }
  static Tangent tangent(const double* v) { return Tangent(v); }
  BENCH_INLINE static Group exp(const Tangent& v) { return Group::exp(v); }
};

const auto kSo3 = Cases<Rotation>("original").mult().trans().transMany().exp().log().inverse();
const auto kSe3 = Cases<Rigid>("original").mult().trans().transMany().exp().log().inverse();
const auto kSim3 = Cases<Similar>("original").mult().trans().transMany().exp().log();

}  // namespace
