#ifndef GSLAM_CORE_OPENCV_H
#define GSLAM_CORE_OPENCV_H

#include <gslam/base/error.h>
#include <gslam/core/image.h>

#include <cstddef>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>

/// @file
/// Images to and from cv::Mat, for those who have OpenCV 3 or 4. No other header of GSLAM includes
/// this one.
///
/// Nothing is copied, and the pixels live as long as the last of all cv::Mat and Image that have
/// them, in whatever order and thread they go.

namespace gslam {
inline namespace v1 {
namespace detail {

// int in OpenCV 3, an enumeration in OpenCV 4.
template <class Flags>
Flags openCvFlags(bool (cv::MatAllocator::*)(cv::UMatData*, Flags, cv::UMatUsageFlags) const);
using OpenCvFlags = decltype(openCvFlags(&cv::MatAllocator::allocate));

/// Gives back what a cv::Mat had of an Image: the pixels' owner. It allocates nothing; matrices
/// that are made anew get their memory as others do.
class ImageMatAllocator : public cv::MatAllocator {
 public:
  /// One for all; it is never destroyed, because matrices may outlive what is static.
  static const ImageMatAllocator* instance() {
    static const ImageMatAllocator* const allocator = new ImageMatAllocator;
    return allocator;
  }

  /// What a matrix of that Image has in common with its copies; the count of them is 1.
  static cv::UMatData* share(Image image) {
    std::unique_ptr<Image> held(new Image(std::move(image)));
    cv::UMatData* const data = new cv::UMatData(instance());
    data->data = data->origdata = held->bytes();
    data->size = held->byteCount();
    data->flags |= cv::UMatData::USER_ALLOCATED;
    data->refcount = 1;
    data->userdata = held.release();
    return data;
  }

  /// The Image of a matrix; null where it is of another kind.
  static const Image* imageOf(const cv::Mat& mat) noexcept {
    const bool ours = mat.u != nullptr && mat.u->currAllocator == instance();
    return ours ? static_cast<const Image*>(mat.u->userdata) : nullptr;
  }

  void deallocate(cv::UMatData* data) const override {
    if (data == nullptr) return;
    delete static_cast<Image*>(data->userdata);
    delete data;
  }

  cv::UMatData* allocate(int dims, const int* sizes, int type, void* data, std::size_t* step,
                         OpenCvFlags flags, cv::UMatUsageFlags usage) const override {
    return cv::Mat::getDefaultAllocator()->allocate(dims, sizes, type, data, step, flags, usage);
  }
  bool allocate(cv::UMatData* data, OpenCvFlags flags, cv::UMatUsageFlags usage) const override {
    return cv::Mat::getDefaultAllocator()->allocate(data, flags, usage);
  }
};

#ifdef CV_16F
constexpr int kOpenCvDepths = 8;
#else
constexpr int kOpenCvDepths = 7;  // what is 7 there is no half float
#endif

}  // namespace detail

/// A matrix with the same pixels, and a share in them.
///
/// cv::Mat has no way to say that pixels are not to be written to; nobody writes to those of a
/// frame that was published. What OpenCV writes in place (`img = 0`) all see; what gives a matrix
/// another size or type, and clone(), takes new memory as usual.
///
/// @param image  of any kind; pixels that its caller keeps (no owner()) must outlive the matrix
/// @return one of height x width pixels; no matrix for no image
/// @throws ArgumentError when OpenCV lacks the type (u32, i64, u64, in OpenCV 3 also f16), or so
/// many
///   channels (more than 512)
inline cv::Mat toOpenCv(Image image) {
  const int depth = static_cast<int>(image.type());
  if (depth >= detail::kOpenCvDepths) {
    throw ArgumentError("image", "has pixels of " + std::string(pixelTypeName(image.type())) +
                                     ", which OpenCV does not have");
  }
  if (image.channels() > CV_CN_MAX) {
    throw ArgumentError("image", "has " + std::to_string(image.channels()) +
                                     " channels, OpenCV has at most " + std::to_string(CV_CN_MAX));
  }
  if (image.empty()) return cv::Mat();
  cv::Mat mat(image.height(), image.width(), CV_MAKETYPE(depth, image.channels()), image.bytes(),
              image.stride());
  mat.u = detail::ImageMatAllocator::share(std::move(image));
  return mat;
}

/// An image with the same pixels, and a share in them.
///
/// A matrix that was made of somebody's memory (cv::Mat(rows, cols, type, data)) has no share to
/// give: such an Image has no owner(), the caller keeps the pixels alive, and clone() gives one
/// that needs no care.
///
/// @param mat  two-dimensional, also a part of another
/// @return one of cols x rows pixels; no image for an empty matrix
/// @throws ArgumentError when the matrix has more dimensions or an unknown type, or its elements
/// are
///   not aligned
inline Image fromOpenCv(const cv::Mat& mat) {
  if (mat.dims > 2) {
    throw ArgumentError("mat", "has " + std::to_string(mat.dims) + " dimensions, expected 2");
  }
  if (mat.depth() >= detail::kOpenCvDepths) {
    throw ArgumentError("mat", "has elements of OpenCV's type " + std::to_string(mat.depth()) +
                                   ", which an Image cannot have");
  }
  if (mat.empty()) return Image();
  std::shared_ptr<void> owner;
  if (const Image* const image = detail::ImageMatAllocator::imageOf(mat)) {
    owner = image->owner();  // shorter than a matrix that holds an image
  } else if (mat.u != nullptr) {
    owner = std::make_shared<cv::Mat>(mat);
  }
  return Image::wrap(mat.data, mat.cols, mat.rows, static_cast<PixelType>(mat.depth()),
                     mat.channels(), mat.step[0], std::move(owner));
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_OPENCV_H
