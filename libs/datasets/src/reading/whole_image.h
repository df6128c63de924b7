// What can be said of the file of an image before it is decoded.
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

/// The size that the head of a PNG or JPEG file states. False for what is neither, or has none.
bool readImageSize(const std::vector<std::uint8_t>& bytes, std::uint32_t& width,
                   std::uint32_t& height) noexcept;

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_WHOLE_IMAGE_H
