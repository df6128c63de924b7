// The circle's number.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_PI_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_PI_H

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

constexpr double kPi = 3.14159265358979323846;

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_PI_H
