// Projection of a few observations; part of fast_kernels.h for one target region, included once for
// each, so without an include guard, with GSLAM_DETAIL_VARIANT the name of a namespace. Compilers
// turn loops over j into vectors of what the region allows.
#ifdef GSLAM_DETAIL_VARIANT
namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {
namespace GSLAM_DETAIL_VARIANT {

#if GSLAM_HAS_VECTORS
typedef double Four __attribute__((vector_size(32)));

// Numbers of 4 rows, by columns.
GSLAM_ALWAYS_INLINE void transposeFour(const double* const* from, std::size_t i,
                                       double (*to)[kLanes], std::size_t lane) {
  Four rows[4];
  for (std::size_t k = 0; k < 4; ++k) std::memcpy(&rows[k], from[k] + i, sizeof(Four));
  const Four low01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6);
  const Four high01 = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
  const Four low23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6);
  const Four high23 = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  rows[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
  rows[2] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
  rows[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
  for (std::size_t k = 0; k < 4; ++k) std::memcpy(&to[i + k][lane], &rows[k], sizeof(Four));
}
#else
inline void transposeFour(const double* const* from, std::size_t i, double (*to)[kLanes],
                          std::size_t lane) {
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t j = 0; j < 4; ++j) to[i + k][lane + j] = from[j][i + k];
  }
}
#endif

inline void gather(const double* table, std::size_t stride, const std::uint32_t* index,
                   std::size_t count, double (*to)[kLanes]) {
  for (std::size_t lane = 0; lane < kLanes; lane += 4) {
    const double* from[4];
    for (std::size_t k = 0; k < 4; ++k) from[k] = table + index[lane + k] * stride;
    for (std::size_t i = 0; i < count; i += 4) transposeFour(from, i, to, lane);
  }
}

inline void toCamera(FastLanes& lanes) {
  const auto& r = lanes.view;
  for (std::size_t j = 0; j < kLanes; ++j) {
    const double x = lanes.world[0][j], y = lanes.world[1][j], z = lanes.world[2][j];
    lanes.local[0][j] = r[0][j] * x + r[1][j] * y + r[2][j] * z + r[9][j];
    lanes.local[1][j] = r[3][j] * x + r[4][j] * y + r[5][j] * z + r[10][j];
    lanes.local[2][j] = r[6][j] * x + r[7][j] * y + r[8][j] * z + r[11][j];
  }
}

// Pinhole and radtan, see gslam/geometry/camera/radtan.h.
inline void plainPixel(FastLanes& lanes) {
  const auto& v = lanes.view;
  for (std::size_t j = 0; j < kLanes; ++j) {
    const double inverse = 1 / lanes.local[2][j];
    const double a = lanes.local[0][j] * inverse, b = lanes.local[1][j] * inverse;
    const double s = a * a + b * b, ab = a * b;
    const double k1 = v[kDistortion][j], k2 = v[kDistortion + 1][j], k3 = v[kDistortion + 4][j];
    const double p1 = v[kDistortion + 2][j], p2 = v[kDistortion + 3][j];
    const double g = 1 + s * (k1 + s * (k2 + s * k3));
    const double mx = a * g + 2 * p1 * ab + p2 * (s + 2 * a * a);
    const double my = b * g + p1 * (s + 2 * b * b) + 2 * p2 * ab;
    lanes.pixel[0][j] = v[kFocal][j] * mx + v[kCentre][j];
    lanes.pixel[1][j] = v[kFocal + 1][j] * my + v[kCentre + 1][j];
  }
}

