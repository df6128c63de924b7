// TooN: rotations are matrices.
#include <TooN/TooN.h>
#include <TooN/se3.h>
#include <TooN/sim3.h>
#include <TooN/so3.h>

#include "elements.h"
#include "measure.h"

namespace {

template <class Kind, class Transform>
struct Toon : Kind {
  using Group = Transform;
  using Point = TooN::Vector<3>;
  using Tangent = TooN::Vector<Kind::kSize>;

  static Point point(const double* p) { return TooN::makeVector(p[0], p[1], p[2]); }
  static Tangent tangent(const double* v) { return TooN::wrapVector<Kind::kSize>(v); }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) { return a * b; }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) { return a * p; }
  static void transMany(const Group& a, const Point* p, std::size_t n, Point* to) {
    transOneByOne<Toon>(a, p, n, to);
  }
  BENCH_INLINE static Group exp(const Tangent& v) { return Group::exp(v); }
  BENCH_INLINE static Tangent log(const Group& a) { return a.ln(); }
  BENCH_INLINE static Group inverse(const Group& a) { return a.inverse(); }
};

struct Rotation : Toon<So3, TooN::SO3<>> {
  static Group make(const Element& e) { return Group(TooN::wrapMatrix<3, 3>(e.rotation.data())); }
};

struct Rigid : Toon<Se3, TooN::SE3<>> {
  static Group make(const Element& e) { return {Rotation::make(e), point(e.translation.data())}; }
};

struct Similar : Toon<Sim3, TooN::SIM3<>> {
  static Group make(const Element& e) {
    return {Rotation::make(e), point(e.translation.data()), e.scale};
  }
};

const auto kSo3 = Cases<Rotation>("toon").mult().trans().transMany().exp().log().inverse();
const auto kSe3 = Cases<Rigid>("toon").mult().trans().transMany().exp().log().inverse();
const auto kSim3 = Cases<Similar>("toon").mult().trans().transMany().exp().log().inverse();

}  // namespace
