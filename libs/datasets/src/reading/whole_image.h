// Whether the file of an image is all there.
#ifndef GSLAM_DATASETS_SRC_READING_WHOLE_IMAGE_H
#define GSLAM_DATASETS_SRC_READING_WHOLE_IMAGE_H

#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace reading {

/// False for a PNG or JPEG file that ends before its end mark: decoders make the missing part grey,
/// and tell nobody. True for what is neither.
bool isWholeImage(const std::vector<std::uint8_t>& bytes) noexcept;

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_WHOLE_IMAGE_H
