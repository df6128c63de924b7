// Eigen's quaternion; with a translation and a scale beside it, as its users do by hand. Eigen has
// no exp and log of groups; those of rotations are what its users write.
#include <Eigen/Geometry>

#include "elements.h"
#include "measure.h"

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Points {
  using Point = Vector3d;
  static Point point(const double* p) { return Point(p[0], p[1], p[2]); }
};

struct Rotation : So3, Points {
  using Group = Quaterniond;
  using Tangent = Vector3d;

  static Group make(const Element& e) { return Group(e.quaternion.data()); }
  static Tangent tangent(const double* v) { return Tangent(v[0], v[1], v[2]); }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) { return a * b; }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) { return a * p; }
  BENCH_INLINE static Group exp(const Tangent& v) {
    const double angle = v.norm();
    return Group(Eigen::AngleAxisd(angle, v / angle));
  }
  BENCH_INLINE static Tangent log(const Group& a) {
    const Eigen::AngleAxisd angle_axis(a);
    return angle_axis.angle() * angle_axis.axis();
  }
  BENCH_INLINE static Group inverse(const Group& a) { return a.conjugate(); }
};

struct RigidPair {
  Quaterniond q;
  Vector3d t;
};

struct Rigid : Se3, Points {
  using Group = RigidPair;

  static Group make(const Element& e) { return {Rotation::make(e), point(e.translation.data())}; }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) {
    return {a.q * b.q, a.q * b.t + a.t};
  }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) { return a.q * p + a.t; }
  BENCH_INLINE static Group inverse(const Group& a) {
    const Quaterniond q = a.q.conjugate();
    return {q, -(q * a.t)};
  }
};

struct SimilarTriple {
  Quaterniond q;
  Vector3d t;
  double s;
};

struct Similar : Sim3, Points {
  using Group = SimilarTriple;

  static Group make(const Element& e) {
    return {Rotation::make(e), point(e.translation.data()), e.scale};
  }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) {
    return {a.q * b.q, a.s * (a.q * b.t) + a.t, a.s * b.s};
  }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) { return a.s * (a.q * p) + a.t; }
  BENCH_INLINE static Group inverse(const Group& a) {
    const Quaterniond q = a.q.conjugate();
    const double s = 1 / a.s;
    return {q, -s * (q * a.t), s};
  }
};

const auto kSo3 = Cases<Rotation>("eigen").mult().trans().exp().log().inverse();
const auto kSe3 = Cases<Rigid>("eigen").mult().trans().inverse();
const auto kSim3 = Cases<Similar>("eigen").mult().trans().inverse();

}  // namespace