inline void plainSlopes(FastLanes& lanes, bool with_intrinsics) {
  const auto& v = lanes.view;
  for (std::size_t j = 0; j < kLanes; ++j) {
    const double inverse = 1 / lanes.local[2][j];
    const double a = lanes.local[0][j] * inverse, b = lanes.local[1][j] * inverse;
    const double s = a * a + b * b, ab = a * b;
    const double k1 = v[kDistortion][j], k2 = v[kDistortion + 1][j], k3 = v[kDistortion + 4][j];
    const double p1 = v[kDistortion + 2][j], p2 = v[kDistortion + 3][j];
    const double g = 1 + s * (k1 + s * (k2 + s * k3));
    const double slope = k1 + s * (2 * k2 + s * 3 * k3);
    const double mx = a * g + 2 * p1 * ab + p2 * (s + 2 * a * a);
    const double my = b * g + p1 * (s + 2 * b * b) + 2 * p2 * ab;
    const double fx = v[kFocal][j], fy = v[kFocal + 1][j];
    lanes.pixel[0][j] = fx * mx + v[kCentre][j];
    lanes.pixel[1][j] = fy * my + v[kCentre + 1][j];
    const double mixed = 2 * (ab * slope + p1 * a + p2 * b);
    const double xa = fx * inverse * (g + 2 * a * a * slope + 2 * p1 * b + 6 * p2 * a);
    const double xb = fx * inverse * mixed, ya = fy * inverse * mixed;
    const double yb = fy * inverse * (g + 2 * b * b * slope + 6 * p1 * b + 2 * p2 * a);
    lanes.slope[0][j] = xa;
    lanes.slope[1][j] = xb;
    lanes.slope[2][j] = -(xa * a + xb * b);
    lanes.slope[3][j] = ya;
    lanes.slope[4][j] = yb;
    lanes.slope[5][j] = -(ya * a + yb * b);
  }
  if (!with_intrinsics) return;
  for (std::size_t j = 0; j < kLanes; ++j) {
    const double inverse = 1 / lanes.local[2][j];
    const double a = lanes.local[0][j] * inverse, b = lanes.local[1][j] * inverse;
    const double s = a * a + b * b;
    const double fx = v[kFocal][j], fy = v[kFocal + 1][j];
    lanes.intrinsics[0][j] = (lanes.pixel[0][j] - v[kCentre][j]) / fx;
    lanes.intrinsics[1][j] = fx * a * s;
    lanes.intrinsics[2][j] = fx * a * s * s;
    lanes.intrinsics[3][j] = v[kAspect][j] * (lanes.pixel[1][j] - v[kCentre + 1][j]) / fy;
    lanes.intrinsics[4][j] = fy * b * s;
    lanes.intrinsics[5][j] = fy * b * s * s;
  }
}

// Derivatives by the point, 2 x 3.
inline void byPoint(const FastLanes& lanes, double* __restrict rows, std::size_t stride) {
  const auto& v = lanes.view;
  for (std::size_t row = 0; row < 2; ++row) {
    const double* const a = lanes.slope[3 * row];
    double* __restrict const p = rows + (kByPoint + 3 * row) * stride;
    for (std::size_t j = 0; j < kLanes; ++j) {
      const double a0 = a[j], a1 = a[kLanes + j], a2 = a[2 * kLanes + j];
      p[j] = a0 * v[0][j] + a1 * v[3][j] + a2 * v[6][j];
      p[stride + j] = a0 * v[1][j] + a1 * v[4][j] + a2 * v[7][j];
      p[2 * stride + j] = a0 * v[2][j] + a1 * v[5][j] + a2 * v[8][j];
    }
  }
}

// The point in the body, and a row of derivatives by it.
struct InBody {
  double x, y, z, b0, b1, b2;
};
template <bool kHasRig>
GSLAM_ALWAYS_INLINE InBody inBody(const FastLanes& lanes, const double* a, std::size_t j) {
  const double x = lanes.local[0][j], y = lanes.local[1][j], z = lanes.local[2][j];
  const double a0 = a[j], a1 = a[kLanes + j], a2 = a[2 * kLanes + j];
  if (!kHasRig) return {x, y, z, a0, a1, a2};
  const auto& r = lanes.view + kRigRotation;
  const double dx = x - r[9][j], dy = y - r[10][j], dz = z - r[11][j];
  return {r[0][j] * dx + r[3][j] * dy + r[6][j] * dz, r[1][j] * dx + r[4][j] * dy + r[7][j] * dz,
          r[2][j] * dx + r[5][j] * dy + r[8][j] * dz, a0 * r[0][j] + a1 * r[3][j] + a2 * r[6][j],
          a0 * r[1][j] + a1 * r[4][j] + a2 * r[7][j], a0 * r[2][j] + a1 * r[5][j] + a2 * r[8][j]};
}

