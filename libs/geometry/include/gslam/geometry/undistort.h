#ifndef GSLAM_GEOMETRY_UNDISTORT_H
#define GSLAM_GEOMETRY_UNDISTORT_H

#include <gslam/base/error.h>
#include <gslam/base/parallel.h>
#include <gslam/base/span.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/detail/remap.h>
#include <gslam/geometry/detail/remap_table.h>
#include <gslam/geometry/mat.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

/// @file
/// The image that another camera would have taken: undistortion, rectification, change of model.

namespace gslam {
inline namespace v1 {

/// Pixels that somebody else owns, row by row, the channels of a pixel side by side.
/// Layout: a pointer and numbers, stable across plugin borders.
template <class T>
struct ImageSpan {
  T* data;                ///< first channel of the first pixel
  int width;              ///< columns
  int height;             ///< rows
  int channels;           ///< numbers a pixel has
  std::ptrdiff_t stride;  ///< elements (not bytes) from one row to the next

  /// An image without gaps between its rows.
  static ImageSpan dense(T* data, int width, int height, int channels = 1) noexcept {
    return {data, width, height, channels, std::ptrdiff_t(width) * channels};
  }
};

/// Makes of images of one camera the images of another one at the same place.
///
///     const Undistorter undistorter(fisheye, pinhole);
///     undistorter.apply(ImageSpan<const std::uint8_t>::dense(in, 752, 480),
///                       ImageSpan<std::uint8_t>::dense(out, 752, 480));
///
/// For each pixel of the target it is found once where the source has it, to 1/64 pixel (an error
/// of at most 1/128); apply() interpolates bilinearly between the four pixels around. Whole numbers
/// are rounded to the nearest. A pixel of the target is seen where the models see its direction and
/// all four pixels are in the source image.
///
/// Results have the same bits for any number of threads and, for whole numbers, any SIMD variant.
/// Copies share the table; immutable, so it may be shared by threads.
class Undistorter {
 public:
  /// @param source           camera that takes the images; at least 2 x 2 pixels, at most 32767
  /// @param target           camera whose images are wanted
  /// @param R_source_target  takes directions in the target to directions in the source; not
  /// checked
  ///                         to be a rotation
  /// @param options          threads for the making of the table
  /// @throws ArgumentError when a camera is none or the source has a size that cannot be
  Undistorter(const Camera& source, const Camera& target,
              const Mat3d& R_source_target = Mat3d::identity(),
              const ParallelOptions& options = ParallelOptions())
      : source_(source),
        target_(target),
        table_(std::make_shared<detail::RemapTable>(source, target, R_source_target, options)) {}

  const Camera& source() const noexcept { return source_; }  ///< camera that takes the images
  const Camera& target() const noexcept { return target_; }  ///< camera whose images are made

  /// For each pixel of the target, row by row, 1 where it is seen, else 0.
  Span<const std::uint8_t> mask() const noexcept { return table_->is_seen; }

  /// Makes an image.
  /// @tparam T       std::uint8_t, std::uint16_t or float
  /// @param source   image of the source camera, 1, 3 or 4 channels
  /// @param target   result, with as many channels; must not overlap the source
  /// @param fill     each channel of a pixel that is not seen
  /// @param options  threads
  /// @throws ArgumentError when a size is not the camera's, the numbers of channels differ or are
  ///   others, or rows overlap
  template <class T>
  void apply(const ImageSpan<const T>& source, const ImageSpan<T>& target, T fill = T(0),
             const ParallelOptions& options = ParallelOptions()) const {
    check("source", source_, source.width, source.height, source.channels, source.stride);
    check("target", target_, target.width, target.height, target.channels, target.stride);
    if (source.channels != target.channels) {
      throw ArgumentError("target", "has " + std::to_string(target.channels) +
                                        " channels, expected " + std::to_string(source.channels) +
                                        " as the source has");
    }
    const detail::RemapFunction<T> remap = kernel<T>(source.channels);
    const detail::RemapSource<T> from = {source.data, source.stride};
    ParallelOptions rows = options;
    if (rows.grain <= 1) rows.grain = 16;
    parallelFor(
        0, static_cast<std::size_t>(target.height),
        [&](std::size_t v) {
          remap(table_->row(v), from, fill, target.data + std::ptrdiff_t(v) * target.stride);
        },
        rows);
  }

 private:
  static void check(const char* name, const Camera& camera, int width, int height, int channels,
                    std::ptrdiff_t stride) {
    if (width != camera.width() || height != camera.height()) {
      throw ArgumentError(name, "is " + std::to_string(width) + " x " + std::to_string(height) +
                                    " pixels, expected " + std::to_string(camera.width()) + " x " +
                                    std::to_string(camera.height()) + " as its camera has");
    }
    if (channels != 1 && channels != 3 && channels != 4) {
      throw ArgumentError(name,
                          "has " + std::to_string(channels) + " channels, expected 1, 3 or 4");
    }
    if (stride < std::ptrdiff_t(width) * channels || stride > 0x7FFFFFFF / height) {
      throw ArgumentError(name, "has a stride of " + std::to_string(stride) + ", expected " +
                                    std::to_string(std::ptrdiff_t(width) * channels) +
                                    " or more, and an image below 2^31 elements");
    }
  }

  template <class T>
  static detail::RemapFunction<T> kernel(int channels) {
    if (channels == 1) return detail::RemapKernel<T, 1>::get().active();
    if (channels == 3) return detail::RemapKernel<T, 3>::get().active();
    return detail::RemapKernel<T, 4>::get().active();
  }

  Camera source_;
  Camera target_;
  std::shared_ptr<const detail::RemapTable> table_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_UNDISTORT_H
