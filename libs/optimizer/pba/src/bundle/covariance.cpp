#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

#include "bundle/general_equations.h"
#include "bundle/general_matrix.h"
#include "bundle/general_structure.h"
#include "factors/bundle_terms.h"
#include "solvers.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

// What is left of a diagonal element of the full equations, at least, when all else is eliminated:
// below it is rounding.
constexpr double kLeastOfDiagonal = 1e-12;
constexpr std::size_t kMostDense = 1500;                   // rows, unless told
constexpr std::size_t kMostCached = std::size_t(1) << 26;  // numbers
constexpr std::size_t kMostEigenRows = 600;  // of a matrix whose free directions are counted

// Columns of the inverse of the reduced matrix, scaled so that the diagonal of H is 1.
class ReducedInverse {
 public:
  ReducedInverse(const GeneralStructure& structure, const GeneralEquations& equations)
      : structure_(structure), n_(structure.blocks.tangentSize()) {
    scale_.resize(static_cast<Eigen::Index>(n_));
    for (std::size_t b = 0; b < structure.blocks.count(); ++b) {
      const std::size_t size = structure.blocks.size(b);
      const double* const block =
          &equations.hessian()[structure.pattern.offset[structure.pattern.first[b]]];
      for (std::size_t i = 0; i < size; ++i) {
        const double h = block[i * size + i];
        scale_(static_cast<Eigen::Index>(structure.blocks.offset[b] + i)) =
            h > 0 && std::isfinite(h) ? 1 / std::sqrt(h) : 1.0;
      }
    }
    scaled_ = equations.reduced();
    forEachValue(structure, [this](std::size_t row, std::size_t column, std::size_t place) {
      scaled_[place] *=
          scale_(static_cast<Eigen::Index>(row)) * scale_(static_cast<Eigen::Index>(column));
    });
  }

  // False, with a sentence, where there is no inverse.
  bool factorize(LinearSolverKind kind, std::string& message) {
    if (n_ == 0) return true;
    const bool is_dense =
        kind == LinearSolverKind::Dense || (kind != LinearSolverKind::Sparse && n_ <= kMostDense);
    return is_dense ? factorizeDense(message) : factorizeSparse(message);
  }

  // The block (a, b) of the inverse.
  Eigen::MatrixXd block(std::uint32_t a, std::uint32_t b) {
    return columns(b).middleRows(top(a), rows(a));
  }

 private:
  Eigen::Index top(std::uint32_t block) const {
    return static_cast<Eigen::Index>(structure_.blocks.offset[block]);
  }
  Eigen::Index rows(std::uint32_t block) const {
    return static_cast<Eigen::Index>(structure_.blocks.size(block));
  }

