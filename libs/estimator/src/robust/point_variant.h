// The kernels of point_kernels.cpp for one target region; included once for each, so without an
// include guard, with GSLAM_POINT_VARIANT the name of a namespace. Loops that compilers turn into
// SIMD.
namespace gslam {
inline namespace v1 {
namespace detail {
namespace {
namespace GSLAM_POINT_VARIANT {

inline void homography(const float* h, float factor, const float* const* columns, std::size_t first,
                       std::size_t count, float* __restrict squared) {
  const float* __restrict x1 = columns[0] + first;
  const float* __restrict y1 = columns[1] + first;
  const float* __restrict x2 = columns[2] + first;
  const float* __restrict y2 = columns[3] + first;
  const float h0 = h[0], h1 = h[1], h2 = h[2], h3 = h[3], h4 = h[4], h5 = h[5];
  const float h6 = h[6], h7 = h[7], h8 = h[8];
  for (std::size_t i = 0; i < count; ++i) {
    const float w = h6 * x1[i] + h7 * y1[i] + h8;
    const float inverse = 1 / w;
    const float du = (h0 * x1[i] + h1 * y1[i] + h2) * inverse - x2[i];
    const float dv = (h3 * x1[i] + h4 * y1[i] + h5) * inverse - y2[i];
    squared[i] = factor * (du * du + dv * dv) + (w > 0 ? 0.0f : INFINITY);
  }
}

inline void bearingHomography(const float* h, float factor, const float* const* columns,
                              std::size_t first, std::size_t count, float* __restrict squared) {
  const float* __restrict c[12];
  for (std::size_t k = 0; k < 12; ++k) c[k] = columns[k] + first;
  const float h0 = h[0], h1 = h[1], h2 = h[2], h3 = h[3], h4 = h[4], h5 = h[5];
  const float h6 = h[6], h7 = h[7], h8 = h[8];
  for (std::size_t i = 0; i < count; ++i) {
    const float x = h0 * c[0][i] + h1 * c[1][i] + h2 * c[2][i];
    const float y = h3 * c[0][i] + h4 * c[1][i] + h5 * c[2][i];
    const float z = h6 * c[0][i] + h7 * c[1][i] + h8 * c[2][i];
    const float depth = c[3][i] * x + c[4][i] * y + c[5][i] * z;
    const float inverse = 1 / depth;
    const float du = (c[6][i] * x + c[7][i] * y + c[8][i] * z) * inverse;
    const float dv = (c[9][i] * x + c[10][i] * y + c[11][i] * z) * inverse;
    squared[i] = factor * (du * du + dv * dv) + (depth > 0 ? 0.0f : INFINITY);
  }
}

inline void affine2D(const float* a, float factor, const float* const* columns, std::size_t first,
                     std::size_t count, float* __restrict squared) {
  const float* __restrict x1 = columns[0] + first;
  const float* __restrict y1 = columns[1] + first;
  const float* __restrict x2 = columns[2] + first;
  const float* __restrict y2 = columns[3] + first;
  const float a0 = a[0], a1 = a[1], a2 = a[2], a3 = a[3], a4 = a[4], a5 = a[5];
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = a0 * x1[i] + a1 * y1[i] + a2 - x2[i];
    const float dy = a3 * x1[i] + a4 * y1[i] + a5 - y2[i];
    squared[i] = factor * (dx * dx + dy * dy);
  }
}

inline void affine3D(const float* a, float factor, const float* const* columns, std::size_t first,
                     std::size_t count, float* __restrict squared) {
  const float* __restrict x1 = columns[0] + first;
  const float* __restrict y1 = columns[1] + first;
  const float* __restrict z1 = columns[2] + first;
  const float* __restrict x2 = columns[3] + first;
  const float* __restrict y2 = columns[4] + first;
  const float* __restrict z2 = columns[5] + first;
  const float a0 = a[0], a1 = a[1], a2 = a[2], a3 = a[3], a4 = a[4], a5 = a[5];
  const float a6 = a[6], a7 = a[7], a8 = a[8], a9 = a[9], a10 = a[10], a11 = a[11];
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = a0 * x1[i] + a1 * y1[i] + a2 * z1[i] + a3 - x2[i];
    const float dy = a4 * x1[i] + a5 * y1[i] + a6 * z1[i] + a7 - y2[i];
    const float dz = a8 * x1[i] + a9 * y1[i] + a10 * z1[i] + a11 - z2[i];
    squared[i] = factor * (dx * dx + dy * dy + dz * dz);
  }
}

inline void plane(const float* p, float factor, const float* const* columns, std::size_t first,
                  std::size_t count, float* __restrict squared) {
  const float* __restrict x = columns[0] + first;
  const float* __restrict y = columns[1] + first;
  const float* __restrict z = columns[2] + first;
  const float p0 = p[0], p1 = p[1], p2 = p[2], p3 = p[3];
  for (std::size_t i = 0; i < count; ++i) {
    const float distance = p0 * x[i] + p1 * y[i] + p2 * z[i] + p3;
    squared[i] = factor * (distance * distance);
  }
}

}  // namespace GSLAM_POINT_VARIANT
}  // namespace
}  // namespace detail
}  // namespace v1
}  // namespace gslam
