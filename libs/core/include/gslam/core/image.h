#ifndef GSLAM_CORE_IMAGE_H
#define GSLAM_CORE_IMAGE_H

#include <gslam/base/error.h>
#include <gslam/core/detail/aligned_memory.h>
#include <gslam/core/pixel_type.h>
#include <gslam/geometry/undistort.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

/// @file
/// Images whose pixels are shared, not copied.

namespace gslam {
inline namespace v1 {

/// Pixels of one type and number of channels, row by row.
///
/// **Sharing.** A handle: copies and views have the same pixels, which live as long as the last of
/// them; clone() copies. Once an image is in a frame that was published nobody writes to it any
/// more: then threads may share it. The count of handles is safe between threads.
///
/// Own pixels begin at a multiple of 64 bytes and have no gaps between rows. Sizes are checked:
/// what would overflow is refused.
///
/// Layout: 48 bytes, the same whatever flags a plugin was compiled with.
class Image {
 public:
  /// No image: no pixels, empty().
  Image() noexcept = default;
  /// @{
  /// Copies share the pixels; what was moved from is no image.
  Image(const Image& other) = default;
  Image(Image&& other) noexcept { swap(other); }
  Image& operator=(const Image& other) = default;
  Image& operator=(Image&& other) noexcept {
    Image moved(std::move(other));
    swap(moved);
    return *this;
  }
  /// @}
  ~Image() = default;

  /// Exchanges two images, not their pixels.
  void swap(Image& other) noexcept {
    owner_.swap(other.owner_);
    std::swap(data_, other.data_);
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
    std::swap(stride_, other.stride_);
    std::swap(channels_, other.channels_);
    std::swap(type_, other.type_);
  }

  /// Pixels of its own, all zero.
  /// @param width, height  pixels; both 0, or both 1 or more
  /// @param type           of a channel
  /// @param channels       of a pixel, 1 to 65535
  /// @throws ArgumentError when a size is wrong, or all pixels take more than 2^47 bytes (2^30
  ///   where addresses have 32 bits)
  Image(int width, int height, PixelType type, int channels = 1)
      : Image(shaped(width, height, type, channels, 0)) {
    if (empty()) return;
    owner_ = detail::alignedZeros(byteCount());
    data_ = static_cast<std::uint8_t*>(owner_.get());
  }

  /// Pixels that somebody else owns.
  /// @param data      first channel of the first pixel, aligned for its type
  /// @param width, height, type, channels  as above
  /// @param stride    bytes from one row to the next, a multiple of the size of a channel; 0: no
  /// gap
  /// @param owner     keeps the pixels alive as long as it lives; null: the caller does
  /// @throws ArgumentError as above, and when data is null or not aligned, or the stride too small
  static Image wrap(void* data, int width, int height, PixelType type, int channels,
                    std::size_t stride, std::shared_ptr<void> owner) {
    Image image = shaped(width, height, type, channels, stride);
    if (image.empty()) return image;
    checkAddress(data, type);
    image.data_ = static_cast<std::uint8_t*>(data);
    image.owner_ = std::move(owner);
    return image;
  }

  /// Pixels that somebody else owns and wants back.
  /// @param data, width, height, type, channels, stride  as above
  /// @param release   called once, when the last handle is gone, in the thread that let go of it;
  ///                  must not throw
  /// @throws ArgumentError as above; whatever is thrown, nothing is released then
  static Image wrap(void* data, int width, int height, PixelType type, int channels,
                    std::size_t stride, std::function<void()> release) {
    Image image = wrap(data, width, height, type, channels, stride, nullptr);
    const auto owner = std::make_shared<Release>();
    owner->call.swap(release);  // from here on nothing can fail
    image.owner_ = std::shared_ptr<void>(owner, data);
    return image;
  }

  /// Pixels that the caller keeps alive for as long as there is a handle.
  /// @param data, width, height, type, channels, stride  as above
  /// @throws ArgumentError as above
  static Image wrap(void* data, int width, int height, PixelType type, int channels,
                    std::size_t stride, std::nullptr_t) {
    return wrap(data, width, height, type, channels, stride, std::shared_ptr<void>());
  }

  int width() const noexcept { return width_; }            ///< columns
  int height() const noexcept { return height_; }          ///< rows
  int channels() const noexcept { return channels_; }      ///< numbers a pixel has
  PixelType type() const noexcept { return type_; }        ///< of a channel
  std::size_t stride() const noexcept { return stride_; }  ///< bytes from a row to the next
  bool empty() const noexcept { return height_ == 0; }     ///< whether there is no pixel
  /// Bytes of a row's pixels, without the gap after them.
  std::size_t rowBytes() const noexcept {
    return std::size_t(width_) * channels_ * pixelTypeSize(type_);
  }
  /// Whether there are no gaps between rows.
  bool isDense() const noexcept { return height_ <= 1 || stride_ == rowBytes(); }
  /// Bytes from the first pixel to the end of the last.
  std::size_t byteCount() const noexcept {
    return empty() ? 0 : stride_ * (std::size_t(height_) - 1) + rowBytes();
  }
  /// What keeps the pixels alive; null for pixels that the caller keeps.
  const std::shared_ptr<void>& owner() const noexcept { return owner_; }

  /// @{
  /// First byte of row y, unchecked.
  std::uint8_t* bytes(int y = 0) noexcept { return data_ + std::ptrdiff_t(stride_) * y; }
  const std::uint8_t* bytes(int y = 0) const noexcept {
    return data_ + std::ptrdiff_t(stride_) * y;
  }
  /// @}

  /// @{
  /// First channel of the first pixel of row y, which is not checked.
  /// @throws ArgumentError when T is not the type of a channel
  template <class T>
  T* row(int y) {
    checkType<T>();
    return reinterpret_cast<T*>(bytes(y));
  }
  template <class T>
  const T* row(int y) const {
    checkType<T>();
    return reinterpret_cast<const T*>(bytes(y));
  }
  /// @}

  /// @{
  /// Channel `channel` of the pixel in column x, row y, checked; loops use row() or span().
  /// @throws ArgumentError when T is not the type of a channel, or there is no such pixel
  template <class T>
  T& at(int x, int y, int channel = 0) {
    checkPlace(x, y, channel);
    return row<T>(y)[std::ptrdiff_t(x) * channels_ + channel];
  }
  template <class T>
  const T& at(int x, int y, int channel = 0) const {
    checkPlace(x, y, channel);
    return row<T>(y)[std::ptrdiff_t(x) * channels_ + channel];
  }
  /// @}

  /// @{
  /// The pixels for kernels such as Undistorter's; the image must outlive it.
  /// @throws ArgumentError when T is not the type of a channel, or the stride is no multiple of it
  template <class T>
  ImageSpan<T> span() {
    return ImageSpan<T>{row<T>(0), width_, height_, channels_, elementStride()};
  }
  template <class T>
  ImageSpan<const T> span() const {
    return ImageSpan<const T>{row<T>(0), width_, height_, channels_, elementStride()};
  }
  /// @}

  /// A part of the image, with the same pixels.
  /// @param x, y           its first pixel
  /// @param width, height  of the part, 1 or more
  /// @throws ArgumentError when the part is empty or not inside
  Image view(int x, int y, int width, int height) const {
    if (x < 0 || y < 0 || width < 1 || height < 1 || x > width_ - width || y > height_ - height) {
      throw ArgumentError("part", "is " + std::to_string(width) + " x " + std::to_string(height) +
                                      " pixels from (" + std::to_string(x) + ", " +
                                      std::to_string(y) + ") on, expected one inside of " + text());
    }
    Image part = *this;
    part.data_ += stride_ * std::size_t(y) + std::size_t(x) * channels_ * pixelTypeSize(type_);
    part.width_ = width;
    part.height_ = height;
    return part;
  }

  /// A copy with pixels of its own, without gaps between rows.
  Image clone() const {
    if (empty()) return *this;
    Image copy = shaped(width_, height_, type_, channels_, 0);
    copy.owner_ = detail::alignedMemory(copy.byteCount());
    copy.data_ = static_cast<std::uint8_t*>(copy.owner_.get());
    const std::size_t row_bytes = rowBytes();
    if (isDense()) {
      std::memcpy(copy.data_, data_, copy.byteCount());
      return copy;
    }
    for (int y = 0; y < height_; ++y) std::memcpy(copy.bytes(y), bytes(y), row_bytes);
    return copy;
  }

  /// For people: `640 x 480 u8 x 3`.
  std::string text() const {
    if (empty()) return "no image";
    return std::to_string(width_) + " x " + std::to_string(height_) + " " + pixelTypeName(type_) +
           (channels_ == 1 ? "" : " x " + std::to_string(channels_));
  }

  /// Whether size, type and all pixels are equal, byte by byte.
  friend bool operator==(const Image& a, const Image& b) noexcept {
    if (a.width_ != b.width_ || a.height_ != b.height_) return false;
    if (a.empty()) return true;
    if (a.type_ != b.type_ || a.channels_ != b.channels_) return false;
    for (int y = 0; y < a.height_; ++y) {
      if (std::memcmp(a.bytes(y), b.bytes(y), a.rowBytes()) != 0) return false;
    }
    return true;
  }
  /// Not ==.
  friend bool operator!=(const Image& a, const Image& b) noexcept { return !(a == b); }

 private:
  // Far below what size_t holds, so that no sum of two such sizes overflows.
  static constexpr std::uint64_t kMostBytes = std::uint64_t(1)
                                              << (sizeof(std::size_t) < 8 ? 30 : 47);

  struct Release {
    Release() = default;
    Release(const Release&) = delete;
    Release& operator=(const Release&) = delete;
    ~Release() {
      if (call) call();
    }
    std::function<void()> call;
  };

  // An image of this shape that has no pixels yet.
  static Image shaped(int width, int height, PixelType type, int channels, std::size_t stride) {
    const std::size_t channel_bytes = pixelTypeSize(type);
    if (channel_bytes == 0) throw ArgumentError("type", "is no type of pixels");
    if (width < 0 || height < 0 || (width == 0) != (height == 0)) {
      throw ArgumentError("size", "is " + std::to_string(width) + " x " + std::to_string(height) +
                                      " pixels, expected 1 x 1 or more, or 0 x 0");
    }
    if (channels < 1 || channels > 0xFFFF) {
      throw ArgumentError("channels", "is " + std::to_string(channels) + ", expected 1 to 65535");
    }
    Image image;
    image.type_ = type;
    image.channels_ = static_cast<std::uint16_t>(channels);
    image.width_ = width;
    image.height_ = height;
    const std::uint64_t row = std::uint64_t(width) * unsigned(channels) * channel_bytes;
    const std::uint64_t step = stride == 0 ? row : stride;
    if (height > 0 && std::max(row, step) > kMostBytes / std::uint64_t(height)) {
      throw ArgumentError("size", "is " + std::to_string(width) + " x " + std::to_string(height) +
                                      " pixels of " + std::to_string(channels) +
                                      " channels, more than memory can hold");
    }
    if (step < row || step % channel_bytes != 0) {
      throw ArgumentError("stride", "is " + std::to_string(step) + " bytes, expected " +
                                        std::to_string(row) +
                                        " or more, a multiple of the size of a channel");
    }
    image.stride_ = step;
    return image;
  }

  static void checkAddress(const void* data, PixelType type) {
    if (data == nullptr) throw ArgumentError("data", "is null, expected pixels");
    if (reinterpret_cast<std::uintptr_t>(data) % pixelTypeSize(type) != 0) {
      throw ArgumentError("data", std::string("is not aligned for ") + pixelTypeName(type));
    }
  }

  template <class T>
  void checkType() const {
    if (PixelTypeOf<T>::value == type_) return;
    throw ArgumentError("T", std::string("is ") + pixelTypeName(PixelTypeOf<T>::value) +
                                 ", but the image has pixels of " + pixelTypeName(type_));
  }

  void checkPlace(int x, int y, int channel) const {
    if (x >= 0 && x < width_ && y >= 0 && y < height_ && channel >= 0 && channel < channels_) {
      return;
    }
    throw ArgumentError("pixel", "(" + std::to_string(x) + ", " + std::to_string(y) +
                                     "), channel " + std::to_string(channel) + ", is outside of " +
                                     text());
  }

  std::ptrdiff_t elementStride() const noexcept {
    return std::ptrdiff_t(stride_ / pixelTypeSize(type_));
  }

  std::shared_ptr<void> owner_;
  std::uint8_t* data_ = nullptr;
  std::int32_t width_ = 0;
  std::int32_t height_ = 0;
  std::uint64_t stride_ = 0;
  std::uint16_t channels_ = 1;
  PixelType type_ = PixelType::u8;
};

static_assert(sizeof(void*) != 8 || sizeof(Image) == 48, "an Image crosses plugin borders");
static_assert(std::is_nothrow_move_constructible<Image>::value &&
                  std::is_nothrow_move_assignable<Image>::value,
              "a std::vector of images moves them when it grows");

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_IMAGE_H
