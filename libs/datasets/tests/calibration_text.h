// Calibrations as other projects write them, for tests.
#ifndef GSLAM_DATASETS_TESTS_CALIBRATION_TEXT_H
#define GSLAM_DATASETS_TESTS_CALIBRATION_TEXT_H

#include <gslam/datasets/calibration_file.h>
#include <gtest/gtest.h>

#include <string>

#include "words.h"

namespace calibration_text {

/// The calibration of a text, with its format found.
inline gslam::Calibration parse(const std::string& text,
                                const gslam::CalibrationOptions& options = {}) {
  return gslam::parseCalibration(text, "file", options);
}

inline gslam::CalibrationOptions sized(int width, int height) {
  gslam::CalibrationOptions options;
  options.width = width;
  options.height = height;
  return options;
}

/// What the error says; empty: there was none.
inline std::string errorOf(const std::string& text, const gslam::CalibrationOptions& options = {}) {
  try {
    parse(text, options);
  } catch (const gslam::Error& error) {
    return error.what();
  }
  return "";
}

/// A text with a part replaced, which must be there.
inline std::string with(std::string text, const std::string& part, const std::string& other) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : text.replace(at, part.size(), other);
}

const char* const kKalibr = R"(cam0:
  T_cam_imu:
  - [0.0, -1.0, 0.0, 0.01]
  - [1.0, 0.0, 0.0, 0.02]
  - [0.0, 0.0, 1.0, 0.03]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0002, 1.76e-05]
  distortion_model: radtan
  intrinsics: [458.5, 457.25, 367.0, 248.0]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
  timeshift_cam_imu: 0.0025
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.11]
  - [0.0, 1.0, 0.0, 0.001]
  - [0.0, 0.0, 1.0, 0.002]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: omni
  distortion_coeffs: [-0.1, 0.2, 0.0003, 0.0004]
  distortion_model: radtan
  intrinsics: [1.25, 700.0, 701.0, 370.0, 250.0]
  resolution: [752, 480]
cam2:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.2]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: ds
  distortion_coeffs: []
  distortion_model: none
  intrinsics: [-0.24, 0.567, 349.0, 348.0, 365.0, 249.0]
  resolution: [752, 480]
cam3:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.3]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: eucm
  distortion_coeffs: []
  distortion_model: none
  intrinsics: [0.6, 1.04, 191.0, 192.0, 254.0, 256.0]
  resolution: [512, 512]
)";

const char* const kOrbslam2 = R"(%YAML:1.0
Camera.fx: 718.856
Camera.fy: 718.856
Camera.cx: 607.1928
Camera.cy: 185.2157
Camera.k1: 0.0
Camera.k2: 0.0
Camera.p1: 0.0
Camera.p2: 0.0
Camera.width: 1241
Camera.height: 376
Camera.fps: 10.0
Camera.bf: 386.1448
Camera.RGB: 1
ThDepth: 35
)";

const char* const kOrbslam3 = R"(%YAML:1.0
File.version: "1.0"
Camera.type: "PinHole"
Camera1.fx: 458.654
Camera1.fy: 457.296
Camera1.cx: 367.215
Camera1.cy: 248.375
Camera1.k1: -0.28340811
Camera1.k2: 0.07395907
Camera1.p1: 0.00019359
Camera1.p2: 1.76187114e-05
Camera2.fx: 457.587
Camera2.fy: 456.134
Camera2.cx: 379.999
Camera2.cy: 255.238
Camera2.k1: -0.28368365
Camera2.k2: 0.07451284
Camera2.p1: -0.00010473
Camera2.p2: -3.55590700e-05
Camera.width: 752
Camera.height: 480
Camera.newWidth: 600
Camera.newHeight: 350
Camera.fps: 20
Stereo.ThDepth: 60.0
Stereo.T_c1_c2: !!opencv-matrix
  rows: 4
  cols: 4
  dt: f
  data: [0.999997256477797,-0.002317135723275,-0.000343393120620,0.110074137800478,
         0.002312067192432,0.999898048507103,-0.014090668452683,-0.000156612054392,
         0.000376008102320,0.014089835846691,0.999900662638081,0.000889382785432,
         0,0,0,1.000000000000000]
IMU.T_b_c1: !!opencv-matrix
   rows: 4
   cols: 4
   dt: f
   data: [0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975,
         0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768,
        -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949,
         0.0, 0.0, 0.0, 1.0]
IMU.NoiseGyro: 1.7e-04
IMU.NoiseAcc: 2.0e-03
IMU.GyroWalk: 1.9393e-05
IMU.AccWalk: 3.e-03
IMU.Frequency: 200.0
)";

const char* const kColmap = R"(# Camera list with one line of data per camera:
#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
# Number of cameras: 3
1 SIMPLE_RADIAL 3072 2304 2559.81 1536 1152 -0.0218531
2 PINHOLE 3072 2304 2560.56 2561.5 1536.5 1152.5
7 FULL_OPENCV 640 480 500 501 320.5 240.5 0.1 -0.02 0.001 -0.002 0.003 0.11 -0.01 0.002
)";

