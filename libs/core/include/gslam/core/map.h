#ifndef GSLAM_CORE_MAP_H
#define GSLAM_CORE_MAP_H

namespace gslam {
inline namespace v1 {

class Map {};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_MAP_H
