#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cmath>

#include "bundle/fast_solve.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

template <class T>
struct FastDirect<T>::Memory {
  bool is_dense = true;
  Eigen::MatrixXd dense;
  Eigen::LLT<Eigen::MatrixXd> dense_factor;
  bool is_analyzed = false;
  std::vector<Eigen::Triplet<double>> elements;
  Eigen::SparseMatrix<double> sparse;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> sparse_factor;

  // Calls set(row, column, value) for the lower triangle.
  template <class Set>
  static void forElements(const FastSchur<T>& schur, const Set& set) {
    const std::size_t d = schur.freedom();
    const FastPattern& pattern = schur.pattern();
    for (std::size_t b = 0; b < schur.blocks(); ++b) {
      for (std::size_t r = 0; r < d; ++r) {
        for (std::size_t c = 0; c <= r; ++c) {
          set(b * d + r, b * d + c, schur.diagonal(b)[placeInBlock(r, c)]);
        }
      }
      for (std::size_t slot = pattern.row_begin[b]; slot < pattern.row_begin[b + 1]; ++slot) {
        for (std::size_t r = 0; r < d; ++r) {
          for (std::size_t c = 0; c < d; ++c) {
            set(pattern.columns[slot] * d + c, b * d + r, schur.element(slot, r, c));
          }
        }
      }
    }
  }

  bool factorDense(const FastSchur<T>& schur) {
    const auto n = static_cast<Eigen::Index>(schur.size());
    dense.setZero(n, n);
    forElements(schur, [&](std::size_t row, std::size_t column, double value) {
      dense(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = value;
    });
    dense_factor.compute(dense);
    return dense_factor.info() == Eigen::Success;
  }

  bool factorSparse(const FastSchur<T>& schur) {
    const auto n = static_cast<Eigen::Index>(schur.size());
    elements.clear();
    forElements(schur, [&](std::size_t row, std::size_t column, double value) {
      elements.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
    });
    sparse.resize(n, n);
    sparse.setFromTriplets(elements.begin(), elements.end());
    if (!is_analyzed) sparse_factor.analyzePattern(sparse);
    is_analyzed = true;
    sparse_factor.factorize(sparse);
    return sparse_factor.info() == Eigen::Success;
  }
};

template <class T>
FastDirect<T>::FastDirect(bool is_dense) : memory_(new Memory()) {
  memory_->is_dense = is_dense;
}
template <class T>
FastDirect<T>::~FastDirect() = default;

template <class T>
bool FastDirect<T>::solve(const FastSchur<T>& schur, std::vector<double>& step) {
  const auto n = static_cast<Eigen::Index>(schur.size());
  const Eigen::Map<const Eigen::VectorXd> right(schur.rightSide().data(), n);
  Eigen::Map<Eigen::VectorXd> x(step.data(), n);
  if (memory_->is_dense) {
    if (!memory_->factorDense(schur)) return false;
    x = memory_->dense_factor.solve(right);
  } else {
    if (!memory_->factorSparse(schur)) return false;
    x = memory_->sparse_factor.solve(right);
  }
  return x.allFinite();
}

template class FastDirect<float>;
template class FastDirect<double>;

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
