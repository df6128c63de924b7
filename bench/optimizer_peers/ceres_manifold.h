// Our groups as parameters of Ceres. Cost functions give derivatives by the tangent on the right in
// the first columns of a block; the manifold's own derivative is the identity above zeros.
#ifndef GSLAM_BENCH_OPTIMIZER_PEERS_CERES_MANIFOLD_H
#define GSLAM_BENCH_OPTIMIZER_PEERS_CERES_MANIFOLD_H

#include <ceres/manifold.h>
#include <gslam/geometry/se3.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

template <class Group>
Group poseOf(const double* numbers) {
  Group group;
  std::memcpy(static_cast<void*>(&group), numbers, sizeof(Group));
  return group;
}
template <class Group>
void setNumbers(const Group& group, double* numbers) {
  std::memcpy(numbers, group.data(), sizeof(Group));
}

template <class Group>
class TangentManifold : public ceres::Manifold {
 public:
  static constexpr int kNumbers = static_cast<int>(sizeof(Group) / sizeof(double));
  static constexpr int kTangent = static_cast<int>(Group::kFreedom);

  int AmbientSize() const override { return kNumbers; }
  int TangentSize() const override { return kTangent; }
  bool Plus(const double* x, const double* delta, double* result) const override {
    typename Group::Tangent tangent;
    std::copy(delta, delta + kTangent, tangent.data());
    setNumbers(poseOf<Group>(x) * Group::exp(tangent), result);
    return true;
  }
  bool PlusJacobian(const double* /*x*/, double* jacobian) const override {
    return setIdentity(kNumbers, kTangent, jacobian);
  }
  bool Minus(const double* y, const double* x, double* difference) const override {
    const auto tangent = (poseOf<Group>(x).inverse() * poseOf<Group>(y)).log();
    std::copy(tangent.data(), tangent.data() + kTangent, difference);
    return true;
  }
  bool MinusJacobian(const double* /*x*/, double* jacobian) const override {
    return setIdentity(kTangent, kNumbers, jacobian);
  }

 private:
  static bool setIdentity(int rows, int columns, double* jacobian) {
    std::fill(jacobian, jacobian + rows * columns, 0.0);
    for (int i = 0; i < std::min(rows, columns); ++i) jacobian[i * columns + i] = 1;
    return true;
  }
};

#endif  // GSLAM_BENCH_OPTIMIZER_PEERS_CERES_MANIFOLD_H
