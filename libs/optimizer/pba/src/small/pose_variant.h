// The kernels of pose_kernel.cpp for one target region; included once for each, so without an
// include guard, with GSLAM_POSE_VARIANT the name of a namespace, GSLAM_POSE_WIDTH the doubles of a
// register, and GSLAM_POSE_ROOT(x) the square root of a register.
namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {
namespace GSLAM_POSE_VARIANT {

#if GSLAM_POSE_WIDTH == 1
typedef double Register;
typedef long long Bits;
#else
typedef double Register __attribute__((vector_size(8 * GSLAM_POSE_WIDTH)));
typedef long long Bits __attribute__((vector_size(8 * GSLAM_POSE_WIDTH)));
#endif

// Handed on by reference, since registers that a caller may not have cannot be returned.
GSLAM_ALWAYS_INLINE void load(const double* from, Register& r) {
  std::memcpy(&r, from, sizeof(r));
}
GSLAM_ALWAYS_INLINE void store(double* to, const Register& r) {
  std::memcpy(to, &r, sizeof(r));
}

// Half of the lanes to the first one, half to the second.
GSLAM_ALWAYS_INLINE void addLanes(const Register& r, double (&to)[2]) {
#if GSLAM_POSE_WIDTH == 1
  to[0] += r;
#else
  typedef double Half __attribute__((vector_size(16)));
  Half sum, part;
  std::memcpy(&sum, to, sizeof(sum));
  for (std::size_t i = 0; i < GSLAM_POSE_WIDTH / 2; ++i) {
    std::memcpy(&part, reinterpret_cast<const char*>(&r) + i * sizeof(part), sizeof(part));
    sum += part;
  }
  std::memcpy(to, &sum, sizeof(sum));
#endif
}

// The sum of log(f) is the log of the product, whose exponents are put aside as they come.
struct LogSum {
  Register mantissa;
  Bits exponent;
  GSLAM_ALWAYS_INLINE LogSum() : mantissa(Register{} + 1.0), exponent(Bits{}) {}
  GSLAM_ALWAYS_INLINE void multiply(const Register& factor) {
    const Register product = mantissa * factor;
    Bits bits;
    std::memcpy(&bits, &product, sizeof(bits));
    exponent += (bits >> 52) - 1023;
    bits = (bits & 0xfffffffffffffLL) | 0x3ff0000000000000LL;
    std::memcpy(&mantissa, &bits, sizeof(bits));
  }
  GSLAM_ALWAYS_INLINE double total() const {
    double factors[GSLAM_POSE_WIDTH];
    long long exponents[GSLAM_POSE_WIDTH];
    std::memcpy(factors, &mantissa, sizeof(factors));
    std::memcpy(exponents, &exponent, sizeof(exponents));
    double product = 1;
    long long twos = 0;
    for (std::size_t i = 0; i < GSLAM_POSE_WIDTH; ++i) {
      product *= factors[i];
      twos += exponents[i];
    }
    return logOfProduct(product, twos);
  }
};

// As lossAt(), but the second derivative is `curve`; of Cauchy's rho what is not in `logs`.
GSLAM_ALWAYS_INLINE void lossLanes(const PoseLoss& loss, const Register& s, Register& rho,
                                   Register& weight, Register& curve, LogSum& logs) {
  const Register zero = Register{}, one = zero + 1.0;
  rho = s;
  weight = one;
  curve = zero;
  switch (loss.kind) {
    case LossKind::Squared:
      return;
    case LossKind::Huber: {
      const Register bounded = s > loss.a2 ? s : zero + loss.a2;
      const Register ratio = loss.a2 / bounded;
      weight = GSLAM_POSE_ROOT(ratio);  // a / sqrt(s), and 1 within
      rho = s > loss.a2 ? 2 * weight * s - loss.a2 : s;
      curve = s > loss.a2 ? -0.5 * loss.inverse_a2 * weight * ratio : zero;
      return;
    }
    case LossKind::Cauchy: {
      const Register t = s * loss.inverse_a2, sum = 1 + t;
      // Small ones are summed themselves: the log of a product has the rounding of 1.
      const Register series =
          t * (1 - t * (1.0 / 2 -
                        t * (1.0 / 3 -
                             t * (1.0 / 4 -
                                  t * (1.0 / 5 - t * (1.0 / 6 - t * (1.0 / 7 - t * (1.0 / 8))))))));
      rho = t < 0.01 ? loss.a2 * series : zero;
      logs.multiply(t < 0.01 ? one : sum);
      weight = 1 / sum;
      curve = -loss.inverse_a2 * weight * weight;
      return;
    }
    case LossKind::Tukey: {
      const Register t = s < loss.a2 ? s * loss.inverse_a2 : one, u = 1 - t;
      rho = (loss.a2 / 3) * t * (3 - t * (3 - t));
      weight = u * u;
      curve = -2 * loss.inverse_a2 * u;
      return;
    }
    case LossKind::GemanMcClure: {
      const Register u = 1 / (1 + s * loss.inverse_a2);
      rho = u * s;
      weight = u * u;
      curve = -2 * loss.inverse_a2 * u * weight;
      return;
    }
  }
}

// The place on the plane z = 1 and its image, with the derivatives d.
struct Flat {
  Register x, y, inverse, image_x, image_y, d00, d01, d11;
};

GSLAM_ALWAYS_INLINE void distort(const PoseCamera& c, Flat& f) {
  const Register xx = f.x * f.x, yy = f.y * f.y, xy = f.x * f.y, s = xx + yy;
  const Register g = 1 + s * (c.k1 + s * (c.k2 + s * c.k3));
  const Register slope = c.k1 + s * (2 * c.k2 + s * (3 * c.k3));
  f.image_x = f.x * g + 2 * c.p1 * xy + c.p2 * (s + 2 * xx);
  f.image_y = f.y * g + c.p1 * (s + 2 * yy) + 2 * c.p2 * xy;
  f.d00 = g + 2 * xx * slope + 2 * c.p1 * f.y + 6 * c.p2 * f.x;
  f.d01 = 2 * (xy * slope + c.p1 * f.x + c.p2 * f.y);
  f.d11 = g + 2 * yy * slope + 6 * c.p1 * f.y + 2 * c.p2 * f.x;
}

// Cost and weights of a register of observations, and what addGroup() needs of them.
GSLAM_ALWAYS_INLINE void weighGroup(PoseFormula formula, const PoseCamera& c, const PoseLoss& loss,
                                    std::size_t at, PoseBlock& block, PoseRows& rows,
                                    Register (&counts)[3], LogSum& logs) {
  const bool is_stereo = formula == PoseFormula::PinholeStereo;
  const Register zero = Register{}, one = zero + 1.0;
  Register x, y, z, u, v, information;
  load(block.x + at, x), load(block.y + at, y), load(block.z + at, z);
  load(block.u + at, u), load(block.v + at, v), load(block.weight + at, information);

  const Register seen = information >= 0 ? one : zero;
  const Register w = information >= 0 ? information : zero;
  const Register depth = c.p[8] * x + c.p[9] * y + c.p[10] * z + c.p[11];
  Flat f;
  f.inverse = 1 / (information >= 0 ? depth : one);
  f.x = (c.p[0] * x + c.p[1] * y + c.p[2] * z + c.p[3]) * f.inverse;
  f.y = (c.p[4] * x + c.p[5] * y + c.p[6] * z + c.p[7]) * f.inverse;
  if (formula == PoseFormula::Radtan) {
    distort(c, f);
  } else {
    f.image_x = f.x, f.image_y = f.y;
  }
  const Register ru = c.fx * f.image_x + c.cx - u, rv = c.fy * f.image_y + c.cy - v;
  Register s = w * (ru * ru + rv * rv), rr = zero, w_right = zero;
  if (is_stereo) {
    Register right;
    load(block.right + at, right);
    w_right = right > kNoRight ? w : zero;
    rr = right > kNoRight ? c.fx * (f.x - c.baseline * f.inverse) + c.cx - right : zero;
    s += w_right * rr * rr;
  }

  Register rho, weight, curve;
  lossLanes(loss, s, rho, weight, curve, logs);
  const Register inlier = weight >= 0.5 ? (depth > 0 ? seen : zero) : zero;
  store(block.inlier + at, inlier);
  counts[0] += rho + 0.0 * s;  // not finite where s is not
  counts[1] += seen;
  counts[2] += inlier;

  const Register ww = w * weight, bend = loss.twice_second * curve * w * w;
  const Register uu = ww + bend * ru * ru, uv = bend * ru * rv, vv = ww + bend * rv * rv;
  Register m00 = c.fx * c.fx * uu, m01 = c.fx * c.fy * uv, m11 = c.fy * c.fy * vv;
  Register pull_x = ww * ru * c.fx, pull_y = ww * rv * c.fy;
  if (formula == PoseFormula::Radtan) {
    const Register a0 = m00 * f.d00 + m01 * f.d01, a1 = m00 * f.d01 + m01 * f.d11;
    const Register b0 = m01 * f.d00 + m11 * f.d01, b1 = m01 * f.d01 + m11 * f.d11;
    m00 = f.d00 * a0 + f.d01 * b0, m01 = f.d00 * a1 + f.d01 * b1, m11 = f.d01 * a1 + f.d11 * b1;
    const Register pull_u = pull_x;
    pull_x = f.d00 * pull_u + f.d01 * pull_y, pull_y = f.d01 * pull_u + f.d11 * pull_y;
  }
  store(rows.x + at, f.x), store(rows.y + at, f.y), store(rows.inverse + at, f.inverse);
  store(rows.m00 + at, m00), store(rows.m01 + at, m01), store(rows.m11 + at, m11);
  store(rows.pull_x + at, pull_x), store(rows.pull_y + at, pull_y);
  if (is_stereo) {
    store(rows.right + at, w_right * weight + bend * rr * rr);
    store(rows.cross_x + at, c.fx * bend * ru * rr),
        store(rows.cross_y + at, c.fy * bend * rv * rr);
    store(rows.pull_right + at, w_right * weight * rr);
  }
}

// The derivatives of (x, y) on the plane by the tangent.
struct Slopes {
  Register x[6], y[6];
  GSLAM_ALWAYS_INLINE Slopes(const Register& at_x, const Register& at_y, const Register& inverse)
      : x{-inverse, Register{}, at_x * inverse, at_x * at_y, -(1 + at_x * at_x), at_y},
        y{Register{}, -inverse, at_y * inverse, 1 + at_y * at_y, -(at_x * at_y), -at_x} {}
};

// H = G^T m G, gradient G^T pull.
GSLAM_ALWAYS_INLINE void addPlane(const Slopes& g, const PoseRows& rows, std::size_t at,
                                  Register* sums) {
  Register m00, m01, m11, pull_x, pull_y, ax[6], ay[6];
  load(rows.m00 + at, m00), load(rows.m01 + at, m01), load(rows.m11 + at, m11);
  load(rows.pull_x + at, pull_x), load(rows.pull_y + at, pull_y);
  ax[0] = m00 * g.x[0], ay[0] = m01 * g.x[0];
  ax[1] = m01 * g.y[1], ay[1] = m11 * g.y[1];
  for (std::size_t j = 2; j < 6; ++j) {
    ax[j] = m00 * g.x[j] + m01 * g.y[j];
    ay[j] = m01 * g.x[j] + m11 * g.y[j];
  }
  for (std::size_t j = 0; j < 6; ++j) sums[j] += g.x[0] * ax[j];
  for (std::size_t j = 1; j < 6; ++j) sums[5 + j] += g.y[1] * ay[j];
  Register* sum = sums + 11;
  for (std::size_t i = 2; i < 6; ++i) {
    for (std::size_t j = i; j < 6; ++j) *sum++ += g.x[i] * ax[j] + g.y[i] * ay[j];
  }
  sums[21] += g.x[0] * pull_x;
  sums[22] += g.y[1] * pull_y;
  for (std::size_t i = 2; i < 6; ++i) sums[21 + i] += g.x[i] * pull_x + g.y[i] * pull_y;
}

// The row of u in the right image, fx (x - baseline / z): H += J^T right J + J^T cross + cross^T
// J, where cross is a row over (x, y) of the coupling with u and v.
GSLAM_ALWAYS_INLINE void addRight(const PoseCamera& c, const Slopes& g, const PoseRows& rows,
                                  std::size_t at, Register* sums) {
  Register x, y, inverse, weight, cross_x, cross_y, pull;
  load(rows.x + at, x), load(rows.y + at, y), load(rows.inverse + at, inverse);
  load(rows.right + at, weight), load(rows.pull_right + at, pull);
  load(rows.cross_x + at, cross_x), load(rows.cross_y + at, cross_y);
  const Register shift = c.baseline * inverse;
  const Register row[6] = {c.fx * g.x[0],
                           Register{},
                           c.fx * (g.x[2] - shift * inverse),
                           c.fx * (g.x[3] - shift * y),
                           c.fx * (g.x[4] + shift * x),
                           c.fx * g.x[5]};
  Register across[6];
  for (std::size_t i = 0; i < 6; ++i) across[i] = cross_x * g.x[i] + cross_y * g.y[i];
  Register* sum = sums;
  for (std::size_t i = 0; i < 6; ++i) {
    const Register left = weight * row[i] + across[i];
    for (std::size_t j = i; j < 6; ++j) *sum++ += left * row[j] + row[i] * across[j];
    sums[21 + i] += row[i] * pull;
  }
}

GSLAM_ALWAYS_INLINE void addGroup(PoseFormula formula, const PoseCamera& c, std::size_t at,
                                  const PoseRows& rows, Register* sums) {
  Register x, y, inverse;
  load(rows.x + at, x), load(rows.y + at, y), load(rows.inverse + at, inverse);
  const Slopes slopes(x, y, inverse);
  addPlane(slopes, rows, at, sums);
  if (formula == PoseFormula::PinholeStereo) addRight(c, slopes, rows, at, sums);
}

// Two loops: in the first one, which is short, processors work on the divisions and roots of
// several groups at the same time.
GSLAM_ALWAYS_INLINE void addPoseBlock(PoseFormula formula, const PoseCamera& camera,
                                      const PoseLoss& loss, std::size_t count, PoseBlock& block,
                                      PoseSums& total) {
  PoseRows rows;
  Register sums[kPoseCost], counts[3];
  LogSum logs;
  for (Register& one : counts) one = Register{};
  for (std::size_t at = 0; at < count; at += GSLAM_POSE_WIDTH) {
    weighGroup(formula, camera, loss, at, block, rows, counts, logs);
  }
  for (std::size_t i = 0; i < 3; ++i) addLanes(counts[i], total.lanes[kPoseCost + i]);
  if (loss.kind == LossKind::Cauchy) total.lanes[kPoseCost][0] += loss.a2 * logs.total();

  for (Register& sum : sums) sum = Register{};
  for (std::size_t at = 0; at < count; at += GSLAM_POSE_WIDTH) {
    addGroup(formula, camera, at, rows, sums);
  }
  for (std::size_t i = 0; i < kPoseCost; ++i) addLanes(sums[i], total.lanes[i]);
}

inline void pinhole(const PoseCamera& camera, const PoseLoss& loss, std::size_t count,
                    PoseBlock& block, PoseSums& sums) {
  addPoseBlock(PoseFormula::Pinhole, camera, loss, count, block, sums);
}
inline void radtan(const PoseCamera& camera, const PoseLoss& loss, std::size_t count,
                   PoseBlock& block, PoseSums& sums) {
  addPoseBlock(PoseFormula::Radtan, camera, loss, count, block, sums);
}
inline void stereo(const PoseCamera& camera, const PoseLoss& loss, std::size_t count,
                   PoseBlock& block, PoseSums& sums) {
  addPoseBlock(PoseFormula::PinholeStereo, camera, loss, count, block, sums);
}

}  // namespace GSLAM_POSE_VARIANT
}  // namespace
}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
