// The loops over matches. Included once for each SIMD variant, see kernels.cpp: compilers turn the
// loops over j into vectors of what the region allows.
#ifdef GSLAM_DETAIL_VARIANT
namespace gslam {
inline namespace v1 {
namespace detail {
namespace {
namespace GSLAM_DETAIL_VARIANT {

// e^2 / g of the plane: with lines m = E^T x2 and n = E x1, g = m0^2 + m1^2 + n0^2 + n1^2. The
// least g only keeps 0 / 0 away, where a point is the epipole.
inline void sampsonPlane(const float* e, float factor, const float* const* columns,
                         std::size_t first, std::size_t count, float* __restrict squared) {
  const float* __restrict x1 = columns[0] + first;
  const float* __restrict y1 = columns[1] + first;
  const float* __restrict x2 = columns[2] + first;
  const float* __restrict y2 = columns[3] + first;
  const float e0 = e[0], e1 = e[1], e2 = e[2], e3 = e[3], e4 = e[4], e5 = e[5], e6 = e[6];
  const float e7 = e[7], e8 = e[8];
  for (std::size_t j = 0; j < count; ++j) {
    const float n0 = e0 * x1[j] + e1 * y1[j] + e2;
    const float n1 = e3 * x1[j] + e4 * y1[j] + e5;
    const float n2 = e6 * x1[j] + e7 * y1[j] + e8;
    const float m0 = e0 * x2[j] + e3 * y2[j] + e6;
    const float m1 = e1 * x2[j] + e4 * y2[j] + e7;
    const float error = n0 * x2[j] + n1 * y2[j] + n2;
    const float g = m0 * m0 + m1 * m1 + n0 * n0 + n1 * n1 + 1e-30f;
    squared[j] = factor * (error * error) / g;
  }
}

// Unit bearings: what lies along a bearing is taken out of its line.
inline void sampsonSphere(const float* e, float factor, const float* const* columns,
                          std::size_t first, std::size_t count, float* __restrict squared) {
  const float* __restrict x1 = columns[0] + first;
  const float* __restrict y1 = columns[1] + first;
  const float* __restrict z1 = columns[2] + first;
  const float* __restrict x2 = columns[3] + first;
  const float* __restrict y2 = columns[4] + first;
  const float* __restrict z2 = columns[5] + first;
  const float e0 = e[0], e1 = e[1], e2 = e[2], e3 = e[3], e4 = e[4], e5 = e[5], e6 = e[6];
  const float e7 = e[7], e8 = e[8];
  for (std::size_t j = 0; j < count; ++j) {
    const float n0 = e0 * x1[j] + e1 * y1[j] + e2 * z1[j];
    const float n1 = e3 * x1[j] + e4 * y1[j] + e5 * z1[j];
    const float n2 = e6 * x1[j] + e7 * y1[j] + e8 * z1[j];
    const float m0 = e0 * x2[j] + e3 * y2[j] + e6 * z2[j];
    const float m1 = e1 * x2[j] + e4 * y2[j] + e7 * z2[j];
    const float m2 = e2 * x2[j] + e5 * y2[j] + e8 * z2[j];
    const float error = n0 * x2[j] + n1 * y2[j] + n2 * z2[j];
    const float g =
        m0 * m0 + m1 * m1 + m2 * m2 + n0 * n0 + n1 * n1 + n2 * n2 - 2 * (error * error) + 1e-30f;
    squared[j] = factor * (error * error) / g;
  }
}

// Bearings with the two directions in which a pixel moves them: b1, b2, then columns of J1, of J2.
inline void sampsonFrames(const float* e, float factor, const float* const* columns,
                          std::size_t first, std::size_t count, float* __restrict squared) {
  const float* __restrict c[18];
  for (std::size_t k = 0; k < 18; ++k) c[k] = columns[k] + first;
  const float e0 = e[0], e1 = e[1], e2 = e[2], e3 = e[3], e4 = e[4], e5 = e[5], e6 = e[6];
  const float e7 = e[7], e8 = e[8];
  for (std::size_t j = 0; j < count; ++j) {
    const float x1 = c[0][j], y1 = c[1][j], z1 = c[2][j];
    const float x2 = c[3][j], y2 = c[4][j], z2 = c[5][j];
    const float n0 = e0 * x1 + e1 * y1 + e2 * z1;
    const float n1 = e3 * x1 + e4 * y1 + e5 * z1;
    const float n2 = e6 * x1 + e7 * y1 + e8 * z1;
    const float m0 = e0 * x2 + e3 * y2 + e6 * z2;
    const float m1 = e1 * x2 + e4 * y2 + e7 * z2;
    const float m2 = e2 * x2 + e5 * y2 + e8 * z2;
    const float error = n0 * x2 + n1 * y2 + n2 * z2;
    const float a0 = m0 * c[6][j] + m1 * c[7][j] + m2 * c[8][j];
    const float a1 = m0 * c[9][j] + m1 * c[10][j] + m2 * c[11][j];
    const float b0 = n0 * c[12][j] + n1 * c[13][j] + n2 * c[14][j];
    const float b1 = n0 * c[15][j] + n1 * c[16][j] + n2 * c[17][j];
    const float g = a0 * a0 + a1 * a1 + b0 * b0 + b1 * b1 + 1e-30f;
    squared[j] = factor * (error * error) / g;
  }
}

// Points on the plane of a pinhole camera: X Y Z, then what was observed. `p` is the 3 x 4 matrix
// to that plane.
inline void reprojectPlane(const float* p, float factor, const float* const* columns,
                           std::size_t first, std::size_t count, float* __restrict squared) {
  const float* __restrict x = columns[0] + first;
  const float* __restrict y = columns[1] + first;
  const float* __restrict z = columns[2] + first;
  const float* __restrict u = columns[3] + first;
  const float* __restrict v = columns[4] + first;
  const float p0 = p[0], p1 = p[1], p2 = p[2], p3 = p[3], p4 = p[4], p5 = p[5], p6 = p[6];
  const float p7 = p[7], p8 = p[8], p9 = p[9], p10 = p[10], p11 = p[11];
  for (std::size_t j = 0; j < count; ++j) {
    const float a = p0 * x[j] + p1 * y[j] + p2 * z[j] + p3;
    const float b = p4 * x[j] + p5 * y[j] + p6 * z[j] + p7;
    const float depth = p8 * x[j] + p9 * y[j] + p10 * z[j] + p11;
    const float inverse = 1 / depth;
    const float ru = a * inverse - u[j];
    const float rv = b * inverse - v[j];
    const float behind = depth > 0 ? 0.0f : INFINITY;
    squared[j] = factor * (ru * ru + rv * rv) + behind;
  }
}

// X Y Z, two rows A, the bearing b, and the place o that it starts from: A q / (b q) where
// q = R X + t - o.
inline void reprojectFrames(const float* p, float factor, const float* const* columns,
                            std::size_t first, std::size_t count, float* __restrict squared) {
  const float* __restrict c[15];
  for (std::size_t k = 0; k < 15; ++k) c[k] = columns[k] + first;
  const float p0 = p[0], p1 = p[1], p2 = p[2], p3 = p[3], p4 = p[4], p5 = p[5], p6 = p[6];
  const float p7 = p[7], p8 = p[8], p9 = p[9], p10 = p[10], p11 = p[11];
  for (std::size_t j = 0; j < count; ++j) {
    const float x = c[0][j], y = c[1][j], z = c[2][j];
    const float q0 = p0 * x + p1 * y + p2 * z + p3 - c[12][j];
    const float q1 = p4 * x + p5 * y + p6 * z + p7 - c[13][j];
    const float q2 = p8 * x + p9 * y + p10 * z + p11 - c[14][j];
    const float depth = q0 * c[9][j] + q1 * c[10][j] + q2 * c[11][j];
    const float inverse = 1 / depth;
    const float ru = (q0 * c[3][j] + q1 * c[4][j] + q2 * c[5][j]) * inverse;
    const float rv = (q0 * c[6][j] + q1 * c[7][j] + q2 * c[8][j]) * inverse;
    const float behind = depth > 0 ? 0.0f : INFINITY;
    squared[j] = factor * (ru * ru + rv * rv) + behind;
  }
}

// Sum of products of two rows of a block.
inline double dotBlock(const double* a, const double* b) {
  double lanes[kBlockLanes] = {};
#if GSLAM_HAS_VECTORS
  using Wide = double __attribute__((vector_size(8 * kBlockLanes)));
  Wide sum{};
  for (std::size_t j = 0; j < kBlock; j += kBlockLanes) {
    Wide x, y;
    std::memcpy(&x, a + j, sizeof(x));
    std::memcpy(&y, b + j, sizeof(y));
    sum += x * y;
  }
  std::memcpy(lanes, &sum, sizeof(sum));
#else
  for (std::size_t j = 0; j < kBlock; j += kBlockLanes) {
    for (std::size_t l = 0; l < kBlockLanes; ++l) lanes[l] += a[j + l] * b[j + l];
  }
#endif
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

// Adds J^T J and J^T r of a block to the upper triangle of `hessian`, rows of `size` columns.
template <std::size_t size>
void addBlock(const double (*jacobian)[kBlock], const double* residual, double* hessian,
              double* gradient) {
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = a; b < size; ++b) {
      hessian[a * size + b] += dotBlock(jacobian[a], jacobian[b]);
    }
    gradient[a] += dotBlock(jacobian[a], residual);
  }
}

// Derivatives of e / sqrt(g) by the nine elements: with k1 = J1 J1^T m, k2 = J2 J2^T n,
// (b2 (b1 - e/g k1)^T - e/g k2 b1^T) / sqrt(g).
template <EpipolarKind kind>
void sampsonBlock(const double* e, const EpipolarBlock& in, EpipolarSums& sums) {
  double jacobian[9][kBlock];
  double residual[kBlock];
  const double(&c)[18][kBlock] = in.columns;
  for (std::size_t j = 0; j < kBlock; ++j) {
    const bool is_plane = kind == EpipolarKind::Plane;
    const double x1 = c[0][j], y1 = c[1][j], z1 = is_plane ? 1 : c[2][j];
    const double x2 = is_plane ? c[2][j] : c[3][j], y2 = is_plane ? c[3][j] : c[4][j];
    const double z2 = is_plane ? 1 : c[5][j];
    const double n0 = e[0] * x1 + e[1] * y1 + e[2] * z1;
    const double n1 = e[3] * x1 + e[4] * y1 + e[5] * z1;
    const double n2 = e[6] * x1 + e[7] * y1 + e[8] * z1;
    const double m0 = e[0] * x2 + e[3] * y2 + e[6] * z2;
    const double m1 = e[1] * x2 + e[4] * y2 + e[7] * z2;
    const double m2 = e[2] * x2 + e[5] * y2 + e[8] * z2;
    const double error = n0 * x2 + n1 * y2 + n2 * z2;
    double k0, k1, k2, l0, l1, l2;
    if (kind == EpipolarKind::Plane) {
      k0 = m0, k1 = m1, k2 = 0, l0 = n0, l1 = n1, l2 = 0;
    } else if (kind == EpipolarKind::Sphere) {
      k0 = m0 - error * x1, k1 = m1 - error * y1, k2 = m2 - error * z1;
      l0 = n0 - error * x2, l1 = n1 - error * y2, l2 = n2 - error * z2;
    } else {
      const double a0 = m0 * c[6][j] + m1 * c[7][j] + m2 * c[8][j];
      const double a1 = m0 * c[9][j] + m1 * c[10][j] + m2 * c[11][j];
      const double b0 = n0 * c[12][j] + n1 * c[13][j] + n2 * c[14][j];
      const double b1 = n0 * c[15][j] + n1 * c[16][j] + n2 * c[17][j];
      k0 = a0 * c[6][j] + a1 * c[9][j], k1 = a0 * c[7][j] + a1 * c[10][j];
      k2 = a0 * c[8][j] + a1 * c[11][j];
      l0 = b0 * c[12][j] + b1 * c[15][j], l1 = b0 * c[13][j] + b1 * c[16][j];
      l2 = b0 * c[14][j] + b1 * c[17][j];
    }
    const double g = m0 * k0 + m1 * k1 + m2 * k2 + n0 * l0 + n1 * l1 + n2 * l2 + 1e-60;
    const double root = std::sqrt(in.weights[j] / g);
    const double ratio = error / g;
    const double u0 = root * (x1 - ratio * k0), u1 = root * (y1 - ratio * k1);
    const double u2 = root * (z1 - ratio * k2);
    const double v = -root * ratio;
    const double v0 = v * l0, v1 = v * l1, v2 = v * l2;
    residual[j] = root * error;
    jacobian[0][j] = x2 * u0 + v0 * x1;
    jacobian[1][j] = x2 * u1 + v0 * y1;
    jacobian[2][j] = x2 * u2 + v0 * z1;
    jacobian[3][j] = y2 * u0 + v1 * x1;
    jacobian[4][j] = y2 * u1 + v1 * y1;
    jacobian[5][j] = y2 * u2 + v1 * z1;
    jacobian[6][j] = z2 * u0 + v2 * x1;
    jacobian[7][j] = z2 * u1 + v2 * y1;
    jacobian[8][j] = z2 * u2 + v2 * z1;
  }
  addBlock<9>(jacobian, residual, sums.hessian, sums.gradient);
  sums.cost += dotBlock(residual, residual);
}

// Derivatives of A q / (b q) by the right tangent of the inverse pose: q moves by -rho - omega x p
// where p = q + o, so that a row d of (A - r b^T) / (b q) becomes (-d, d x p).
inline void reprojectBlock(const double* p, const PoseBlock& in, PoseSums& sums) {
  double jacobian[2][6][kBlock];
  double residual[2][kBlock];
  const double(&c)[15][kBlock] = in.columns;
  for (std::size_t j = 0; j < kBlock; ++j) {
    const double x = c[0][j], y = c[1][j], z = c[2][j];
    const double p0 = p[0] * x + p[1] * y + p[2] * z + p[3];
    const double p1 = p[4] * x + p[5] * y + p[6] * z + p[7];
    const double p2 = p[8] * x + p[9] * y + p[10] * z + p[11];
    const double q0 = p0 - c[12][j], q1 = p1 - c[13][j], q2 = p2 - c[14][j];
    const double inverse = 1 / (q0 * c[9][j] + q1 * c[10][j] + q2 * c[11][j]);
    const double root = std::sqrt(in.weights[j]);
    for (std::size_t k = 0; k < 2; ++k) {
      const double a0 = c[3 + 3 * k][j], a1 = c[4 + 3 * k][j], a2 = c[5 + 3 * k][j];
      const double r = (q0 * a0 + q1 * a1 + q2 * a2) * inverse;
      const double factor = root * inverse;
      const double d0 = factor * (a0 - r * c[9][j]), d1 = factor * (a1 - r * c[10][j]);
      const double d2 = factor * (a2 - r * c[11][j]);
      residual[k][j] = root * r;
      jacobian[k][0][j] = -d0;
      jacobian[k][1][j] = -d1;
      jacobian[k][2][j] = -d2;
      jacobian[k][3][j] = d1 * p2 - d2 * p1;
      jacobian[k][4][j] = d2 * p0 - d0 * p2;
      jacobian[k][5][j] = d0 * p1 - d1 * p0;
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    addBlock<6>(jacobian[k], residual[k], sums.hessian, sums.gradient);
    sums.cost += dotBlock(residual[k], residual[k]);
  }
}

}  // namespace GSLAM_DETAIL_VARIANT
}  // namespace
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif
