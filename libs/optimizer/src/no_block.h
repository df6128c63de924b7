#ifndef GSLAM_OPTIMIZER_SRC_NO_BLOCK_H
#define GSLAM_OPTIMIZER_SRC_NO_BLOCK_H

#include <cstdint>
#include <limits>

namespace gslam {
inline namespace v1 {
namespace detail {

// In place of the index of a block: there is none.
constexpr std::uint32_t kNoBlock = std::numeric_limits<std::uint32_t>::max();

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_NO_BLOCK_H