const char* const kAsl = R"(%YAML:1.0
sensor_type: camera
comment: VI-Sensor cam0 (MT9M034)
T_BS:
  cols: 4
  rows: 4
  data: [0.0, -1.0, 0.0, -0.02,
         1.0, 0.0, 0.0, -0.06,
         0.0, 0.0, 1.0, 0.01,
         0.0, 0.0, 0.0, 1.0]
rate_hz: 20
resolution: [752, 480]
camera_model: pinhole
intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
)";

const char* const kStereo = R"(%YAML:1.0
---
K1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 500., 0., 320., 0., 501., 240., 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.3, 0.1, 0.001, 0.002, 0.01 ]
K2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 510., 0., 321., 0., 511., 241., 0., 0., 1. ]
D2: !!opencv-matrix
   rows: 1
   cols: 8
   dt: d
   data: [ -0.3, 0.1, 0.001, 0.002, 0.01, 0.02, 0.03, 0.004 ]
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 0., 0., 1., 0., 1., 0., -1., 0., 0. ]
T: !!opencv-matrix
   rows: 3
   cols: 1
   dt: d
   data: [ -0.1, 0.01, 0.02 ]
)";

const char* const kCameraInfo = R"(image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [438.783367, 0.000000, 305.593336, 0.000000, 437.302876, 243.738352, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.361976, 0.110510, 0.001014, 0.000505, 0.000000]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
)";

const char* const kOcam =
    "#polynomial coefficients for the DIRECT mapping function\n\n"
    "5 -3.258881e+02 0.0 8.612196e-04 -3.553896e-08 6.737619e-09 \n\n"
    "#inverse\n\n3 407.216320 159.672870 -53.191585 \n\n"
    "#center\n\n261.744395 326.939156\n\n#affine\n\n1.001968 0.001400 0.000113\n\n"
    "#size\n\n480 640\n\n";

const char* const kDsoFov =
    "0.535719308086809 0.669566858850269 0.493248545285398 "
    "0.500408664348414 0.897966326944875\n1280 1024\ncrop\n640 480\n";

const char* const kSvo =
    "cam_model: ATAN\ncam_width: 640\ncam_height: 480\ncam_fx: 1.06326\ncam_fy: 1.41474\n"
    "cam_cx: 0.488711\ncam_cy: 0.478752\ncam_d0: 0.171631\n";

const char* const kBasalt = R"({"value0": {
  "T_imu_cam": [{"px": 0.1, "py": 0.2, "pz": 0.3, "qx": 0, "qy": 0, "qz": 0, "qw": 1},
                {"px": 0, "py": 0, "pz": 0, "qx": 0, "qy": 0.6, "qz": 0, "qw": 0.8}],
  "intrinsics": [
    {"camera_type": "kb4", "intrinsics": {"fx": 190, "fy": 191, "cx": 254, "cy": 256,
      "k1": 0.0035, "k2": 0.0007, "k3": -0.002, "k4": 0.0002}},
    {"camera_type": "pinhole-radtan8", "intrinsics": {"fx": 600, "fy": 601, "cx": 320, "cy": 240,
      "k1": 0.1, "k2": -0.02, "p1": 0.001, "p2": -0.002, "k3": 0.003, "k4": 0.11, "k5": -0.01,
      "k6": 0.002, "rpmax": 2.0}}],
  "resolution": [[512, 512], [640, 480]],
  "calib_accel_bias": [0, 0, 0, 0, 0, 0, 0, 0, 0],
  "imu_update_rate": 200.0,
  "accel_noise_std": [0.016, 0.017, 0.016], "gyro_noise_std": 0.000282,
  "accel_bias_std": [0.001, 0.001, 0.001], "gyro_bias_std": [0.0001, 0.0001, 0.0001],
  "cam_time_offset_ns": -1500000, "vignette": []}})";

const char* const kStella = R"(Camera:
  name: "EuRoC stereo"
  setup: "RGBD"
  model: "perspective"
  fx: 435.2
  fy: 436.2
  cx: 367.4
  cy: 252.2
  k1: 0.1
  k2: -0.02
  p1: 0.001
  p2: -0.002
  k3: 0.003
  fps: 20.0
  cols: 752
  rows: 480
  focal_x_baseline: 47.9
  color_order: "RGB"
Preprocessing:
  depthmap_factor: 5000.0
)";

/// Each with its format.
struct Known {
  const char* format;
  const char* text;
  int width, height;  // for those that do not say it
};
const Known kKnown[] = {
    {"kalibr", kKalibr, 0, 0},    {"opencv", kStereo, 640, 480}, {"opencv", kCameraInfo, 0, 0},
    {"ocamcalib", kOcam, 0, 0},   {"basalt", kBasalt, 0, 0},     {"orbslam", kOrbslam2, 0, 0},
    {"orbslam", kOrbslam3, 0, 0}, {"colmap", kColmap, 0, 0},     {"euroc", kAsl, 0, 0},
    {"dso", kDsoFov, 0, 0},       {"stella", kStella, 0, 0},     {"svo", kSvo, 0, 0}};

}  // namespace calibration_text

#endif  // GSLAM_DATASETS_TESTS_CALIBRATION_TEXT_H
