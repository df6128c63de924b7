// manif has no SIM3.
#include <manif/SE3.h>
#include <manif/SO3.h>

#include "elements.h"
#include "measure.h"

namespace {

template <class Kind, class Transform>
struct Peer : Kind {
  using Group = Transform;
  using Point = Eigen::Vector3d;
  using Tangent = typename Group::Tangent;

  static Point point(const double* p) { return Point(p[0], p[1], p[2]); }
  static Tangent tangent(const double* v) {
    return Tangent(Eigen::Map<const typename Tangent::DataType>(v));
  }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) { return a * b; }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) { return a.act(p); }
  static void transMany(const Group& a, const Point* p, std::size_t n, Point* to) {
    transOneByOne<Peer>(a, p, n, to);
  }
  BENCH_INLINE static Group exp(const Tangent& v) { return v.exp(); }
  BENCH_INLINE static Tangent log(const Group& a) { return a.log(); }
  BENCH_INLINE static Group inverse(const Group& a) { return a.inverse(); }
};

struct Rotation : Peer<So3, manif::SO3d> {
  static Group make(const Element& e) { return Group(Eigen::Quaterniond(e.quaternion.data())); }
};

struct Rigid : Peer<Se3, manif::SE3d> {
  static Group make(const Element& e) { return {point(e.translation.data()), Rotation::make(e)}; }
  BENCH_INLINE static auto leftJacobian(const Tangent& v) { return v.ljac(); }
};

const auto kSo3 = Cases<Rotation>("manif").mult().trans().transMany().exp().log().inverse();
const auto kSe3 =
    Cases<Rigid>("manif").mult().trans().transMany().exp().log().inverse().leftJacobian();

}  // namespace