  const Eigen::MatrixXd& columns(std::uint32_t block) {
    const auto found = columns_.find(block);
    if (found != columns_.end()) return found->second;
    const auto n = static_cast<Eigen::Index>(n_);
    if (cached_ > kMostCached) {
      columns_.clear();
      cached_ = 0;
    }
    cached_ += n_ * structure_.blocks.size(block);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, rows(block));
    for (Eigen::Index i = 0; i < rows(block); ++i) {
      right(top(block) + i, i) = scale_(top(block) + i);
    }
    Eigen::MatrixXd x =
        is_sparse_ ? Eigen::MatrixXd(sparse_.solve(right)) : Eigen::MatrixXd(dense_.solve(right));
    x = scale_.asDiagonal() * x;
    return columns_.emplace(block, std::move(x)).first->second;
  }

  bool factorizeDense(std::string& message) {
    Eigen::MatrixXd matrix;
    setDense(structure_, scaled_, matrix);
    const Eigen::MatrixXd lower = matrix.triangularView<Eigen::Upper>().transpose();
    dense_.compute(lower);
    if (dense_.info() == Eigen::Success) {
      const double least = dense_.matrixLLT().diagonal().array().square().minCoeff();
      if (least >= kLeastOfDiagonal) return true;
    }
    message = n_ <= kMostEigenRows ? freeDirections(lower) : "the normal equations are singular";
    message += ": fix poses or points, or add priors";
    return false;
  }

  bool factorizeSparse(std::string& message) {
    is_sparse_ = true;
    SparseReduced reduced(structure_);
    reduced.set(scaled_);
    sparse_.compute(reduced.matrix());
    const bool is_good =
        sparse_.info() == Eigen::Success && sparse_.vectorD().minCoeff() >= kLeastOfDiagonal;
    if (!is_good) {
      message = "the normal equations are singular: fix poses or points, or add priors";
    }
    return is_good;
  }

  // How many directions nothing determines, and which variables are in them.
  std::string freeDirections(const Eigen::MatrixXd& lower) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(lower);
    Eigen::Index count = 1;
    while (count < eigen.eigenvalues().size() && eigen.eigenvalues()(count) < kLeastOfDiagonal)
      ++count;
    std::uint32_t worst = 0;
    double most = -1;
    std::size_t touched = 0;
    for (std::uint32_t b = 0; b < structure_.blocks.count(); ++b) {
      const double part = eigen.eigenvectors().block(top(b), 0, rows(b), count).squaredNorm();
      touched += part > 1e-6 ? 1 : 0;
      if (part > most) {
        most = part;
        worst = b;
      }
    }
    return "the normal equations do not determine " + std::to_string(count) +
           (count == 1 ? " direction" : " directions") + " of " + std::to_string(touched) +
           " variables, most of " + blockName(structure_.blocks, worst);
  }

  const GeneralStructure& structure_;
  const std::size_t n_;
  bool is_sparse_ = false;
  Eigen::VectorXd scale_;
  std::vector<double> scaled_;
  Eigen::LLT<Eigen::MatrixXd> dense_;
  SparseFactor sparse_;
  std::unordered_map<std::uint32_t, Eigen::MatrixXd> columns_;
  std::size_t cached_ = 0;  // numbers
};

class CovarianceOfBundle {
 public:
  CovarianceOfBundle(const BundleProblem& problem, const OptimizerOptions& options)
      : structure_(generalStructure(problem)),
        values_(bundleValues(problem, structure_.blocks)),
        equations_(problem, structure_, options.loss, options.threads),
        linear_solver_(options.linear_solver) {}

  // Whether there is an inverse; else why not.
  bool prepare(Span<const std::uint32_t> points, std::string& message) {
    if (!std::isfinite(equations_.linearize(values_))) {
      message = "the cost has no finite value";
      return false;
    }
    listGroups();
    for (const std::uint32_t point : points) {
      if (structure_.blocks.point_free[point] == 0) continue;
      if (group_of_[point] != kNoBlock && isDetermined(group_of_[point])) continue;
      message = "point " + std::to_string(point) + " is not determined by its observations";
      return false;
    }
    equations_.eliminate(0, false);
    inverse_ = std::make_unique<ReducedInverse>(structure_, equations_);
    return inverse_->factorize(linear_solver_, message);
  }

  Mat<double, 6, 6> pose(std::uint32_t pose) {
    Mat<double, 6, 6> result{};
    const std::uint32_t block = structure_.blocks.pose[pose];
    if (block == kNoBlock) return result;
    const Eigen::MatrixXd c = inverse_->block(block, block);
    for (std::size_t i = 0; i < 36; ++i) result.values[i] = symmetric(c, i / 6, i % 6);
    return result;
  }

  std::vector<double> camera(std::uint32_t camera) {
    const std::uint32_t block = structure_.blocks.intrinsic[camera];
    if (block == kNoBlock) return {};
    const std::size_t k = structure_.blocks.size(block);
    const Eigen::MatrixXd c = inverse_->block(block, block);
    std::vector<double> result(k * k);
    for (std::size_t i = 0; i < k * k; ++i) result[i] = symmetric(c, i / k, i % k);
    return result;
  }

