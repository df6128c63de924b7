// What OpenCV's FileStorage means by its matrices.
#ifndef GSLAM_SVAR_FORMATS_SRC_OPENCV_H
#define GSLAM_SVAR_FORMATS_SRC_OPENCV_H

#include <gslam/svar.h>

#include <string>

namespace gslam {
namespace formats {

/// What is wrong with a matrix, and in which of its members.
struct MatrixProblem {
  std::string member;
  std::string problem;  ///< empty where nothing is
};

/// Whether `type` is "opencv-matrix" or "opencv-nd-matrix".
bool isOpenCvMatrix(detail::Text type);

/// Checks that rows and columns (or sizes), type of the elements and data fit together.
MatrixProblem checkOpenCvMatrix(detail::Text type, const Svar& matrix);

}  // namespace formats
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_SRC_OPENCV_H
