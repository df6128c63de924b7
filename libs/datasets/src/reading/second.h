// Stamps are nanoseconds.
#ifndef GSLAM_DATASETS_SRC_READING_SECOND_H
#define GSLAM_DATASETS_SRC_READING_SECOND_H

#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace reading {

constexpr std::int64_t kSecond = 1000000000;

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_SECOND_H
