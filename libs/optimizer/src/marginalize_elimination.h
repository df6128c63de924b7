#ifndef GSLAM_OPTIMIZER_SRC_MARGINALIZE_ELIMINATION_H
#define GSLAM_OPTIMIZER_SRC_MARGINALIZE_ELIMINATION_H

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

// Elimination of blocks of variables from normal equations that may be singular.

namespace gslam {
inline namespace v1 {
namespace detail {

// An inverse of a positive semi-definite matrix where it has one. Directions whose part of the
// diagonal that the full equations had is rounding hold no information, and are coupled to nothing.
inline Eigen::MatrixXd semidefiniteInverse(const Eigen::MatrixXd& matrix,
                                           const Eigen::VectorXd& full_diagonal) {
  constexpr double kRounding = 1e-13;
  const Eigen::VectorXd scale =
      full_diagonal.unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * matrix *
                                                             scale.asDiagonal());
  const Eigen::VectorXd inverse =
      eigen.eigenvalues().unaryExpr([](double e) { return e > kRounding ? 1 / e : 0.0; });
  const Eigen::MatrixXd scaled = scale.asDiagonal() * eigen.eigenvectors();
  return scaled * inverse.asDiagonal() * scaled.transpose();
}

// R with R R^T = a positive semi-definite matrix whose diagonal is at most 1, as far as it is not
// rounding: Cholesky's, with the largest pivots first. Column i is zero in the rows of the pivots
// before.
inline Eigen::MatrixXd semidefiniteRoot(const Eigen::MatrixXd& matrix,
                                        std::vector<Eigen::Index>& pivots) {
  constexpr double kRounding = 1e-12;
  Eigen::MatrixXd root(matrix.rows(), matrix.cols());
  Eigen::VectorXd left = matrix.diagonal(), column(matrix.rows());
  pivots.clear();
  for (Eigen::Index rank = 0; rank < matrix.rows(); ++rank) {
    Eigen::Index pivot = 0;
    const double most = left.maxCoeff(&pivot);
    if (!(most > kRounding)) break;
    column = matrix.col(pivot);
    column.noalias() -= root.leftCols(rank) * root.row(pivot).head(rank).transpose();
    root.col(rank) = column / std::sqrt(most);
    left -= root.col(rank).cwiseAbs2();
    left(pivot) = 0;
    for (const Eigen::Index before : pivots) root(before, rank) = 0;
    pivots.push_back(pivot);
  }
  return root.leftCols(static_cast<Eigen::Index>(pivots.size()));
}

// Takes out of what elimination left the directions that hold rounding only, so that the matrix is
// positive semi-definite to the last bits, and the gradient along them.
inline void clearRounding(const Eigen::VectorXd& full_diagonal, Eigen::MatrixXd& matrix,
                          Eigen::VectorXd& gradient) {
  if (matrix.rows() == 0) return;
  const Eigen::VectorXd unit = full_diagonal.cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd inverse = unit.unaryExpr([](double d) { return d > 0 ? 1 / d : 0.0; });
  std::vector<Eigen::Index> pivots;
  const Eigen::MatrixXd root =
      semidefiniteRoot(inverse.asDiagonal() * matrix * inverse.asDiagonal(), pivots);
  Eigen::VectorXd along(root.cols());  // R along = gradient, on the rows of the pivots
  for (Eigen::Index i = 0; i < root.cols(); ++i) {
    const Eigen::Index pivot = pivots[static_cast<std::size_t>(i)];
    const double before = root.row(pivot).head(i).dot(along.head(i));
    along(i) = (inverse(pivot) * gradient(pivot) - before) / root(pivot, i);
  }
  const Eigen::MatrixXd scaled = unit.asDiagonal() * root;
  gradient = scaled * along;
  matrix = scaled * scaled.transpose();
}

// Normal equations H d = -g of blocks, sparse; H is stored on both sides of the diagonal.
class BlockSystem {
 public:
  // What couples a block with one that is eliminated.
  using Coupling = std::pair<std::uint32_t, Eigen::MatrixXd>;

  void addBlock(std::size_t size) {
    const auto n = static_cast<Eigen::Index>(size);
    gradient_.push_back(Eigen::VectorXd::Zero(n));
    rows_.emplace_back();
    rows_.back()[static_cast<std::uint32_t>(rows_.size() - 1)] = Eigen::MatrixXd::Zero(n, n);
  }
  std::size_t count() const { return rows_.size(); }
  std::size_t neighbours(std::uint32_t a) const { return rows_[a].size() - 1; }

  template <class Matrix>
  void add(std::uint32_t a, std::uint32_t b, const Matrix& values) {
    const auto place = rows_[a].emplace(b, Eigen::MatrixXd());
    if (place.second) {
      place.first->second = values;
    } else {
      place.first->second += values;
    }
  }
  template <class Vector>
  void addGradient(std::uint32_t a, const Vector& values) {
    gradient_[a] += values;
  }
  // Zero where nothing couples the two.
  Eigen::MatrixXd block(std::uint32_t a, std::uint32_t b) const {
    const auto found = rows_[a].find(b);
    if (found != rows_[a].end()) return found->second;
    return Eigen::MatrixXd::Zero(gradient_[a].size(), gradient_[b].size());
  }
  const Eigen::VectorXd& gradient(std::uint32_t a) const { return gradient_[a]; }
  // That of the full equations.
  const Eigen::VectorXd& diagonal(std::uint32_t a) const { return diagonal_[a]; }

  // Takes out variables with these equations, which are not blocks: points.
  void eliminate(const Eigen::MatrixXd& inverse, const Eigen::VectorXd& gradient,
                 const std::vector<Coupling>& couplings) {
    for (const Coupling& a : couplings) {
      const Eigen::MatrixXd scaled = -(a.second * inverse);
      addGradient(a.first, scaled * gradient);
      for (const Coupling& b : couplings) add(a.first, b.first, scaled * b.second.transpose());
    }
  }

  // To be called when all equations are there and before a block is eliminated.
  void keepDiagonal() {
    for (std::uint32_t a = 0; a < rows_.size(); ++a) diagonal_.push_back(rows_[a][a].diagonal());
  }

  void eliminate(std::uint32_t a) {
    std::vector<Coupling> couplings;
    for (const auto& place : rows_[a]) {
      if (place.first == a) continue;
      couplings.emplace_back(place.first, place.second.transpose());
      rows_[place.first].erase(a);
    }
    const Eigen::MatrixXd inverse = semidefiniteInverse(rows_[a][a], diagonal_[a]);
    rows_[a].clear();
    eliminate(inverse, gradient_[a], couplings);
  }

 private:
  std::vector<std::map<std::uint32_t, Eigen::MatrixXd>> rows_;
  std::vector<Eigen::VectorXd> gradient_;
  std::vector<Eigen::VectorXd> diagonal_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_MARGINALIZE_ELIMINATION_H
