// Steps of least squares on normal equations of up to kMaxDof unknowns.
#ifndef GSLAM_ESTIMATOR_ROBUST_LEAST_SQUARES_H
#define GSLAM_ESTIMATOR_ROBUST_LEAST_SQUARES_H

#include <cstddef>

#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// The step of Levenberg and Marquardt: (H + damping diag H) delta = -gradient. False where H is
// not positive definite or a number is not finite.
bool solveStep(const NormalEquations& sums, std::size_t dof, double damping, double* delta);

// By how much the step should lower the cost, if the model were linear.
double promisedDecrease(const NormalEquations& sums, std::size_t dof, double damping,
                        const double* delta);

// The inverse of H, row by row in kMaxDof columns. False where H has no full rank to ten digits,
// whatever the units of the unknowns.
bool invertHessian(const NormalEquations& sums, std::size_t dof, double* inverse);

// Minimises the weighted squares from `model` on in at most `steps` steps; whether it converged.
// weights has `count` entries, as Problem::accumulate() wants them.
bool fit(const Problem& problem, const double* weights, std::size_t count, int steps,
         ModelNumbers& model);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_LEAST_SQUARES_H
