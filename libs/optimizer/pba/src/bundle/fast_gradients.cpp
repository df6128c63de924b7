#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "bundle/fast_solve.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr int kPowers = 4;  // of the series beyond its first term

double dotInFour(const std::vector<double>& a, const std::vector<double>& b) {
  double sums[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= a.size(); i += 4) {
    for (std::size_t k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
  }
  for (; i < a.size(); ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

void addScaled(double factor, const std::vector<double>& a, std::vector<double>& sum) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * a[i];
}

// The inverse of a block, its lower triangle given; that of its diagonal where it has none.
template <int kFreedom>
void invertBlock(const double* block, double* inverse) {
  using Block = Eigen::Matrix<double, kFreedom, kFreedom>;
  Block a;
  for (int r = 0; r < kFreedom; ++r) {
    for (int c = 0; c <= r; ++c) {
      a(r, c) = a(c, r) =
          block[placeInBlock(static_cast<std::size_t>(r), static_cast<std::size_t>(c))];
    }
  }
  const Eigen::LLT<Block> factor(a);
  Block result = Block::Identity();
  if (factor.info() == Eigen::Success) {
    factor.solveInPlace(result);
  } else {
    for (int r = 0; r < kFreedom; ++r) result(r, r) = a(r, r) > 0 ? 1 / a(r, r) : 1.0;
  }
  std::copy_n(result.data(), kFreedom * kFreedom, inverse);
}

template <int kFreedom>
void multiplyBlocks(const std::vector<double>& blocks, const std::vector<double>& r,
                    std::vector<double>& z) {
  constexpr std::size_t kSize = kFreedom;
  for (std::size_t b = 0; b * kSize < r.size(); ++b) {
    const double* const a = blocks.data() + b * kSize * kSize;
    double sums[kSize] = {};
    for (std::size_t c = 0; c < kSize; ++c) {
      const double x = r[b * kSize + c];
      for (std::size_t k = 0; k < kSize; ++k) sums[k] += a[c * kSize + k] * x;
    }
    std::copy_n(sums, kSize, z.begin() + static_cast<std::ptrdiff_t>(b * kSize));
  }
}

}  // namespace

template <class T>
bool FastGradients<T>::prepare(const FastSchur<T>& schur) {
  const std::size_t n = schur.size(), d = schur.freedom();
  for (std::vector<double>* v : {&r_, &z_, &p_, &q_, &term_, &product_}) v->resize(n);
  inverses_.resize(schur.blocks() * d * d);
  const bool of_whole =
      kind_ == PreconditionerKind::BlockJacobi || kind_ == PreconditionerKind::PowerSeries;
  for (std::size_t b = 0; b < schur.blocks(); ++b) {
    const double* const block = of_whole ? schur.whole(b) : schur.diagonal(b);
    double* const inverse = inverses_.data() + b * d * d;
    d == 9 ? invertBlock<9>(block, inverse) : invertBlock<6>(block, inverse);
  }
  return std::all_of(inverses_.begin(), inverses_.end(), [](double x) { return std::isfinite(x); });
}

template <class T>
void FastGradients<T>::applyInverses(const FastSchur<T>& schur, const std::vector<double>& r,
                                     std::vector<double>& z) const {
  schur.freedom() == 9 ? multiplyBlocks<9>(inverses_, r, z) : multiplyBlocks<6>(inverses_, r, z);
}

// With B the whole diagonal and A = B - E: A^-1 = sum of (B^-1 E)^i B^-1 (Weber, Demmel et al.,
// "Power Bundle Adjustment", CVPR 2023, eq. 10), where B^-1 E t = t - B^-1 A t.
template <class T>
void FastGradients<T>::precondition(FastSchur<T>& schur, const std::vector<double>& r,
                                    std::vector<double>& z) {
  applyInverses(schur, r, z);
  if (kind_ != PreconditionerKind::PowerSeries) return;
  term_ = z;
  for (int i = 0; i < kPowers; ++i) {
    schur.multiply(term_, product_);
    applyInverses(schur, product_, product_);
    addScaled(-1, product_, term_);
    addScaled(1, term_, z);
  }
}

template <class T>
bool FastGradients<T>::solve(FastSchur<T>& schur, const OptimizerOptions& options,
                             std::vector<double>& step, std::size_t& iterations) {
  iterations = 0;
  if (!prepare(schur)) return false;
  const std::vector<double>& right = schur.rightSide();
  std::fill(step.begin(), step.end(), 0.0);
  r_ = right;
  precondition(schur, r_, z_);
  p_ = z_;
  double rho = dotInFour(r_, z_);
  if (rho == 0) return true;
  // Exactness is cheap where the equations are dear: with C products for the price of the matrix,
  // iterations go on while the next lowers the model by more than a part of what one lowered it so
  // far, the C among them. With C = 0 that is the rule of S. G. Nash, A. Sofer, "Assessing a search
  // direction within a truncated-Newton method", 1990; with it, that of E. L. Charnov, "Optimal
  // foraging, the marginal value theorem", 1976.
  const double of_iteration = kind_ == PreconditionerKind::PowerSeries ? 1 + kPowers : 1;
  const double patience = schur.productsOfBuild() / of_iteration;
  const double tolerance = options.linear_tolerance;
  const double least_rho = tolerance * tolerance * rho / (1 + patience);
  double model = 0;  // by how much x lowers it
  while (iterations < options.max_linear_iterations) {
    schur.multiply(p_, q_);
    const double curvature = dotInFour(p_, q_);
    if (!(curvature > 0) || !std::isfinite(rho)) break;  // rounding: what is there must do
    const double alpha = rho / curvature;
    addScaled(alpha, p_, step);
    addScaled(-alpha, q_, r_);
    ++iterations;
    const double new_model = (dotInFour(step, right) + dotInFour(step, r_)) / 2;
    precondition(schur, r_, z_);
    const double new_rho = dotInFour(r_, z_);
    const double price = patience + static_cast<double>(iterations);
    const bool is_flat = price * (new_model - model) < tolerance * new_model;
    if (is_flat || !(new_rho > least_rho)) break;
    const double beta = new_rho / rho;
    for (std::size_t i = 0; i < p_.size(); ++i) p_[i] = z_[i] + beta * p_[i];
    rho = new_rho;
    model = new_model;
  }
  return iterations > 0 &&
         std::all_of(step.begin(), step.end(), [](double x) { return std::isfinite(x); });
}

template class FastGradients<float>;
template class FastGradients<double>;

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
