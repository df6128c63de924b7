#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_MATRIX_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_MATRIX_H

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "bundle/general_structure.h"

// The reduced matrix as Eigen's matrices: upper triangles.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// Calls visit(row, column, place of the value) for all values of the upper triangle, columns
// ascending within a row.
template <class Visit>
void forEachValue(const GeneralStructure& structure, const Visit& visit) {
  const BundleBlocks& blocks = structure.blocks;
  const GeneralPattern& pattern = structure.pattern;
  for (std::size_t b = 0; b < blocks.count(); ++b) {
    for (std::size_t i = 0; i < blocks.size(b); ++i) {
      for (std::size_t p = pattern.first[b]; p < pattern.first[b + 1]; ++p) {
        const std::size_t n = blocks.size(pattern.column[p]);
        for (std::size_t j = pattern.column[p] == b ? i : 0; j < n; ++j) {
          visit(blocks.offset[b] + i, blocks.offset[pattern.column[p]] + j,
                pattern.offset[p] + i * n + j);
        }
      }
    }
  }
}

inline void setDense(const GeneralStructure& structure, const std::vector<double>& values,
                     Eigen::MatrixXd& matrix) {
  const auto n = static_cast<Eigen::Index>(structure.blocks.tangentSize());
  matrix.setZero(n, n);
  forEachValue(structure, [&](std::size_t row, std::size_t column, std::size_t place) {
    matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = values[place];
  });
}

using SparseUpper = Eigen::SparseMatrix<double>;

// Rows of the upper triangle are columns of the lower one: it is made as that, and read as such.
class SparseReduced {
 public:
  explicit SparseReduced(const GeneralStructure& structure) {
    const auto n = static_cast<int>(structure.blocks.tangentSize());
    matrix_.resize(n, n);
    forEachValue(structure, [&](std::size_t row, std::size_t, std::size_t place) {
      ++matrix_.outerIndexPtr()[row + 1];
      place_.push_back(place);
    });
    for (int c = 0; c < n; ++c) matrix_.outerIndexPtr()[c + 1] += matrix_.outerIndexPtr()[c];
    matrix_.resizeNonZeros(static_cast<Eigen::Index>(place_.size()));
    std::size_t k = 0;
    forEachValue(structure, [&](std::size_t, std::size_t column, std::size_t) {
      matrix_.innerIndexPtr()[k++] = static_cast<int>(column);
    });
  }
  void set(const std::vector<double>& values) {
    for (std::size_t k = 0; k < place_.size(); ++k) matrix_.valuePtr()[k] = values[place_[k]];
  }
  SparseUpper& matrix() { return matrix_; }  // lower triangle

 private:
  SparseUpper matrix_;
  std::vector<std::size_t> place_;
};

// Eigen's factorisation, with what it knows of its own cost.
class SparseFactor : public Eigen::SimplicialLDLT<SparseUpper, Eigen::Lower> {
 public:
  // Multiplications of a factorisation, about.
  double work() const {
    double sum = 0;
    for (Eigen::Index i = 0; i < m_nonZerosPerCol.size(); ++i) {
      sum += 0.5 * double(m_nonZerosPerCol[i]) * double(m_nonZerosPerCol[i]);
    }
    return sum;
  }
};

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_MATRIX_H
