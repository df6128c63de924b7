#include "block_covariance.h"

#include <ceres/crs_matrix.h>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cmath>
#include <map>

#include "silence.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// Of eigenvalues of a matrix with a diagonal of ones: below, no digit of the inverse is right.
constexpr double kLeastEigenvalue = 1e-14;

// Columns are scaled to length 1; `scale` is what they were multiplied with. False where one is
// zero.
bool scaleColumns(Eigen::Map<SparseRows>& jacobian, Eigen::VectorXd& scale) {
  scale = Eigen::VectorXd::Zero(jacobian.cols());
  double* const values = jacobian.valuePtr();
  const int* const columns = jacobian.innerIndexPtr();
  for (Eigen::Index i = 0; i < jacobian.nonZeros(); ++i) {
    scale[columns[i]] += values[i] * values[i];
  }
  if (!(scale.minCoeff() > 0) || !scale.allFinite()) return false;
  scale = scale.cwiseSqrt().cwiseInverse();
  for (Eigen::Index i = 0; i < jacobian.nonZeros(); ++i) values[i] *= scale[columns[i]];
  return true;
}

// The least eigenvalue of J^T J, by inverse iteration. Its last step takes J itself, so that what
// is zero comes out as the square of rounding, while the last pivot may be a thousand roundings.
double leastEigenvalue(const Eigen::Map<SparseRows>& jacobian,
                       const Eigen::SimplicialLDLT<SparseMatrix>& factor) {
  Eigen::VectorXd v(jacobian.cols());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = std::sin(1 + 1.7 * static_cast<double>(i));
  for (int i = 0; i < 4; ++i) v = Eigen::VectorXd(factor.solve(v)).normalized();
  return (jacobian * v).squaredNorm();
}

}  // namespace

BlockCovariances blockCovariances(ceres::Problem& problem, const std::vector<double*>& free,
                                  const std::vector<double*>& wanted) {
  BlockCovariances result;
  const char* const kFree =
      "The normal equations have no inverse: something is not determined, such as position, "
      "orientation or scale of the whole. Fix a pose, or give a prior.";
  if (free.empty()) {
    result.is_valid = true;
    return result;
  }
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = free;
  ceres::CRSMatrix jacobian;
  double cost = 0;
  const SilentGlog silence;
  if (!problem.Evaluate(options, &cost, nullptr, nullptr, &jacobian)) {
    result.message = "The residuals have no value here.";
    return result;
  }
  result.message = kFree;
  if (jacobian.num_rows == 0) return result;
  Eigen::Map<SparseRows> j(jacobian.num_rows, jacobian.num_cols,
                           static_cast<int>(jacobian.values.size()), jacobian.rows.data(),
                           jacobian.cols.data(), jacobian.values.data());
  Eigen::VectorXd scale;
  if (!scaleColumns(j, scale)) return result;
  const SparseMatrix normal = j.transpose() * j;
  const Eigen::SimplicialLDLT<SparseMatrix> factor(normal);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0)) return result;
  if (!(leastEigenvalue(j, factor) > kLeastEigenvalue)) return result;
  std::map<const double*, Eigen::Index> columns;
  Eigen::Index column = 0;
  for (double* const block : free) {
    columns[block] = column;
    column += problem.ParameterBlockTangentSize(block);
  }
  for (double* const block : wanted) {
    const Eigen::Index first = columns.at(block), size = problem.ParameterBlockTangentSize(block);
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(column, size);
    for (Eigen::Index i = 0; i < size; ++i) unit(first + i, i) = scale[first + i];
    const Eigen::MatrixXd part = Eigen::MatrixXd(factor.solve(unit)).middleRows(first, size);
    std::vector<double> values;
    for (Eigen::Index r = 0; r < size; ++r) {
      for (Eigen::Index c = 0; c < size; ++c) {
        const double a = scale[first + r] * part(r, c), b = scale[first + c] * part(c, r);
        values.push_back((a + b) / 2);
      }
    }
    result.blocks.push_back(std::move(values));
  }
  result.is_valid = true;
  result.message.clear();
  return result;
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
