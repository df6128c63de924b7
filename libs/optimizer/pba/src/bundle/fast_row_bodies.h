// Loops over the observations or points of a task; part of fast_kernels.h for one target region,
// included once for each, so without an include guard, with GSLAM_DETAIL_VARIANT the name of a
// namespace. Compilers turn loops over j into vectors of what the region allows.
#ifdef GSLAM_DETAIL_VARIANT
namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {
namespace GSLAM_DETAIL_VARIANT {

inline void scale(const double* __restrict factors, double* __restrict rows, std::size_t stride,
                  std::size_t count, std::size_t n) {
  for (std::size_t row = 0; row < count; ++row) {
    double* __restrict const numbers = rows + row * stride;
    for (std::size_t j = 0; j < n; ++j) numbers[j] *= factors[j];
  }
}

// Rows (u, v) become (a u + b v, c v); roots: three rows of n.
inline void whiten(const double* __restrict roots, double* __restrict rows, std::size_t stride,
                   std::size_t width, std::size_t n) {
  for (std::size_t k = 0; k < width; ++k) {
    double* __restrict const u = rows + k * stride;
    double* __restrict const v = u + width * stride;
    for (std::size_t j = 0; j < n; ++j) {
      u[j] = roots[j] * u[j] + roots[n + j] * v[j];
      v[j] *= roots[2 * n + j];
    }
  }
}

inline void products(double* __restrict rows, std::size_t stride, std::size_t n) {
  const double* __restrict const r = rows + kResidual * stride;
  const double* __restrict const p = rows + kByPoint * stride;
  double* __restrict const h = rows + kProducts * stride;
  for (std::size_t j = 0; j < n; ++j) {
    const double a0 = p[j], a1 = p[stride + j], a2 = p[2 * stride + j];
    const double b0 = p[3 * stride + j], b1 = p[4 * stride + j], b2 = p[5 * stride + j];
    const double u = r[j], v = r[stride + j];
    h[j] = a0 * a0 + b0 * b0;
    h[stride + j] = a0 * a1 + b0 * b1;
    h[2 * stride + j] = a0 * a2 + b0 * b2;
    h[3 * stride + j] = a1 * a1 + b1 * b1;
    h[4 * stride + j] = a1 * a2 + b1 * b2;
    h[5 * stride + j] = a2 * a2 + b2 * b2;
    h[6 * stride + j] = a0 * u + b0 * v;
    h[7 * stride + j] = a1 * u + b1 * v;
    h[8 * stride + j] = a2 * u + b2 * v;
  }
}

inline double boundedDiagonal(double h) {
  const double above = h > kLeastDiagonal ? h : kLeastDiagonal;
  return above < kMostDiagonal ? above : kMostDiagonal;
}

// L L^T = H + damping D; pivots that rounding has eaten are kept above it.
inline void factorPoints(double* __restrict rows, std::size_t stride, std::size_t n,
                         double damping) {
  const double* __restrict const h = rows + kHessian * stride;
  double* __restrict const l = rows + kInverse * stride;
  double* __restrict const u = rows + kU * stride;
  double* __restrict const d = rows + kDamped * stride;
  for (std::size_t j = 0; j < n; ++j) {
    const double d0 = damping * boundedDiagonal(h[j]);
    const double d1 = damping * boundedDiagonal(h[3 * stride + j]);
    const double d2 = damping * boundedDiagonal(h[5 * stride + j]);
    const double h00 = h[j] + d0, h11 = h[3 * stride + j] + d1, h22 = h[5 * stride + j] + d2;
    const double h01 = h[stride + j], h02 = h[2 * stride + j], h12 = h[4 * stride + j];
    const double i00 = 1 / std::sqrt(h00);
    const double l10 = h01 * i00, l20 = h02 * i00;
    const double p11 = h11 - l10 * l10, least11 = 1e-14 * h11;
    const double i11 = 1 / std::sqrt(p11 > least11 ? p11 : least11);
    const double l21 = (h12 - l20 * l10) * i11;
    const double p22 = h22 - l20 * l20 - l21 * l21, least22 = 1e-14 * h22;
    const double i22 = 1 / std::sqrt(p22 > least22 ? p22 : least22);
    const double i10 = -l10 * i00 * i11;
    const double i21 = -l21 * i11 * i22;
    const double i20 = -(l20 * i00 + l21 * i10) * i22;
    const double g0 = h[6 * stride + j], g1 = h[7 * stride + j], g2 = h[8 * stride + j];
    l[j] = i00;
    l[stride + j] = i10;
    l[2 * stride + j] = i11;
    l[3 * stride + j] = i20;
    l[4 * stride + j] = i21;
    l[5 * stride + j] = i22;
    u[j] = i00 * g0;
    u[stride + j] = i10 * g0 + i11 * g1;
    u[2 * stride + j] = i20 * g0 + i21 * g1 + i22 * g2;
    d[j] = d0;
    d[stride + j] = d1;
    d[2 * stride + j] = d2;
  }
}

inline void eliminate(double* __restrict rows, std::size_t stride, std::size_t n) {
  const double* __restrict const r = rows + kResidual * stride;
  const double* __restrict const p = rows + kByPoint * stride;
  const double* __restrict const l = rows + kFactor * stride;
  double* __restrict const half = rows + kHalf * stride;
  double* __restrict const root = rows + kRoot * stride;
  double* __restrict const reduced = rows + kReduced * stride;
  for (std::size_t j = 0; j < n; ++j) {
    const double l00 = l[j], l10 = l[stride + j], l11 = l[2 * stride + j];
    const double l20 = l[3 * stride + j], l21 = l[4 * stride + j], l22 = l[5 * stride + j];
    const double a0 = p[j], a1 = p[stride + j], a2 = p[2 * stride + j];
    const double b0 = p[3 * stride + j], b1 = p[4 * stride + j], b2 = p[5 * stride + j];
    const double x0 = a0 * l00, x1 = a0 * l10 + a1 * l11, x2 = a0 * l20 + a1 * l21 + a2 * l22;
    const double y0 = b0 * l00, y1 = b0 * l10 + b1 * l11, y2 = b0 * l20 + b1 * l21 + b2 * l22;
    const double m00 = 1 - (x0 * x0 + x1 * x1 + x2 * x2);
    const double m01 = -(x0 * y0 + x1 * y1 + x2 * y2);
    const double m11 = 1 - (y0 * y0 + y1 * y1 + y2 * y2);
    const double safe00 = m00 > 1e-15 ? m00 : 1e-15;
    const double root00 = std::sqrt(safe00), root01 = m01 / root00;
    const double rest = m11 - root01 * root01;
    half[j] = x0;
    half[stride + j] = x1;
    half[2 * stride + j] = x2;
    half[3 * stride + j] = y0;
    half[4 * stride + j] = y1;
    half[5 * stride + j] = y2;
    root[j] = root00;
    root[stride + j] = root01;
    root[2 * stride + j] = std::sqrt(rest > 0 ? rest : 0.0);
    const double u0 = l[6 * stride + j], u1 = l[7 * stride + j], u2 = l[8 * stride + j];
    reduced[j] = r[j] - (x0 * u0 + x1 * u1 + x2 * u2);
    reduced[stride + j] = r[stride + j] - (y0 * u0 + y1 * u1 + y2 * u2);
  }
}

inline void pull(double* __restrict rows, std::size_t stride, std::size_t n) {
  const double* __restrict const c = rows + kChange * stride;
  const double* __restrict const p = rows + kByPoint * stride;
  double* __restrict const sums = rows + kProducts * stride;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      sums[i * stride + j] = p[i * stride + j] * c[j] + p[(3 + i) * stride + j] * c[stride + j];
    }
  }
}

inline double modelDecrease(const double* rows, std::size_t stride, std::size_t n) {
  const double* const r = rows + kResidual * stride;
  const double* const p = rows + kByPoint * stride;
  const double* const c = rows + kChange * stride;
  const double* const d = rows + kPointStep * stride;
  double sums[8] = {};
  for (std::size_t first = 0; first < n; first += 8) {
    for (std::size_t k = 0; k < 8; ++k) {  // beyond n rows have numbers, too
      const std::size_t j = first + k;
      const double d0 = d[j], d1 = d[stride + j], d2 = d[2 * stride + j];
      const double m0 = c[j] + p[j] * d0 + p[stride + j] * d1 + p[2 * stride + j] * d2;
      const double m1 =
          c[stride + j] + p[3 * stride + j] * d0 + p[4 * stride + j] * d1 + p[5 * stride + j] * d2;
      const double part = m0 * (r[j] + m0 / 2) + m1 * (r[stride + j] + m1 / 2);
      sums[k] -= j < n ? part : 0.0;
    }
  }
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

}  // namespace GSLAM_DETAIL_VARIANT
}  // namespace
}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif
