#include <gslam/geometry.h>
#include <gslam/geometry/batch.h>

#include <algorithm>
#include <cstddef>

#include "elements.h"
#include "measure.h"

namespace {

template <class Kind, class Transform>
struct Ours : Kind {
  using Group = Transform;
  using Point = gslam::Vec3d;
  using Tangent = gslam::Vec<double, Kind::kSize>;

  static Point point(const double* p) { return Point{p[0], p[1], p[2]}; }
  static Tangent tangent(const double* v) {
    Tangent result;
    std::copy(v, v + Kind::kSize, result.data());
    return result;
  }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) { return a * b; }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) { return a * p; }
  static void transMany(const Group& a, const Point* p, std::size_t n, Point* to) {
    gslam::transformPoints(a, gslam::Span<const Point>(p, n), gslam::Span<Point>(to, n));
  }
  BENCH_INLINE static Group exp(const Tangent& v) { return Group::exp(v); }
  BENCH_INLINE static Tangent log(const Group& a) { return a.log(); }
  BENCH_INLINE static Group inverse(const Group& a) { return a.inverse(); }
};

struct Rotation : Ours<So3, gslam::SO3d> {
  static Group make(const Element& e) {
    return Group::fromQuaternion(e.quaternion[0], e.quaternion[1], e.quaternion[2],
                                 e.quaternion[3]);
  }
};

struct Rigid : Ours<Se3, gslam::SE3d> {
  static Group make(const Element& e) { return {Rotation::make(e), point(e.translation.data())}; }
  BENCH_INLINE static auto leftJacobian(const Tangent& v) { return Group::leftJacobian(v); }
};

struct Similar : Ours<Sim3, gslam::SIM3d> {
  static Group make(const Element& e) {
    return {Rotation::make(e), point(e.translation.data()), e.scale};
  }
};

const auto kSo3 = Cases<Rotation>("gslam").mult().trans().transMany().exp().log().inverse();
const auto kSe3 =
    Cases<Rigid>("gslam").mult().trans().transMany().exp().log().inverse().leftJacobian();
const auto kSim3 = Cases<Similar>("gslam").mult().trans().transMany().exp().log().inverse();

}  // namespace
