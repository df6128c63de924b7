#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_REDUCED_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_REDUCED_H

#include <gslam/optimizer/options.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bundle/general_equations.h"

// Solves S x = right side, once or many times.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

struct ReducedSolution {
  bool is_solved = false;
  std::vector<double> x;
  std::vector<double> residual;  // right side - S x; empty: as good as zero
  std::size_t iterations = 0;    // of conjugate gradients
};

class ReducedSolver {
 public:
  virtual ~ReducedSolver() = default;
  virtual std::string name() const = 0;  // "explicit Schur, double, dense Cholesky"
  // Calls equations.eliminate(), and solves.
  virtual void solve(GeneralEquations& equations, double damping, ReducedSolution& solution) = 0;
};

// What the solver needs that the options ask for.
GeneralFill neededFill(const OptimizerOptions& options);
// As the options say, else by size and density.
std::unique_ptr<ReducedSolver> makeReducedSolver(const GeneralStructure& structure,
                                                 const OptimizerOptions& options);
// Of general_iterative.cpp.
std::unique_ptr<ReducedSolver> makeIterativeSolver(const GeneralStructure& structure,
                                                   const OptimizerOptions& options);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_REDUCED_H
