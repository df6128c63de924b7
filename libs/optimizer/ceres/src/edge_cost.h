#ifndef GSLAM_OPTIMIZER_CERES_SRC_EDGE_COST_H
#define GSLAM_OPTIMIZER_CERES_SRC_EDGE_COST_H

#include <ceres/cost_function.h>
#include <factors/pose_edge.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "manifolds.h"

// Measured relative poses, of graphs and of bundles.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

// One end of an edge: a pose, and how many numbers the block has that begins with it.
template <class Group>
struct EdgeEnd {
  const double* data = nullptr;  // of the pose, which stays where it is
  int ambient = 0;               // 0: not a variable
};

template <class Group>
class EdgeCost : public ceres::CostFunction {
 public:
  // The ends that are variables are the blocks, in this order. T_from_to must stay where it is.
  void set(PoseGraphResidual kind, const EdgeEnd<Group>& from, const EdgeEnd<Group>& to,
           const Group& T_from_to, const typename Group::Jacobian& information) {
    kind_ = kind;
    from_ = from;
    to_ = to;
    T_from_to_ = &T_from_to;
    weight_ = edgeWeight<Group>(kind, information);
    mutable_parameter_block_sizes()->clear();
    for (const int ambient : {from.ambient, to.ambient}) {
      if (ambient != 0) mutable_parameter_block_sizes()->push_back(ambient);
    }
    constexpr int d = static_cast<int>(Group::Point::size());
    set_num_residuals(kind == PoseGraphResidual::Chordal ? d * d + d : freedomOf<Group>());
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const bool has_from = from_.ambient != 0, has_to = to_.ambient != 0;
    const int place_to = has_from ? 1 : 0;
    EdgeValue<Group> value;
    edgeValue(kind_, loaded<Group>(has_from ? parameters[0] : from_.data),
              loaded<Group>(has_to ? parameters[place_to] : to_.data), *T_from_to_, weight_,
              jacobians != nullptr, value);
    std::copy(value.residual, value.residual + value.rows, residuals);
    if (!areFinite(residuals, num_residuals())) return false;
    if (jacobians == nullptr) return true;
    if (has_from) copyJacobian(value.by_from, from_.ambient, jacobians[0]);
    if (has_to) copyJacobian(value.by_to, to_.ambient, jacobians[place_to]);
    return true;
  }

  // rho's argument, with the poses where they stand.
  double squaredNorm() const {
    EdgeValue<Group> value;
    edgeValue(kind_, loaded<Group>(from_.data), loaded<Group>(to_.data), *T_from_to_, weight_,
              false, value);
    double sum = 0;
    for (std::size_t i = 0; i < value.rows; ++i) sum += value.residual[i] * value.residual[i];
    return sum;
  }

 private:
  void copyJacobian(const double* from, int ambient, double* to) const {
    if (to == nullptr) return;
    constexpr int n = freedomOf<Group>();
    std::fill(to, to + num_residuals() * ambient, 0.0);
    for (int r = 0; r < num_residuals(); ++r) {
      std::copy(from + r * n, from + (r + 1) * n, to + r * ambient);
    }
  }

  PoseGraphResidual kind_ = PoseGraphResidual::Logarithm;
  EdgeEnd<Group> from_, to_;
  const Group* T_from_to_ = nullptr;
  EdgeWeight<Group> weight_;
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_EDGE_COST_H
