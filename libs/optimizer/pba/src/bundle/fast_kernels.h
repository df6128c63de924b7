#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_KERNELS_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_KERNELS_H

#include <gslam/base/simd.h>

#include <cstddef>
#include <cstdint>

// The loops over observations, points and blocks that bundle adjustment consists of, in the best
// variant of SIMD.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

constexpr std::size_t kLanes = 32;  // observations at once

// Numbers of a view, as the kernels want them.
enum ViewNumber : std::size_t {
  kRotation = 0,      // R_camera_world, 9
  kTranslation = 9,   // t_camera_world, 3
  kFocal = 12,        // fx fy
  kCentre = 14,       // cx cy
  kDistortion = 16,   // k1 k2 p1 p2 k3
  kPoseFree = 21,     // 1 or 0
  kCameraFree = 22,   // 1 or 0
  kAspect = 23,       // fy / fx
  kRigRotation = 24,  // R_camera_body, 9
  kRigTranslation = 33,
  kViewNumbers = 36
};

constexpr std::size_t kStepNumbers = 12;  // of a block, in a table of steps; the rest is 0

// kLanes observations: inputs, and what leads from one kernel to the next.
struct alignas(64) FastLanes {
  std::uint32_t view_index[kLanes];
  std::uint32_t block_index[kLanes];
  double view[kViewNumbers][kLanes];
  double step[kStepNumbers][kLanes];  // of the block
  double world[3][kLanes];
  double local[3][kLanes];  // in the camera
  double pixel[2][kLanes];
  double slope[6][kLanes];       // of the pixel by the local point, 2 rows
  double intrinsics[6][kLanes];  // of the pixel by f k1 k2, 2 rows
};

// Rows of observations (columns) of a task.
enum ObservationRow : std::size_t {
  kResidual = 0,    // 2
  kByPoint = 2,     // 2 x 3
  kProducts = 8,    // upper triangle of by_point^T by_point, 6, and by_point^T residual, 3
  kFactor = 8,      // over kProducts: the inverse root of the point, 6, and its u, 3
  kPointStep = 11,  // over kProducts: the step of the point, 3
  kHalf = 17,       // by_point root^-T, 2 x 3
  kChange = 17,     // over kHalf: of the residual by the step of the block, 2
  kRoot = 23,       // of I - half half^T, upper triangle, 3
  kReduced = 26,    // residual less half u, 2
  kByBlock = 28,    // 2 x 9
  kObservationRows = 46
};

// Rows of points (columns) of a task.
enum PointRow : std::size_t {
  kHessian = 0,  // upper triangle, 6; then gradient, 3
  kInverse = 9,  // lower triangle of the inverse of the root L, 6: 00 10 11 20 21 22
  kU = 15,       // L^-1 gradient, 3
  kDamped = 18,  // damping times the bounded diagonal, 3
  kPointRows = 21
};

constexpr double kLeastDiagonal = 1e-9;
constexpr double kMostDiagonal = 1e32;

// An observation for the reduced matrix: V = J^T J_p L^-T, 9 x 3, by columns; its block, and where
// those of its point that are variables end.
template <class T>
struct alignas(64) FastRecord {
  T v[3][8];
  T ninth[3];
  std::uint32_t block;
  std::uint32_t end;
};

// What else the row of its block wants: derivatives, the root, residuals.
template <class T>
struct alignas(64) FastSide {
  double residual[2];
  double reduced[2];
  T by_block[2][8];
  T ninth[2];
  T root[3];
};

// Blocks of the reduced matrix. Rows of 8 columns; with 9 variables then the ninth row and the
// ninth column but their last element, which stands last, or elsewhere.
constexpr std::size_t blockStride(std::size_t freedom) {
  return freedom == 9 ? 80 : 8 * freedom;
}
constexpr std::size_t kMostBlock = 81;
inline std::size_t placeInBlock(std::size_t row, std::size_t column) {
  if (row < 8) return column < 8 ? 8 * row + column : 72 + row;
  return 64 + column + (column < 8 ? 0 : 8);
}

// A row of blocks to be added to.
template <class T>
struct FastRow {
  T* blocks = nullptr;   // blockStride() apart
  T* corners = nullptr;  // with 9 variables, the last elements
  const std::uint32_t* slot_of = nullptr;
  double* diagonal = nullptr;  // kMostBlock: J^T (I - half half^T) J
  double* outer = nullptr;     // kMostBlock: V V^T, all of it if is_whole, else its diagonal
  double* gradient = nullptr;  // 9
  double* reduced = nullptr;   // 9: of the reduced system
  bool is_whole = false;
};

// A product with rows of blocks right of the diagonal. Vectors have 16 numbers for each block: 8
// elements; then the ninth (x), or parts whose sum it is (y).
template <class T>
struct FastProduct {
  const T* blocks = nullptr;
  const T* corners = nullptr;
  const std::uint32_t* columns = nullptr;
  std::size_t count = 0;
  const T* x = nullptr;
  T* y = nullptr;
};

struct FastKernels {
  // Columns of `to`: the first `count` numbers, a multiple of 4, of kLanes rows of a table.
  void (*gather)(const double* table, std::size_t stride, const std::uint32_t* index,
                 std::size_t count, double (*to)[kLanes]);
  void (*toCamera)(FastLanes& lanes);
  void (*plainPixel)(FastLanes& lanes);
  void (*plainSlopes)(FastLanes& lanes, bool with_intrinsics);
  // Writes rows kByPoint and kByBlock, `stride` apart, of kLanes observations.
  void (*jacobians)(const FastLanes& lanes, bool has_rig, std::size_t freedom, double* rows,
                    std::size_t stride);
  // Writes rows kByPoint and kChange of kLanes observations, by lanes.step.
  void (*changes)(const FastLanes& lanes, bool has_rig, std::size_t freedom, double* rows,
                  std::size_t stride);
  // Rows of n observations, a multiple of kLanes; `count` of them, and 2 x `width`.
  void (*scale)(const double* factors, double* rows, std::size_t stride, std::size_t count,
                std::size_t n);
  void (*whiten)(const double* roots, double* rows, std::size_t stride, std::size_t width,
                 std::size_t n);
  void (*products)(double* rows, std::size_t stride, std::size_t n);
  void (*eliminate)(double* rows, std::size_t stride, std::size_t n);
  // Rows of n points, a multiple of kLanes.
  void (*factorPoints)(double* rows, std::size_t stride, std::size_t n, double damping);
  // kProducts, 3 rows: by_point^T change.
  void (*pull)(double* rows, std::size_t stride, std::size_t n);
  // What the model of the cost falls by kChange and kPointStep of n observations, any number.
  double (*modelDecrease)(const double* rows, std::size_t stride, std::size_t n);
};

template <class T>
struct FastBlockKernels {
  void (*makeRecords)(const double* rows, std::size_t stride, std::size_t freedom, std::size_t n,
                      FastRecord<T>* records, FastSide<T>* sides);
  // Adds observations row[0 .. count) of a block; numbers of observations begin at `window`.
  void (*addRow)(const FastRecord<T>* records, const FastSide<T>* sides, const std::uint32_t* row,
                 std::size_t count, std::uint32_t window, std::size_t freedom,
                 const FastRow<T>& target);
  // y of all columns, and of `row`, grows by the product.
  void (*multiplyRow)(const FastProduct<T>& product, std::size_t row, std::size_t freedom);
};

const FastKernels& fastKernels();
template <class T>
const FastBlockKernels<T>& fastBlockKernels();

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_KERNELS_H
