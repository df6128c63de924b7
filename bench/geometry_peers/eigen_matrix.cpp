// Eigen's matrices: more memory and a slower way to compose, but the fastest to points. One on many
// points is measured point by point and as a product of matrices.
#include <Eigen/Geometry>

#include "elements.h"
#include "measure.h"

namespace {

template <class Kind, class Transform>
struct Matrix : Kind {
  using Group = Transform;
  using Point = Eigen::Vector3d;

  static Point point(const double* p) { return Point(p[0], p[1], p[2]); }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) { return a * b; }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) { return a * p; }
  static void transMany(const Group& a, const Point* p, std::size_t n, Point* to) {
    transOneByOne<Matrix>(a, p, n, to);
  }

  static Eigen::Matrix3d linear(const Element& e) {
    return e.scale * Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&e.rotation[0]);
  }
  static Group make(const Element& e) {
    Group result = Group::Identity();
    result.linear() = linear(e);
    result.translation() = point(e.translation.data());
    return result;
  }
};

struct Rotation : Matrix<So3, Eigen::Matrix3d> {
  using Tangent = Eigen::Vector3d;

  static Group make(const Element& e) { return linear(e); }
  static Tangent tangent(const double* v) { return point(v); }
  BENCH_INLINE static Group exp(const Tangent& v) {
    const double angle = v.norm();
    return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
  }
  BENCH_INLINE static Tangent log(const Group& a) {
    const Eigen::AngleAxisd angle_axis(a);
    return angle_axis.angle() * angle_axis.axis();
  }
  BENCH_INLINE static Group inverse(const Group& a) { return a.transpose(); }
};

struct Rigid : Matrix<Se3, Eigen::Isometry3d> {
  BENCH_INLINE static Group inverse(const Group& a) { return a.inverse(); }
};

struct Similar : Matrix<Sim3, Eigen::Affine3d> {
  BENCH_INLINE static Group inverse(const Group& a) { return a.inverse(); }
};

struct RotationAndTranslation {
  Eigen::Matrix3d r;
  Eigen::Vector3d t;
};

/// Without Eigen's Transform, which composes and inverts 4 x 4 numbers.
struct Pair : Se3 {
  using Group = RotationAndTranslation;
  using Point = Eigen::Vector3d;

  static Point point(const double* p) { return Rigid::point(p); }
  static Group make(const Element& e) { return {Rotation::make(e), point(e.translation.data())}; }
  BENCH_INLINE static Group mult(const Group& a, const Group& b) {
    return {a.r * b.r, a.r * b.t + a.t};
  }
  BENCH_INLINE static Point trans(const Group& a, const Point& p) { return a.r * p + a.t; }
  static void transMany(const Group& a, const Point* p, std::size_t n, Point* to) {
    transOneByOne<Pair>(a, p, n, to);
  }
  BENCH_INLINE static Group inverse(const Group& a) {
    return {a.r.transpose(), -(a.r.transpose() * a.t)};
  }
};

/// The points as a 3 x n matrix.
template <class Peer>
struct AsProduct : Peer {
  using typename Peer::Group;
  using typename Peer::Point;

  static void transMany(const Group& a, const Point* p, std::size_t n, Point* to) {
    const auto columns = static_cast<Eigen::Index>(n);
    const Eigen::Map<const Eigen::Matrix3Xd> from(p->data(), 3, columns);
    Eigen::Map<Eigen::Matrix3Xd> result(to->data(), 3, columns);
    if constexpr (std::is_same_v<Group, Eigen::Matrix3d>) {
      result.noalias() = a * from;
    } else {
      result.noalias() = a.linear() * from;
      result.colwise() += a.translation();
    }
  }
};

const auto kSo3 = Cases<Rotation>("eigen_matrix").mult().trans().transMany().exp().log().inverse();
const auto kSe3 = Cases<Rigid>("eigen_matrix").mult().trans().transMany().inverse();
const auto kSe3Pair = Cases<Pair>("eigen_pair").mult().trans().transMany().inverse();
const auto kSim3 = Cases<Similar>("eigen_matrix").mult().trans().transMany().inverse();
const auto kSo3Product = Cases<AsProduct<Rotation>>("eigen_product").transMany();
const auto kSe3Product = Cases<AsProduct<Rigid>>("eigen_product").transMany();
const auto kSim3Product = Cases<AsProduct<Similar>>("eigen_product").transMany();

}  // namespace