  // V^-1 + V^-1 W S^-1 W^T V^-1
  Mat3d point(std::uint32_t point) {
    if (structure_.blocks.point_free[point] == 0) return Mat3d{};
    const GeneralGroups& g = structure_.groups;
    const std::size_t group = group_of_[point], first = g.first_entry[group];
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t a = 0; a < g.entries(group); ++a) {
      for (std::size_t b = a; b < g.entries(group); ++b) {
        const Eigen::Matrix3d term =
            coupling(first + a) *
            inverse_->block(g.entry_block[first + a], g.entry_block[first + b]) *
            coupling(first + b).transpose();
        sum += term;
        if (b != a) sum += term.transpose();
      }
    }
    const Mat3d& v = equations_.pointInverse(group);
    const Eigen::Matrix3d inverse = Eigen::Map<const Eigen::Matrix3d>(v.values);  // symmetric
    const Eigen::Matrix3d local = inverse + inverse * sum * inverse;
    Mat3d result;
    for (std::size_t i = 0; i < 9; ++i) result.values[i] = symmetric(local, i / 3, i % 3);
    return inWorld(point, result);
  }

 private:
  template <class Matrix>
  static double symmetric(const Matrix& c, std::size_t row, std::size_t column) {
    const auto i = static_cast<Eigen::Index>(row), j = static_cast<Eigen::Index>(column);
    return 0.5 * (c(i, j) + c(j, i));
  }

  using Coupling = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<const Coupling> coupling(std::size_t entry) const {
    const std::size_t size = structure_.blocks.size(structure_.groups.entry_block[entry]);
    return Eigen::Map<const Coupling>(equations_.coupling(entry), 3,
                                      static_cast<Eigen::Index>(size));
  }

  void listGroups() {
    group_of_.assign(structure_.blocks.point_free.size(), kNoBlock);
    for (std::uint32_t group = 0; group < structure_.groups.count(); ++group) {
      const std::uint32_t point = structure_.groups.point[group];
      if (point != kNoBlock) group_of_[point] = group;
    }
  }

  // Of its variables, as far as rounding shows: the ratio of the volumes of the matrix and of its
  // diagonal is that of the pivots.
  bool isDetermined(std::size_t group) const {
    const Mat3d& v = equations_.pointHessian(group);
    Eigen::Matrix3d scaled;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(v(i, i) > 0)) return false;
      for (std::size_t j = 0; j < 3; ++j) {
        scaled(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            v(i, j) / std::sqrt(v(i, i) * v(j, j));
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scaled, Eigen::EigenvaluesOnly);
    return eigen.eigenvalues()(0) > kLeastOfDiagonal;
  }

  // Of x, y, z, given the anchor.
  Mat3d inWorld(std::uint32_t point, const Mat3d& local) const {
    const std::uint32_t anchor = structure_.blocks.anchorOf(point);
    if (anchor == kNoBlock) return local;
    const Mat3d j = values_.T_world_body[anchor].rotation().matrix() *
                    anchoredJacobian(values_.anchored[point]);
    return j * local * j.transpose();
  }

  const GeneralStructure structure_;
  const BundleValues values_;
  GeneralEquations equations_;
  const LinearSolverKind linear_solver_;
  std::vector<std::uint32_t> group_of_;
  std::unique_ptr<ReducedInverse> inverse_;
};

}  // namespace

BundleCovariance solveBundleCovariance(const BundleProblem& problem,
                                       Span<const std::uint32_t> poses,
                                       Span<const std::uint32_t> points,
                                       Span<const std::uint32_t> cameras,
                                       const OptimizerOptions& options) {
  BundleCovariance result;
  CovarianceOfBundle covariance(problem, options);
  result.is_valid = covariance.prepare(points, result.message);
  const auto fill = [&result](auto& list, Span<const std::uint32_t> asked, const auto& of) {
    list.resize(asked.size());  // zeros
    if (!result.is_valid) return;
    for (std::size_t i = 0; i < asked.size(); ++i) list[i] = of(asked[i]);
  };
  fill(result.poses, poses, [&](std::uint32_t i) { return covariance.pose(i); });
  fill(result.points, points, [&](std::uint32_t i) { return covariance.point(i); });
  fill(result.cameras, cameras, [&](std::uint32_t i) { return covariance.camera(i); });
  return result;
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
