// What OpenCV's calibration samples and ROS' camera_info write.
//
// Names: OpenCV samples/cpp/calibration.cpp, samples/cpp/stereo_calib.cpp and
// samples/cpp/tutorial_code/calib3d/camera_calibration/camera_calibration.cpp; ROS:
// wiki.ros.org/camera_calibration_parsers. R and T of a stereo pair take coordinates of the first
// camera to those of the second (stereoCalibrate()).
#include <algorithm>

#include "formats.h"

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

using Names = std::vector<std::string>;

// Names of one camera's values; `number` is "", "1" or "2".
struct CameraNames {
  explicit CameraNames(const std::string& number)
      : matrix({"camera_matrix" + number, "cameraMatrix" + number, "Camera_Matrix" + number,
                "K" + number, "M" + number}),
        distortion({"distortion_coefficients" + number, "dist_coeffs" + number,
                    "distCoeffs" + number, "dist_coeff" + number, "distortion" + number,
                    "Distortion_Coefficients" + number, "D" + number}),
        mirror({"xi" + number}) {}
  Names matrix, distortion, mirror;
};

bool isMatrixOf(const Fields& root, const CameraNames& names) {
  return root.hasAnyOf(names.matrix);
}

ImageSize sizeIn(const Document& document) {
  const Fields& root = document.root;
  if (root.hasAnyOf({"image_width", "image_Width"})) {
    return {root.anyOf({"image_width", "image_Width"}).pixels(),
            root.anyOf({"image_height", "image_Height"}).pixels()};
  }
  for (const char* name : {"image_size", "imageSize", "img_size", "size", "resolution"}) {
    if (root.has(name) && root[name].isArray()) return sizeOf(root[name]);
  }
  return sizeOfOptions(document);
}

bool isFisheye(const Fields& root) {
  if (root.has("fisheye_model")) return root["fisheye_model"].number() != 0;
  if (!root.has("distortion_model")) return false;
  const std::string model = root["distortion_model"].text();
  if (model == "equidistant" || model == "fisheye") return true;
  if (model == "plumb_bob" || model == "rational_polynomial" || model == "radtan") return false;
  root["distortion_model"].fail("is '" + model +
                                "', expected plumb_bob, rational_polynomial, equidistant or "
                                "fisheye");
}

void checkCount(const Fields& distortion, std::size_t count, const std::vector<std::size_t>& may) {
  if (std::find(may.begin(), may.end(), count) != may.end()) return;
  std::string expected;
  for (std::size_t n : may) expected += (expected.empty() ? "" : ", ") + std::to_string(n);
  distortion.fail("has " + std::to_string(count) + " coefficients, expected one of " + expected);
}

Camera cameraOf(const Document& document, const CameraNames& names, ImageSize size,
                Calibration& result) {
  const Fields& root = document.root;
  const Fields matrix = root.anyOf(names.matrix);
  const std::vector<double> intrinsics = intrinsicsOfMatrix(matrix);
  if (!root.hasAnyOf(names.distortion)) {
    result.remarks.push_back(matrix.path() + ": there are no distortion coefficients");
    return makeCamera(matrix, "pinhole", size, intrinsics);
  }
  const Fields distortion = root.anyOf(names.distortion);
  const std::vector<double> k = distortion.numbers();
  if (root.hasAnyOf(names.mirror)) {
    checkCount(distortion, k.size(), {4});
    const double xi = root.anyOf(names.mirror).numbers(1)[0];
    return makeCamera(matrix, "mei", size, joined(joined(intrinsics, {xi}), k));
  }
  if (isFisheye(root)) {
    checkCount(distortion, k.size(), {4});
    return makeCamera(matrix, "kannala_brandt", size, joined(intrinsics, k));
  }
  checkCount(distortion, k.size(), {0, 4, 5, 8, 12, 14});
  return radtanOrPinhole(matrix, size, intrinsics, k);
}

// The place of the second camera in the first one's coordinates.
SE3d placeOfSecond(const Fields& root, Calibration& result) {
  if (!root.has("R") || !root.has("T")) {
    result.remarks.push_back(
        "there are no R and T (stereo_calib writes them into another file): where the second "
        "camera is, is not known, and it was put where the first one is");
    return SE3d();
  }
  const std::vector<double> t = root["T"].numbers(3);
  // A rotation vector is what some programs write in place of the matrix.
  const std::vector<double> r = root["R"].numbers();
  const SO3d rotation = r.size() == 3 ? SO3d::exp({{r[0], r[1], r[2]}}) : root["R"].rotation();
  return SE3d(rotation, {{t[0], t[1], t[2]}}).inverse();
}

}  // namespace

bool isOpenCv(const Document& document) {
  for (const char* number : {"", "1"}) {
    if (isMatrixOf(document.root, CameraNames(number))) return true;
  }
  return false;
}

Calibration parseOpenCv(const Document& document) {
  const Fields& root = document.root;
  Calibration result;
  const CameraNames first("1"), second("2");
  const bool is_pair = isMatrixOf(root, first);
  if (!is_pair && !isMatrixOf(root, CameraNames(""))) {
    root.failMissing("a camera matrix (camera_matrix, K or, of a pair, K1, M1)");
  }
  const ImageSize size = sizeIn(document);
  const Camera camera = cameraOf(document, is_pair ? first : CameraNames(""), size, result);
  const bool has_name = root.has("camera_name") && root["camera_name"].isText();
  const std::string name = has_name ? root["camera_name"].text() : is_pair ? "left" : "camera";
  result.rig.cameras.push_back(makeSensor(name, camera));
  result.body = "the camera " + name;
  if (!is_pair || !isMatrixOf(root, second)) return result;
  const Camera other = cameraOf(document, second, size, result);
  result.rig.cameras.push_back(makeSensor("right", other, placeOfSecond(root, result)));
  return result;
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
