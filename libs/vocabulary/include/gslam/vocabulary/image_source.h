#ifndef GSLAM_VOCABULARY_IMAGE_SOURCE_H
#define GSLAM_VOCABULARY_IMAGE_SOURCE_H

#include <gslam/vocabulary/descriptors.h>

#include <cstddef>
#include <functional>

/// @file
/// Images whose descriptors are not all in memory.

namespace gslam {
inline namespace v1 {

/// Gives the descriptors of an image, by its number from 0: read from a file, or made anew.
///
/// It is called for all images in their order, several times over, and must give the same
/// descriptors each time; always by the thread that called the function it was given to. They may
/// lie where those of the image before did. What it throws comes out of that function.
using ImageSource = std::function<Descriptors(std::size_t image)>;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_IMAGE_SOURCE_H
