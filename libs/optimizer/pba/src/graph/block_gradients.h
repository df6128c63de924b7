#ifndef GSLAM_OPTIMIZER_PBA_SRC_GRAPH_BLOCK_GRADIENTS_H
#define GSLAM_OPTIMIZER_PBA_SRC_GRAPH_BLOCK_GRADIENTS_H

#include <gslam/base/parallel.h>
#include <gslam/geometry/mat.h>
#include <gslam/optimizer/options.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "graph/graph_layout.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// Conjugate gradients for the normal equations of a pose graph, preconditioned with the inverses of
// the diagonal blocks.
template <std::size_t N>
class BlockGradients {
 public:
  using Block = Mat<double, N, N>;

  BlockGradients(const GraphLayout& layout, const OptimizerOptions& options)
      : pairs_(layout.pairs), options_(options), neighbours_(layout.pose.size()) {
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      neighbours_[pairs_[p].first].push_back(2 * p);
      neighbours_[pairs_[p].second].push_back(2 * p + 1);
    }
    parallel_.grain = 256;
    parallel_.threads = options.threads;
  }

  // x: the right side, then the solution. `open`: its product with what is left of the right side.
  // Returns the iterations.
  std::size_t solve(const std::vector<Block>& diagonal, const std::vector<Block>& beside,
                    std::vector<double>& x, double& open) {
    invert(diagonal);
    Vector residual = view(x), solution = Vector::Zero(residual.size());
    Vector z = precondition(residual), direction = z, product(residual.size());
    const double goal = options_.linear_tolerance * options_.linear_tolerance;
    double rho = residual.dot(z);
    const double first = rho;
    std::size_t iteration = 0;
    while (iteration < options_.max_linear_iterations && rho > goal * first) {
      multiply(diagonal, beside, direction, product);
      const double curvature = direction.dot(product);
      if (!(curvature > 0)) break;
      const double alpha = rho / curvature;
      solution += alpha * direction;
      residual -= alpha * product;
      z = precondition(residual);
      const double next = residual.dot(z);
      direction = z + next / rho * direction;
      rho = next;
      ++iteration;
    }
    open = solution.dot(residual);
    view(x) = solution;
    return iteration;
  }

 private:
  static constexpr int kSize = static_cast<int>(N);
  using Vector = Eigen::VectorXd;
  using Small = Eigen::Matrix<double, kSize, kSize, N == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  using Part = Eigen::Matrix<double, kSize, 1>;

  static Eigen::Map<Vector> view(std::vector<double>& x) {
    return Eigen::Map<Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
  }
  static Eigen::Map<const Small> view(const Block& block) {
    return Eigen::Map<const Small>(block.data());
  }
  static Eigen::Index at(std::size_t block) { return static_cast<Eigen::Index>(block * N); }

  void invert(const std::vector<Block>& diagonal) {
    inverse_.resize(diagonal.size());
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
      Eigen::Map<Small>(inverse_[i].data()) = view(diagonal[i]).llt().solve(Small::Identity());
    }
  }

  Vector precondition(const Vector& x) const {
    Vector result(x.size());
    for (std::size_t i = 0; i < inverse_.size(); ++i) {
      result.segment<kSize>(at(i)).noalias() = view(inverse_[i]) * x.segment<kSize>(at(i));
    }
    return result;
  }

  void multiply(const std::vector<Block>& diagonal, const std::vector<Block>& beside,
                const Vector& x, Vector& result) const {
    parallelFor(
        0, diagonal.size(),
        [&](std::size_t i) {
          Part sum = view(diagonal[i]) * x.segment<kSize>(at(i));
          for (const std::size_t entry : neighbours_[i]) {
            const BlockPair& pair = pairs_[entry / 2];
            if (entry % 2 == 0) {
              sum.noalias() += view(beside[entry / 2]) * x.segment<kSize>(at(pair.second));
            } else {
              sum.noalias() +=
                  view(beside[entry / 2]).transpose() * x.segment<kSize>(at(pair.first));
            }
          }
          result.segment<kSize>(at(i)) = sum;
        },
        parallel_);
  }

  const std::vector<BlockPair>& pairs_;
  const OptimizerOptions& options_;
  std::vector<std::vector<std::size_t>> neighbours_;  // twice the pair, plus 1 where transposed
  std::vector<Block> inverse_;
  ParallelOptions parallel_;
};

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_GRAPH_BLOCK_GRADIENTS_H
