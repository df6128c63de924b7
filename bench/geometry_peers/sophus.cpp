#include <sophus/se3.hpp>
#include <sophus/sim3.hpp>
#include <sophus/so3.hpp>

#include "elements.h"
#include "measure.h"

namespace {

template <class Kind, class Transform>
struct Peer : Kind {
  using Group = Transform;
  using Point = Eigen::Vector3d;
  using Tangent = typename Group::Tangent;

  static Point point(const double* p) { return Point(p[0], p[1], p[2]); }
  static Tangent tangent(const double* v) { return Eigen::Map<const Tangent>(v); }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) { return a * b; }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) { return a * p; }
  static void transMany(const Group& a, const Point* p, std::size_t n, Point* to) {
    transOneByOne<Peer>(a, p, n, to);
  }
  BENCH_INLINE static Group exp(const Tangent& v) { return Group::exp(v); }
  BENCH_INLINE static Tangent log(const Group& a) { return a.log(); }
  BENCH_INLINE static Group inverse(const Group& a) { return a.inverse(); }
};

struct Rotation : Peer<So3, Sophus::SO3d> {
  static Group make(const Element& e) { return Group(Eigen::Quaterniond(e.quaternion.data())); }
};

struct Rigid : Peer<Se3, Sophus::SE3d> {
  static Group make(const Element& e) { return {Rotation::make(e), point(e.translation.data())}; }
  BENCH_INLINE static auto leftJacobian(const Tangent& v) { return Group::leftJacobian(v); }
};

struct Similar : Peer<Sim3, Sophus::Sim3d> {
  static Group make(const Element& e) {
    return Group(e.scale, Eigen::Quaterniond(e.quaternion.data()), point(e.translation.data()));
  }
};

const auto kSo3 = Cases<Rotation>("sophus").mult().trans().transMany().exp().log().inverse();
const auto kSe3 =
    Cases<Rigid>("sophus").mult().trans().transMany().exp().log().inverse().leftJacobian();
const auto kSim3 = Cases<Similar>("sophus").mult().trans().transMany().exp().log().inverse();

}  // namespace
