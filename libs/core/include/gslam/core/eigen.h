#ifndef GSLAM_CORE_EIGEN_H
#define GSLAM_CORE_EIGEN_H

#include <gslam/base/error.h>
#include <gslam/core/image.h>
#include <gslam/core/pixel_type.h>

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

/// @file
/// Images as matrices of Eigen and back, for those who have it. No other header of GSLAM includes
/// this one.
///
/// Row y, column x of a matrix is the pixel in column x, row y.
///
///     gslam::viewImageAsEigen<float>(depth) *= 0.001f;
///     gslam::viewChannelAsEigen<std::uint8_t>(colour, 2).setZero();

namespace gslam {
inline namespace v1 {

/// @{
/// Eigen's view of an image with one channel: rows one after the other.
template <class T>
using EigenImage = Eigen::Map<Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>,
                              Eigen::Unaligned, Eigen::OuterStride<>>;
template <class T>
using EigenConstImage =
    Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>,
               Eigen::Unaligned, Eigen::OuterStride<>>;
/// @}

/// @{
/// Eigen's view of one channel of an image.
template <class T>
using EigenChannel = Eigen::Map<Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>,
                                Eigen::Unaligned, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>>;
template <class T>
using EigenConstChannel =
    Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>,
               Eigen::Unaligned, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>>;
/// @}

namespace detail {

inline void checkSingleChannel(const Image& image) {
  if (image.channels() == 1) return;
  throw ArgumentError("image", "has " + std::to_string(image.channels()) +
                                   " channels, expected 1; see viewChannelAsEigen()");
}

inline void checkChannel(const Image& image, int channel) {
  if (channel >= 0 && channel < image.channels()) return;
  throw ArgumentError("channel", "is " + std::to_string(channel) + ", but the image has " +
                                     std::to_string(image.channels()));
}

inline int imageSize(Eigen::Index count) {
  if (count <= std::numeric_limits<int>::max()) return static_cast<int>(count);
  throw ArgumentError("matrix", "has " + std::to_string(count) + " rows or columns, more than " +
                                    "an image can have");
}

// Row by row, with memory of its own that moves with it.
template <class M>
struct IsMovableToImage
    : std::integral_constant<bool, M::IsRowMajor != 0 &&
                                       int(M::MaxSizeAtCompileTime) == Eigen::Dynamic> {};

}  // namespace detail

/// @{
/// The pixels of an image with one channel, without a copy.
/// @param image  must outlive the view; not a temporary
/// @throws ArgumentError when T is not the type of a channel, or there is more than one
template <class T>
EigenImage<T> viewImageAsEigen(Image& image) {
  detail::checkSingleChannel(image);
  const ImageSpan<T> span = image.template span<T>();
  return EigenImage<T>(span.data, span.height, span.width, Eigen::OuterStride<>(span.stride));
}
template <class T>
EigenConstImage<T> viewImageAsEigen(const Image& image) {
  detail::checkSingleChannel(image);
  const ImageSpan<const T> span = image.template span<T>();
  return EigenConstImage<T>(span.data, span.height, span.width, Eigen::OuterStride<>(span.stride));
}
template <class T>
void viewImageAsEigen(const Image&& image) = delete;
/// @}

/// @{
/// One channel of an image, without a copy.
/// @param image    must outlive the view; not a temporary
/// @param channel  from 0 on
/// @throws ArgumentError when T is not the type of a channel, or there is no such channel
template <class T>
EigenChannel<T> viewChannelAsEigen(Image& image, int channel) {
  detail::checkChannel(image, channel);
  const ImageSpan<T> span = image.template span<T>();
  return EigenChannel<T>(span.data + (span.data == nullptr ? 0 : channel), span.height, span.width,
                         {span.stride, span.channels});
}
template <class T>
EigenConstChannel<T> viewChannelAsEigen(const Image& image, int channel) {
  detail::checkChannel(image, channel);
  const ImageSpan<const T> span = image.template span<T>();
  return EigenConstChannel<T>(span.data + (span.data == nullptr ? 0 : channel), span.height,
                              span.width, {span.stride, span.channels});
}
template <class T>
void viewChannelAsEigen(const Image&& image, int channel) = delete;
/// @}

/// An image with the elements of a matrix or array, without a copy; the caller keeps them alive and
/// where they are.
/// @param matrix  row by row (Eigen::RowMajor)
/// @throws ArgumentError when there are more than 2^31 - 1 rows or columns
template <class Derived>
Image viewAsImage(Eigen::PlainObjectBase<Derived>& matrix) {
  static_assert(Derived::IsRowMajor, "images are row by row: toImage() copies");
  using T = typename Derived::Scalar;
  if (matrix.size() == 0) return Image();
  return Image::wrap(matrix.data(), detail::imageSize(matrix.cols()),
                     detail::imageSize(matrix.rows()), PixelTypeOf<T>::value, 1,
                     sizeof(T) * static_cast<std::size_t>(matrix.outerStride()),
                     std::shared_ptr<void>());
}

/// An image with a copy of the elements of a matrix, array or expression.
/// @param matrix  of a type of PixelType
/// @throws ArgumentError when there are more than 2^31 - 1 rows or columns
template <class Derived>
Image toImage(const Eigen::DenseBase<Derived>& matrix) {
  using T = typename Derived::Scalar;
  if (matrix.size() == 0) return Image();
  Image image(detail::imageSize(matrix.cols()), detail::imageSize(matrix.rows()),
              PixelTypeOf<T>::value);
  viewImageAsEigen<T>(image) = matrix.derived().matrix();
  return image;
}

/// An image that takes over the elements of a matrix without a copy: `toImage(std::move(m))`.
/// @param matrix  row by row (Eigen::RowMajor), of a size that is not known when compiling; others
///   are copied
/// @throws ArgumentError when there are more than 2^31 - 1 rows or columns
template <class T, int R, int C, int Options, int MaxR, int MaxC,
          class = typename std::enable_if<
              detail::IsMovableToImage<Eigen::Matrix<T, R, C, Options, MaxR, MaxC>>::value>::type>
Image toImage(Eigen::Matrix<T, R, C, Options, MaxR, MaxC>&& matrix) {
  using Matrix = Eigen::Matrix<T, R, C, Options, MaxR, MaxC>;
  const int width = detail::imageSize(matrix.cols());
  const int height = detail::imageSize(matrix.rows());
  if (width == 0 || height == 0) return Image();
  const auto owner = std::make_shared<Matrix>(std::move(matrix));
  return Image::wrap(owner->data(), width, height, PixelTypeOf<T>::value, 1, 0,
                     std::shared_ptr<void>(owner));
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_EIGEN_H
