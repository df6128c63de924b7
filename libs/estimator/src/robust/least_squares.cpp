#include "robust/least_squares.h"

#include <cmath>
#include <limits>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Cholesky's factor of S H S, where S makes the diagonal 1 (then its pivots do not depend on the
// units of the unknowns).
struct ScaledFactor {
  double lower[kMaxDof][kMaxDof];
  double scale[kMaxDof];
  std::size_t dof;

  // least_pivot: what is below counts as singular.
  bool compute(const NormalEquations& sums, std::size_t size, double damping, double least_pivot) {
    dof = size;
    for (std::size_t i = 0; i < dof; ++i) {
      const double diagonal = sums.hessian[i * kMaxDof + i];
      if (!(diagonal > 0) || !std::isfinite(diagonal)) return false;
      scale[i] = 1 / std::sqrt(diagonal);
    }
    for (std::size_t j = 0; j < dof; ++j) {
      for (std::size_t i = j; i < dof; ++i) {
        double sum = sums.hessian[j * kMaxDof + i] * scale[i] * scale[j];
        if (i == j) sum = 1 + damping;
        for (std::size_t k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
        if (i == j) {
          if (!(sum > least_pivot)) return false;
          lower[j][j] = std::sqrt(sum);
        } else {
          lower[i][j] = sum / lower[j][j];
        }
      }
    }
    return true;
  }

  // H^-1 b, in place.
  void solve(double* b) const {
    for (std::size_t i = 0; i < dof; ++i) {
      double sum = b[i] * scale[i];
      for (std::size_t k = 0; k < i; ++k) sum -= lower[i][k] * b[k];
      b[i] = sum / lower[i][i];
    }
    for (std::size_t i = dof; i-- > 0;) {
      double sum = b[i];
      for (std::size_t k = i + 1; k < dof; ++k) sum -= lower[k][i] * b[k];
      b[i] = sum / lower[i][i];
    }
    for (std::size_t i = 0; i < dof; ++i) b[i] *= scale[i];
  }
};

}  // namespace

bool solveStep(const NormalEquations& sums, std::size_t dof, double damping, double* delta) {
  ScaledFactor factor;
  if (!factor.compute(sums, dof, damping, 1e-14)) return false;
  for (std::size_t i = 0; i < dof; ++i) delta[i] = -sums.gradient[i];
  factor.solve(delta);
  for (std::size_t i = 0; i < dof; ++i) {
    if (!std::isfinite(delta[i])) return false;
  }
  return true;
}

// -(2 g^T d + d^T H d), and H d = -g - damping diag(H) d.
double promisedDecrease(const NormalEquations& sums, std::size_t dof, double damping,
                        const double* delta) {
  double decrease = 0;
  for (std::size_t i = 0; i < dof; ++i) {
    const double diagonal = sums.hessian[i * kMaxDof + i];
    decrease += delta[i] * (damping * diagonal * delta[i] - sums.gradient[i]);
  }
  return decrease;
}

bool invertHessian(const NormalEquations& sums, std::size_t dof, double* inverse) {
  ScaledFactor factor;
  if (!factor.compute(sums, dof, 0, 1e-10)) return false;
  for (std::size_t c = 0; c < dof; ++c) {
    double column[kMaxDof] = {};
    column[c] = 1;
    factor.solve(column);
    for (std::size_t r = 0; r < dof; ++r) inverse[r * kMaxDof + c] = column[r];
  }
  for (std::size_t r = 0; r < dof; ++r) {
    for (std::size_t c = 0; c < r; ++c) {  // the last bits
      const double mean = (inverse[r * kMaxDof + c] + inverse[c * kMaxDof + r]) / 2;
      inverse[r * kMaxDof + c] = inverse[c * kMaxDof + r] = mean;
    }
  }
  return true;
}

bool fit(const Problem& problem, const double* weights, std::size_t count, int steps,
         ModelNumbers& model) {
  const std::size_t dof = problem.dof();
  double damping = 1e-6;
  NormalEquations sums;
  problem.accumulate(model, weights, count, sums);
  for (int step = 0; step < steps && damping < 1e6; ++step) {
    double delta[kMaxDof] = {};
    if (!solveStep(sums, dof, damping, delta)) {
      damping *= 100;
      continue;
    }
    const double promised = promisedDecrease(sums, dof, damping, delta);
    if (!(promised > 1e-22 * sums.cost)) return true;
    const ModelNumbers candidate = problem.retract(model, delta);
    NormalEquations next;
    problem.accumulate(candidate, weights, count, next);
    // Near the minimum rounding hides what the last steps gain.
    if (next.cost <= sums.cost * (1 + 1e-13)) {
      model = candidate;
      sums = next;
      damping = damping > 1e-9 ? damping / 10 : 0;
    } else {
      damping = damping > 0 ? damping * 10 : 1e-6;
    }
  }
  return false;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
