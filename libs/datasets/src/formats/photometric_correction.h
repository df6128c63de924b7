// Takes the response and the vignette of a camera out of its images.
#ifndef GSLAM_DATASETS_SRC_FORMATS_PHOTOMETRIC_CORRECTION_H
#define GSLAM_DATASETS_SRC_FORMATS_PHOTOMETRIC_CORRECTION_H

#include <gslam/core/image.h>

#include <cstddef>
#include <string>
#include <vector>

#include "../reading/file_tree.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// What a pixel of a camera with response G and vignette V measured: I(x) = G(t V(x) B(x)), with
/// t the exposure, so that
///
///     t B(x) = G^-1(I(x)) / V(x)
///
/// J. Engel, V. Usenko, D. Cremers, "A photometrically calibrated benchmark for monocular visual
/// odometry", arXiv:1607.02555, equations 1 and 2.
class PhotometricCorrection {
 public:
  /// @param response  256 values of G^-1, scaled to 0 to 255; none of them less than the one before
  /// @param vignette  V of each pixel, scaled so that the largest is 1
  PhotometricCorrection(std::vector<float> response, std::vector<float> vignette, int width,
                        int height);

  /// @param image    8-bit grey, of the size of the vignette
  /// @param to       u8: rounded, what is more than 255 is 255; or f32
  /// @param name     of the image, for errors
  /// @throws FileError when it is not
  Image apply(const Image& image, PixelType to, const std::string& name) const;

  /// Pixels that the vignette leaves dark: they become 0.
  std::size_t darkPixels() const noexcept { return dark_pixels_; }

 private:
  std::vector<float> response_;
  std::vector<float> gain_;  // 1 / V; 0 where V is
  int width_, height_;
  std::size_t dark_pixels_ = 0;
};

/// Reads TUM's pcalib.txt, 256 values of G^-1 that do not fall, in one line.
/// @throws ParseError that says which value is wrong
std::vector<float> readResponse(const FileTree& tree, const std::string& file);

/// The correction of a folder's pcalib.txt and vignette.png.
/// @throws FileError, ParseError when one is missing or wrong
PhotometricCorrection readPhotometricCorrection(const FileTree& tree, const std::string& folder);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_PHOTOMETRIC_CORRECTION_H