// exp(-d) p = p - translation + p x rotation, to first order.
template <bool kHasRig, std::size_t kFreedom>
void jacobiansOf(const FastLanes& lanes, double* __restrict rows, std::size_t stride) {
  const auto& v = lanes.view;
  for (std::size_t row = 0; row < 2; ++row) {
    double* __restrict const c = rows + (kByBlock + kFreedom * row) * stride;
    for (std::size_t j = 0; j < kLanes; ++j) {
      const InBody p = inBody<kHasRig>(lanes, lanes.slope[3 * row], j);
      const double free = kFreedom == 9 ? v[kPoseFree][j] : 1.0;
      c[j] = -p.b0 * free;
      c[stride + j] = -p.b1 * free;
      c[2 * stride + j] = -p.b2 * free;
      c[3 * stride + j] = (p.b1 * p.z - p.b2 * p.y) * free;
      c[4 * stride + j] = (p.b2 * p.x - p.b0 * p.z) * free;
      c[5 * stride + j] = (p.b0 * p.y - p.b1 * p.x) * free;
    }
    if (kFreedom == 9) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < kLanes; ++j) {
          c[(6 + k) * stride + j] = lanes.intrinsics[3 * row + k][j] * v[kCameraFree][j];
        }
      }
    }
  }
}

inline void jacobians(const FastLanes& lanes, bool has_rig, std::size_t freedom, double* rows,
                      std::size_t stride) {
  byPoint(lanes, rows, stride);
  if (freedom == 9) {
    has_rig ? jacobiansOf<true, 9>(lanes, rows, stride)
            : jacobiansOf<false, 9>(lanes, rows, stride);
  } else {
    has_rig ? jacobiansOf<true, 6>(lanes, rows, stride)
            : jacobiansOf<false, 6>(lanes, rows, stride);
  }
}

// The product of the derivatives by the block and its step, without forming them.
template <bool kHasRig, std::size_t kFreedom>
void changesOf(const FastLanes& lanes, double* __restrict rows, std::size_t stride) {
  const auto& v = lanes.view;
  const auto& d = lanes.step;
  for (std::size_t row = 0; row < 2; ++row) {
    double* __restrict const change = rows + (kChange + row) * stride;
    for (std::size_t j = 0; j < kLanes; ++j) {
      const InBody p = inBody<kHasRig>(lanes, lanes.slope[3 * row], j);
      const double dx = p.y * d[5][j] - p.z * d[4][j] - d[0][j];
      const double dy = p.z * d[3][j] - p.x * d[5][j] - d[1][j];
      const double dz = p.x * d[4][j] - p.y * d[3][j] - d[2][j];
      const double free = kFreedom == 9 ? v[kPoseFree][j] : 1.0;
      change[j] = (p.b0 * dx + p.b1 * dy + p.b2 * dz) * free;
    }
    if (kFreedom == 9) {
      const auto& by_camera = lanes.intrinsics + 3 * row;
      for (std::size_t j = 0; j < kLanes; ++j) {
        change[j] +=
            (by_camera[0][j] * d[6][j] + by_camera[1][j] * d[7][j] + by_camera[2][j] * d[8][j]) *
            v[kCameraFree][j];
      }
    }
  }
}

inline void changes(const FastLanes& lanes, bool has_rig, std::size_t freedom, double* rows,
                    std::size_t stride) {
  byPoint(lanes, rows, stride);
  if (freedom == 9) {
    has_rig ? changesOf<true, 9>(lanes, rows, stride) : changesOf<false, 9>(lanes, rows, stride);
  } else {
    has_rig ? changesOf<true, 6>(lanes, rows, stride) : changesOf<false, 6>(lanes, rows, stride);
  }
}

}  // namespace GSLAM_DETAIL_VARIANT
}  // namespace
}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif
