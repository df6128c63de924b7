// One SIMD variant of all batches. No include guard: batch_kernels.h includes this file once for
// each variant, inside the variant's target region, with GSLAM_DETAIL_VARIANT naming the namespace
// that has its registers. So each formula stands once. (Templates over the registers would not do:
// compilers take the target of a function from where it stands, not from where it is used.)

// Each of these uses those before it.
// clang-format off
#include <gslam/geometry/detail/batch_lanes.h>
#include <gslam/geometry/detail/batch_formulas.h>
#include <gslam/geometry/detail/batch_loop.h>
// clang-format on
