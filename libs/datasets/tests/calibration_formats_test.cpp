// Calibrations of each format, against the formulas of the projects that they are from.
#include <cmath>

#include "calibration_text.h"

namespace {

using namespace calibration_text;  // NOLINT(google-build-using-namespace)
using gslam::Calibration;
using gslam::Camera;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;
using Values = std::vector<double>;

Vec2d projected(const Camera& camera, const Vec3d& point) {
  Vec2d pixel{{-1, -1}};
  EXPECT_TRUE(camera.project(point, pixel)) << camera;
  return pixel;
}

void expectNear(const Vec2d& a, double u, double v, double tolerance = 1e-9) {
  EXPECT_NEAR(a[0], u, tolerance);
  EXPECT_NEAR(a[1], v, tolerance);
}

TEST(calibrationFile, EachFormatIsFound) {
  for (const Known& known : kKnown) {
    const Calibration found = parse(known.text, sized(known.width, known.height));
    EXPECT_EQ(found.format, known.format);
    EXPECT_FALSE(found.rig.cameras.empty());
    EXPECT_EQ(found.time_offsets.size(), found.rig.cameras.size());
    gslam::CalibrationOptions named = sized(known.width, known.height);
    named.format = known.format;
    EXPECT_EQ(parse(known.text, named).rig.cameras[0].camera, found.rig.cameras[0].camera);
  }
}

TEST(calibrationFile, ListsItsFormats) {
  std::string names;
  for (const gslam::CalibrationFormat& format : gslam::calibrationFormats()) {
    names += format.name + " ";
    EXPECT_FALSE(format.summary.empty());
  }
  EXPECT_EQ(names, "kalibr opencv ocamcalib basalt orbslam colmap euroc dso stella svo ");
}

TEST(calibrationFile, WindowsLineEndsAndByteOrderMarksChangeNothing) {
  for (const Known& known : kKnown) {
    std::string text = "\xEF\xBB\xBF";
    for (const char* c = known.text; *c != '\0'; ++c)
      text += *c == '\n' ? "\r\n" : std::string(1, *c);
    const auto options = sized(known.width, known.height);
    const Calibration expected = parse(known.text, options), found = parse(text, options);
    EXPECT_EQ(found.format, known.format);
    ASSERT_EQ(found.rig.cameras.size(), expected.rig.cameras.size());
    EXPECT_EQ(found.rig.cameras.back().camera, expected.rig.cameras.back().camera);
  }
}

TEST(calibrationFile, KalibrsChain) {
  const Calibration found = parse(kKalibr);
  ASSERT_EQ(found.rig.cameras.size(), 4U);
  EXPECT_EQ(found.body, "the IMU");
  EXPECT_TRUE(found.rig.has_imu);
  EXPECT_TRUE(says(found.remarks, "the noise of the IMU is not in this file"));
  EXPECT_EQ(found.time_offsets, (std::vector<std::int64_t>{2500000, 0, 0, 0}));
  EXPECT_TRUE(says(found.remarks, "2500000 ns"));
  // T_cam_imu takes (1, 2, 3) of the IMU to (-2 + 0.01, 1 + 0.02, 3 + 0.03) of cam0, the chain
  // that to cam1.
  const Vec3d in_imu{{1, 2, 3}};
  const Vec3d in_0 = found.rig.cameras[0].T_body_camera.inverse() * in_imu;
  const Vec3d in_1 = found.rig.cameras[1].T_body_camera.inverse() * in_imu;
  const Vec3d in_3 = found.rig.cameras[3].T_body_camera.inverse() * in_imu;
  EXPECT_LT((in_0 - Vec3d{{-1.99, 1.02, 3.03}}).norm(), 1e-12);
  EXPECT_LT((in_1 - Vec3d{{-2.10, 1.021, 3.032}}).norm(), 1e-12);
  EXPECT_LT((in_3 - Vec3d{{-2.60, 1.021, 3.032}}).norm(), 1e-12);
}

TEST(calibrationFile, KalibrsModels) {
  const Calibration found = parse(kKalibr);
  EXPECT_EQ(found.rig.cameras[0].camera.modelName(), "radtan");
  EXPECT_EQ(found.rig.cameras[0].camera.parameters(),
            (Values{458.5, 457.25, 367, 248, -0.28, 0.07, 0.0002, 1.76e-05}));
  const Vec3d p{{0.3, -0.2, 1}};
  const double d = p.norm();
  {  // omni: xi first; Mei and Rives
    const double x = p[0] / (p[2] + 1.25 * d), y = p[1] / (p[2] + 1.25 * d), s = x * x + y * y;
    const double g = 1 - 0.1 * s + 0.2 * s * s;
    const double u = x * g + 2 * 0.0003 * x * y + 0.0004 * (s + 2 * x * x);
    const double v = y * g + 0.0003 * (s + 2 * y * y) + 2 * 0.0004 * x * y;
    expectNear(projected(found.rig.cameras[1].camera, p), 700 * u + 370, 701 * v + 250);
  }
  {  // ds: xi alpha first; Usenko et al., equations 40 to 43
    const double k = -0.24 * d + p[2], d2 = std::sqrt(p[0] * p[0] + p[1] * p[1] + k * k);
    const double n = 0.567 * d2 + (1 - 0.567) * k;
    expectNear(projected(found.rig.cameras[2].camera, p), 349 * p[0] / n + 365,
               348 * p[1] / n + 249);
  }
  {  // eucm: alpha beta first
    const double n = 0.6 * std::sqrt(1.04 * (p[0] * p[0] + p[1] * p[1]) + p[2] * p[2]) + 0.4 * p[2];
    expectNear(projected(found.rig.cameras[3].camera, p), 191 * p[0] / n + 254,
               192 * p[1] / n + 256);
  }
}

TEST(calibrationFile, KalibrsDistortions) {
  const auto model = [](const std::string& distortion, const std::string& coefficients) {
    std::string text = with(kKalibr, "radtan", distortion);
    text = with(text, "[-0.28, 0.07, 0.0002, 1.76e-05]", coefficients);
    return parse(text).rig.cameras[0].camera;
  };
  const Camera fisheye = model("equidistant", "[0.1, 0.02, 0.003, 0.0004]");
  EXPECT_EQ(fisheye.modelName(), "kannala_brandt");
  EXPECT_EQ(fisheye.parameters(), (Values{458.5, 457.25, 367, 248, 0.1, 0.02, 0.003, 0.0004}));
  EXPECT_EQ(model("fov", "[0.9]").modelName(), "fov");
  EXPECT_EQ(model("none", "[]").modelName(), "pinhole");
  EXPECT_EQ(model("radtan", "[0, 0, 0, 0]").modelName(), "pinhole");
  const Camera fov = model("fov", "[0.9]");
  const double r = std::hypot(0.3, 0.2), rd = std::atan(2 * r * std::tan(0.45)) / 0.9;
  expectNear(projected(fov, {{0.3, -0.2, 1}}), 458.5 * 0.3 * rd / r + 367,
             457.25 * -0.2 * rd / r + 248);
}

TEST(calibrationFile, KalibrsImu) {
  const std::string imu =
      "accelerometer_noise_density: 0.0028\naccelerometer_random_walk: 0.00086\n"
      "gyroscope_noise_density: 0.00016\ngyroscope_random_walk: 2.2e-05\nrostopic: /imu0\n"
      "update_rate: 200.0\n";
  const Calibration found = parse(imu);
  EXPECT_EQ(found.format, "kalibr");
  EXPECT_TRUE(found.rig.cameras.empty());
  EXPECT_TRUE(found.rig.has_imu);
  EXPECT_EQ(found.rig.imu.accel_noise, 0.0028);
  EXPECT_EQ(found.rig.imu.accel_bias_walk, 0.00086);
  EXPECT_EQ(found.rig.imu.gyro_noise, 0.00016);
  EXPECT_EQ(found.rig.imu.gyro_bias_walk, 2.2e-05);
  EXPECT_EQ(found.rig.imu.rate, 200);
  EXPECT_TRUE(found.remarks.empty());
  const std::string one = "Tw: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n";
  EXPECT_TRUE(parse(imu + one).remarks.empty());
  EXPECT_TRUE(says(parse(imu + with(one, "1", "1.01")).remarks, "scale and misalignment"));
  EXPECT_TRUE(says(parse(imu + "time_offset: 0.01\n").remarks, "time_offset"));
}

TEST(calibrationFile, KalibrsChainThatContradictsItselfIsSaid) {
  const std::string cam1 = std::string(kKalibr).substr(std::string(kKalibr).find("cam1"));
  const std::string pose =
      "  T_cam_imu:\n  - [0.0, -1.0, 0.0, 0.9]\n  - [1.0, 0.0, 0.0, 0.02]\n"
      "  - [0.0, 0.0, 1.0, 0.03]\n  - [0.0, 0.0, 0.0, 1.0]\n";
  const Calibration found = parse(with(kKalibr, "cam1:\n", "cam1:\n" + pose));
  EXPECT_TRUE(says(found.remarks, "do not agree"));
  EXPECT_NEAR((found.rig.cameras[1].T_body_camera.inverse() * Vec3d{{0, 0, 0}})[0], 0.9, 1e-12);
}

// Only a later camera has a place by the IMU: the chain leads back from it.
TEST(calibrationFile, KalibrsChainHangsOnTheFirstPlaceByTheImu) {
  const std::string whole = kKalibr;
  const std::size_t begin = whole.find("  T_cam_imu"), end = whole.find("  cam_overlaps");
  const std::string pose =
      "  T_cam_imu:\n  - [0.0, -1.0, 0.0, -0.10]\n  - [1.0, 0.0, 0.0, 0.021]\n"
      "  - [0.0, 0.0, 1.0, 0.032]\n  - [0.0, 0.0, 0.0, 1.0]\n";
  const std::string later =
      with(whole.substr(0, begin) + whole.substr(end), "cam1:\n", "cam1:\n" + pose);
  const Calibration expected = parse(kKalibr), found = parse(later);
  EXPECT_EQ(found.body, "the IMU");
  EXPECT_TRUE(found.rig.has_imu);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(
        found.rig.cameras[i].T_body_camera.isApprox(expected.rig.cameras[i].T_body_camera, 1e-12))
        << i;
  }
  const std::size_t link = later.find("  T_cn_cnm1"), behind = later.find("  camera_model", link);
  EXPECT_EQ(errorOf(later.substr(0, link) + later.substr(behind)),
            "file: cam1 / T_cn_cnm1 is missing");
}

TEST(calibrationFile, OpenCvsPair) {
  const Calibration found = parse(kStereo, sized(640, 480));
  ASSERT_EQ(found.rig.cameras.size(), 2U);
  EXPECT_EQ(found.rig.cameras[0].camera.parameters(),
            (Values{500, 501, 320, 240, -0.3, 0.1, 0.001, 0.002, 0.01}));
  EXPECT_EQ(found.rig.cameras[1].camera.parameterCount(), 12U);
  // stereoCalibrate(): a point of the first camera is R x + T in the second.
  const Vec3d first{{1, 2, 3}}, second{{3 - 0.1, 2 + 0.01, -1 + 0.02}};
  const Vec3d in_body = found.rig.cameras[1].T_body_camera * second;
  EXPECT_LT((in_body - first).norm(), 1e-12);
  EXPECT_EQ(found.body, "the camera left");
  EXPECT_TRUE(has(errorOf(kStereo), "file: does not say how large the images are"));
  const std::string alone = std::string(kStereo).substr(0, std::string(kStereo).find("R: !!"));
  EXPECT_TRUE(says(parse(alone, sized(640, 480)).remarks, "there are no R and T"));
}

TEST(calibrationFile, RosCameraInfo) {
  const Calibration found = parse(kCameraInfo);
  EXPECT_EQ(found.rig.cameras[0].name, "narrow_stereo");
  EXPECT_EQ(found.rig.cameras[0].camera.parameters(),
            (Values{438.783367, 437.302876, 305.593336, 243.738352, -0.361976, 0.110510, 0.001014,
                    0.000505, 0}));
  const std::string fisheye =
      with(with(kCameraInfo, "plumb_bob", "equidistant"), ", 0.000000]\nrect", "]\nrect");
  EXPECT_EQ(parse(fisheye).rig.cameras[0].camera.modelName(), "kannala_brandt");
}

TEST(calibrationFile, OpenCvsXml) {
  const std::string text = R"(<?xml version="1.0"?>
<opencv_storage>
<calibration_time>"Thu 26 Nov 2026"</calibration_time>
<image_width>640</image_width>
<image_height>480</image_height>
<camera_matrix type_id="opencv-matrix">
  <rows>3</rows><cols>3</cols><dt>d</dt>
  <data>500. 0. 320. 0. 501. 240. 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix">
  <rows>4</rows><cols>1</cols><dt>d</dt><data>1e-1 2e-2 3e-3 4e-4</data></distortion_coefficients>
</opencv_storage>
)";
  const Calibration found = parse(text);
  EXPECT_EQ(found.format, "opencv");
  EXPECT_EQ(found.rig.cameras[0].camera.parameters(),
            (Values{500, 501, 320, 240, 0.1, 0.02, 0.003, 0.0004}));
}

TEST(calibrationFile, OrbSlam2sPairAndDepth) {
  const Calibration pair = parse(kOrbslam2);
  ASSERT_EQ(pair.rig.cameras.size(), 2U);
  EXPECT_EQ(pair.rig.cameras[1].camera.modelName(), "pinhole");
  EXPECT_NEAR(pair.rig.cameras[1].T_body_camera.translation()[0], 386.1448 / 718.856, 1e-12);
  EXPECT_EQ(pair.rig.cameras[0].rate, 10);
  const Calibration depth = parse(std::string(kOrbslam2) + "DepthMapFactor: 5000.0\n");
  ASSERT_EQ(depth.rig.cameras.size(), 2U);
  EXPECT_EQ(depth.rig.cameras[1].kind, gslam::ImageKind::depth);
  EXPECT_NEAR(depth.rig.cameras[1].depth_scale, 1 / 5000.0, 1e-15);
  EXPECT_TRUE(depth.rig.cameras[1].T_body_camera.isApprox(SE3d(), 1e-15));
  const std::string sizeless = with(kOrbslam2, "Camera.width: 1241\nCamera.height: 376\n", "");
  EXPECT_TRUE(has(errorOf(sizeless), "CalibrationOptions::width"));
  EXPECT_EQ(parse(sizeless, sized(1241, 376)).rig.cameras[0].camera, pair.rig.cameras[0].camera);
}

TEST(calibrationFile, OrbSlam3sInertialPair) {
  const Calibration found = parse(kOrbslam3);
  ASSERT_EQ(found.rig.cameras.size(), 2U);
  EXPECT_EQ(found.body, "the IMU");
  EXPECT_EQ(found.rig.imu.gyro_noise, 1.7e-4);
  EXPECT_EQ(found.rig.imu.accel_noise, 2e-3);
  EXPECT_EQ(found.rig.imu.gyro_bias_walk, 1.9393e-05);
  EXPECT_EQ(found.rig.imu.accel_bias_walk, 3e-3);
  EXPECT_EQ(found.rig.imu.rate, 200);
  EXPECT_TRUE(says(found.remarks, "scale the images"));
  // ORB-SLAM3's T_c1_c2 and T_b_c1 put the second camera where EuRoC's own T_BS does.
  EXPECT_LT((found.rig.cameras[1].T_body_camera.translation() -
             Vec3d{{-0.0198435579556, 0.0453689425024, 0.00786212447038}})
                .norm(),
            1e-6);
}

TEST(calibrationFile, ColmapsPixelsBeginAtTheBorder) {
  const Calibration found = parse(kColmap);
  ASSERT_EQ(found.rig.cameras.size(), 3U);
  EXPECT_EQ(found.rig.cameras[2].name, "camera7");
  // colmap: u = f x (1 + k r^2) + cx, where the centre of the first pixel is 0.5.
  const double r2 = 0.01 + 0.04, g = 1 - 0.0218531 * r2;
  expectNear(projected(found.rig.cameras[0].camera, {{0.1, 0.2, 1}}),
             2559.81 * 0.1 * g + 1536 - 0.5, 2559.81 * 0.2 * g + 1152 - 0.5);
  EXPECT_EQ(found.rig.cameras[1].camera.parameters(), (Values{2560.56, 2561.5, 1536, 1152}));
  EXPECT_EQ(found.rig.cameras[2].camera.parameters(),
            (Values{500, 501, 320, 240, 0.1, -0.02, 0.001, -0.002, 0.003, 0.11, -0.01, 0.002}));
  EXPECT_TRUE(says(found.remarks, "does not say where cameras are"));
}

TEST(calibrationFile, AllOfColmapsModels) {
  const struct {
    const char* line;
    const char* model;
    Values values;
  } models[] = {
      {"1 SIMPLE_PINHOLE 640 480 500 320 240", "pinhole", {500, 500, 319.5, 239.5}},
      {"1 PINHOLE 640 480 500 501 320 240", "pinhole", {500, 501, 319.5, 239.5}},
      {"1 SIMPLE_RADIAL 640 480 500 320 240 0.1", "radtan", {500, 500, 319.5, 239.5, 0.1, 0, 0, 0}},
      {"1 RADIAL 640 480 500 320 240 0.1 -0.01",
       "radtan",
       {500, 500, 319.5, 239.5, 0.1, -0.01, 0, 0}},
      {"1 RADIAL 640 480 500 320 240 0 0", "pinhole", {500, 500, 319.5, 239.5}},
      {"1 OPENCV 640 480 500 501 320 240 0.1 -0.01 0.001 0.002",
       "radtan",
       {500, 501, 319.5, 239.5, 0.1, -0.01, 0.001, 0.002}},
      {"1 OPENCV_FISHEYE 640 480 500 501 320 240 0.1 -0.01 0.001 0.002",
       "kannala_brandt",
       {500, 501, 319.5, 239.5, 0.1, -0.01, 0.001, 0.002}},
      {"1 SIMPLE_RADIAL_FISHEYE 640 480 500 320 240 0.1",
       "kannala_brandt",
       {500, 500, 319.5, 239.5, 0.1, 0, 0, 0}},
      {"1 RADIAL_FISHEYE 640 480 500 320 240 0.1 -0.01",
       "kannala_brandt",
       {500, 500, 319.5, 239.5, 0.1, -0.01, 0, 0}},
      {"1 FOV 640 480 500 501 320 240 0.9", "fov", {500, 501, 319.5, 239.5, 0.9}}};
  for (const auto& each : models) {
    const Calibration found = parse(each.line);
    EXPECT_EQ(found.rig.cameras[0].camera.modelName(), each.model) << each.line;
    EXPECT_EQ(found.rig.cameras[0].camera.parameters(), each.values) << each.line;
    EXPECT_NE(errorOf(std::string(each.line) + " 7"), "") << each.line;
  }
  EXPECT_TRUE(has(errorOf("1 THIN_PRISM_FISHEYE 640 480 1 1 1 1 0 0 0 0 0 0 0 0"),
                  "file:1:3: the model is 'THIN_PRISM_FISHEYE', expected one of SIMPLE_PINHOLE"));
}

TEST(calibrationFile, Asl) {
  const Calibration found = parse(kAsl);
  EXPECT_EQ(found.rig.cameras[0].rate, 20);
  const Vec3d in_body = found.rig.cameras[0].T_body_camera * Vec3d{{1, 2, 3}};
  EXPECT_LT((in_body - Vec3d{{-2.02, 0.94, 3.01}}).norm(), 1e-12);
  EXPECT_TRUE(has(errorOf(with(kAsl, "sensor_type: camera", "sensor_type: position")),
                  "sensor_type is 'position', expected camera or imu"));
}

TEST(calibrationFile, Dsos) {
  const Calibration fov = parse(kDsoFov);
  EXPECT_EQ(fov.rig.cameras[0].camera.modelName(), "fov");
  EXPECT_TRUE(says(fov.remarks, "(crop) to 640 x 480"));
  const double r = std::hypot(0.3, 0.2), w = 0.897966326944875;
  const double g = std::atan(2 * r * std::tan(w / 2)) / (w * r);
  expectNear(projected(fov.rig.cameras[0].camera, {{0.3, -0.2, 1}}),
             1280 * (0.535719308086809 * 0.3 * g + 0.493248545285398) - 0.5,
             1024 * (0.669566858850269 * -0.2 * g + 0.500408664348414) - 0.5);
  const std::string tail = "\n640 480\nfull\n640 480\n";
  const auto cameraOf = [&](const std::string& line) {
    return parse(line + tail).rig.cameras[0].camera;
  };
  EXPECT_EQ(cameraOf("0.5 0.6 0.5 0.5 0").parameters(), (Values{320, 288, 319.5, 239.5}));
  EXPECT_EQ(cameraOf("Pinhole 500 501 320 240 0").parameters(), (Values{500, 501, 320, 240}));
  EXPECT_EQ(cameraOf("FOV 0.5 0.6 0.5 0.5 0.9").modelName(), "fov");
  EXPECT_EQ(cameraOf("RadTan 500 501 320 240 0.1 0.01 0.001 0.002").parameters(),
            (Values{500, 501, 320, 240, 0.1, 0.01, 0.001, 0.002}));
  EXPECT_EQ(cameraOf("RadTan 500 501 320 240 0 0 0 0").modelName(), "pinhole");
  for (const std::string model : {"EquiDistant", "KannalaBrandt"}) {
    const Camera fisheye = cameraOf(model + " 500 501 320 240 0.1 0.01 0.001 0.002");
    EXPECT_EQ(fisheye.modelName(), "kannala_brandt");
    EXPECT_EQ(fisheye.parameters(), (Values{500, 501, 320, 240, 0.1, 0.01, 0.001, 0.002}));
  }
  const std::string bare = "0.37 0.37 0.49 0.50 0.0034 0.0007 -0.002 0.0002" + tail;
  EXPECT_EQ(parse(bare).rig.cameras[0].camera.modelName(), "radtan");
  EXPECT_TRUE(says(parse(bare).remarks, "in TUM-VI's files they are EquiDistant"));
  gslam::CalibrationOptions options;
  options.bare_model = "EquiDistant";
  EXPECT_EQ(parse(bare, options).rig.cameras[0].camera.modelName(), "kannala_brandt");
  EXPECT_TRUE(says(parse("0.5 0.6 0.5 0.5 0\n640 480\n0.4 0.53 0.5 0.5 0\n320 240\n").remarks,
                   "to 320 x 240"));
  const Calibration longer =
      parse(std::string(kDsoFov) + "0.1101\n");  // the baseline of stereo DSO
  EXPECT_EQ(longer.rig.cameras[0].camera, fov.rig.cameras[0].camera);
  EXPECT_TRUE(says(longer.remarks, "DSO does not read line 5"));
  EXPECT_FALSE(says(fov.remarks, "does not read"));
}

TEST(calibrationFile, Svos) {
  const Camera camera = parse(kSvo).rig.cameras[0].camera;
  // vikit: s = 2 tan(d0 / 2), u = cx + fx x atan(r s) / (d0 r), all relative but 0.5.
  const double r = std::hypot(0.3, 0.2), w = 0.171631;
  const double g = std::atan(2 * r * std::tan(w / 2)) / (w * r);
  expectNear(projected(camera, {{0.3, -0.2, 1}}), 640 * (1.06326 * 0.3 * g + 0.488711) - 0.5,
             480 * (1.41474 * -0.2 * g + 0.478752) - 0.5);
  const std::string pinhole =
      "cam_model: Pinhole\ncam_width: 752\ncam_height: 480\ncam_fx: 414.5\ncam_fy: 414.2\n"
      "cam_cx: 348.8\ncam_cy: 240.0\ncam_d0: -0.28\ncam_d1: 0.06\ncam_d2: 0.001\ncam_d3: 0.002\n";
  EXPECT_EQ(parse(pinhole).rig.cameras[0].camera.parameters(),
            (Values{414.5, 414.2, 348.8, 240, -0.28, 0.06, 0.001, 0.002}));
  EXPECT_EQ(parse(pinhole + "cam_d4: 0.003\n").rig.cameras[0].camera.parameters(),
            (Values{414.5, 414.2, 348.8, 240, -0.28, 0.06, 0.001, 0.002, 0.003}));
  const std::string straight = pinhole.substr(0, pinhole.find("cam_d0"));
  EXPECT_EQ(parse(straight).rig.cameras[0].camera.modelName(), "pinhole");
  const std::string fisheye = with(pinhole, "Pinhole", "Equidistant");
  EXPECT_EQ(parse(fisheye).rig.cameras[0].camera.modelName(), "kannala_brandt");
  EXPECT_EQ(parse(fisheye).rig.cameras[0].camera.parameters(),
            (Values{414.5, 414.2, 348.8, 240, -0.28, 0.06, 0.001, 0.002}));
}

TEST(calibrationFile, Basalts) {
  const Calibration found = parse(kBasalt);
  ASSERT_EQ(found.rig.cameras.size(), 2U);
  EXPECT_EQ(found.rig.cameras[0].camera.modelName(), "kannala_brandt");
  EXPECT_EQ(found.rig.cameras[1].camera.parameters(),
            (Values{600, 601, 320, 240, 0.1, -0.02, 0.001, -0.002, 0.003, 0.11, -0.01, 0.002}));
  // Half a turn of atan2(0.6, 0.8) twice about y.
  const Vec3d z = found.rig.cameras[1].T_body_camera * Vec3d{{0, 0, 1}};
  EXPECT_LT((z - Vec3d{{2 * 0.6 * 0.8, 0, 0.64 - 0.36}}).norm(), 1e-12);
  EXPECT_EQ(found.time_offsets, (std::vector<std::int64_t>{-1500000, -1500000}));
  EXPECT_EQ(found.rig.imu.accel_noise, 0.017);
  EXPECT_TRUE(says(found.remarks, "accel_noise_std differs between axes"));
  EXPECT_EQ(found.rig.imu.gyro_noise, 0.000282);
  EXPECT_EQ(found.rig.imu.rate, 200);
  EXPECT_TRUE(has(errorOf(with(kBasalt, "[[512, 512], ", "[")),
                  "value0 / resolution has 1 elements, expected one for each of 2 cameras"));
}

TEST(calibrationFile, StellasDepth) {
  const Calibration found = parse(kStella);
  ASSERT_EQ(found.rig.cameras.size(), 2U);
  EXPECT_EQ(found.rig.cameras[0].kind, gslam::ImageKind::rgb);
  EXPECT_EQ(found.rig.cameras[0].camera.parameters(),
            (Values{435.2, 436.2, 367.4, 252.2, 0.1, -0.02, 0.001, -0.002, 0.003}));
  EXPECT_EQ(found.rig.cameras[1].kind, gslam::ImageKind::depth);
  EXPECT_NEAR(found.rig.cameras[1].depth_scale, 1 / 5000.0, 1e-15);
}

// OpenVSLAM's names have points; what they say is the same.
std::string flat(const std::string& nested) {
  std::string result, section, line;
  for (std::size_t at = 0; at < nested.size(); at += line.size() + 1) {
    line = nested.substr(at, nested.find('\n', at) - at);
    if (line.compare(0, 2, "  ") != 0) {
      section = line.substr(0, line.find(':')) + ".";
    } else {
      result += (section == "Preprocessing." ? "" : section) + line.substr(2) + "\n";
    }
  }
  return result;
}

void expectAlike(const Calibration& found, const Calibration& expected) {
  EXPECT_EQ(found.format, "stella");
  ASSERT_EQ(found.rig.cameras.size(), expected.rig.cameras.size());
  for (std::size_t i = 0; i < found.rig.cameras.size(); ++i) {
    const gslam::CameraSensor &a = found.rig.cameras[i], &b = expected.rig.cameras[i];
    EXPECT_EQ(a.camera, b.camera);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.depth_scale, b.depth_scale);
    EXPECT_EQ(a.rate, b.rate);
    EXPECT_TRUE(a.T_body_camera.isApprox(b.T_body_camera, 1e-15));
  }
}

const char* const kStellaPair = R"(Camera:
  setup: "stereo"
  model: "perspective"
  fx: 435.2
  fy: 436.2
  cx: 367.4
  cy: 252.2
  k1: 0.0
  k2: 0.0
  p1: 0.0
  p2: 0.0
  k3: 0.0
  fps: 20.0
  cols: 752
  rows: 480
  focal_x_baseline: 47.872
StereoRectifier:
  model: "fisheye"
  K_left: [458.5, 0.0, 367.2, 0.0, 457.25, 248.5, 0.0, 0.0, 1.0]
  D_left: [0.1, -0.02, 0.003, -0.0004]
  R_left: [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0]
  K_right: [457.5, 0.0, 379.9, 0.0, 456.25, 255.5, 0.0, 0.0, 1.0]
  D_right: [0.2, -0.01, 0.002, -0.0003]
  R_right: [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
)";

TEST(calibrationFile, OpenVslamsFlatSettings) {
  expectAlike(parse(flat(kStella)), parse(kStella));
  expectAlike(parse(flat(kStellaPair)), parse(kStellaPair));
  EXPECT_TRUE(
      has(errorOf(with(flat(kStella), "Camera.fy: 436.2\n", "")), "file: Camera.fy is missing"));
  EXPECT_TRUE(has(errorOf(with(flat(kStella), "Camera.model: \"perspective\"\n", "")),
                  "file: Camera.model is missing"));
  EXPECT_TRUE(
      has(errorOf(with(flat(kStella), "435.2", "-435.2")), "file: Camera is no camera: fx"));
  EXPECT_TRUE(has(errorOf(with(flat(kStellaPair), "StereoRectifier.R_right", "StereoRectifier.R")),
                  "file: StereoRectifier.R_right is missing"));
}

TEST(calibrationFile, StellasFisheyePair) {
  const Calibration found = parse(kStellaPair);
  ASSERT_EQ(found.rig.cameras.size(), 2U);
  EXPECT_EQ(found.rig.cameras[0].camera.modelName(), "kannala_brandt");
  EXPECT_EQ(found.rig.cameras[0].camera.parameters(),
            (Values{458.5, 457.25, 367.2, 248.5, 0.1, -0.02, 0.003, -0.0004}));
  EXPECT_EQ(found.rig.cameras[1].camera.parameters(),
            (Values{457.5, 456.25, 379.9, 255.5, 0.2, -0.01, 0.002, -0.0003}));
  // R_left takes (x, y, z) to (x, -z, y), R_right to (-y, x, z); between the rectified ones is the
  // baseline, 47.872 / 435.2, along x. A point (1, 2, 3) of the left camera is (1, -3, 2) and
  // (1 - b, -3, 2) rectified, (-3, -(1 - b), 2) in the right one.
  const double b = 47.872 / 435.2;
  const Vec3d in_right = found.rig.cameras[1].T_body_camera.inverse() * Vec3d{{1, 2, 3}};
  EXPECT_LT((in_right - Vec3d{{-3, -(1 - b), 2}}).norm(), 1e-12);
}

TEST(calibrationFile, OrbSlamsScaleIsSaid) {
  EXPECT_FALSE(says(parse(kOrbslam2).remarks, "scale the images"));
  const std::string scaled = std::string(kOrbslam2) + "Camera.imageScale: 0.5\n";
  EXPECT_TRUE(says(parse(scaled).remarks, "ORB-SLAM would scale the images"));
  EXPECT_TRUE(says(parse(scaled + "DepthMapFactor: 5000.0\n").remarks, "scale the images"));
  EXPECT_TRUE(parse(std::string(kOrbslam2) + "Camera.imageScale: 1.0\n").remarks.empty());
}

TEST(calibrationFile, OrbSlamsFisheyePair) {
  const std::string text =
      "%YAML:1.0\nCamera.type: \"KannalaBrandt8\"\nCamera.fx: 190.5\nCamera.fy: 190.25\n"
      "Camera.cx: 254.5\nCamera.cy: 256.5\nCamera.k1: 0.0034\nCamera.k2: 0.0007\n"
      "Camera.k3: -0.002\nCamera.k4: 0.0002\nCamera2.fx: 191.5\nCamera2.fy: 191.25\n"
      "Camera2.cx: 252.5\nCamera2.cy: 254.5\nCamera2.k1: 0.0035\nCamera2.k2: 0.0008\n"
      "Camera2.k3: -0.003\nCamera2.k4: 0.0003\nCamera.width: 512\nCamera.height: 512\n"
      "Camera.fps: 20.0\n"
      "Tlr: !!opencv-matrix\n  rows: 3\n  cols: 4\n  dt: f\n"
      "  data: [0.0, -1.0, 0.0, 0.1, 1.0, 0.0, 0.0, 0.2, 0.0, 0.0, 1.0, 0.3]\n"
      "Tbc: !!opencv-matrix\n  rows: 4\n  cols: 4\n  dt: f\n"
      "  data: [1.0, 0.0, 0.0, 0.01, 0.0, 0.0, -1.0, 0.02, 0.0, 1.0, 0.0, 0.03, 0.0, 0.0, 0.0, "
      "1.0]\n"
      "IMU.NoiseGyro: 0.004\nIMU.NoiseAcc: 0.04\nIMU.GyroWalk: 2.2e-5\nIMU.AccWalk: 8.6e-4\n"
      "IMU.Frequency: 200\n";
  const Calibration found = parse(text);
  ASSERT_EQ(found.rig.cameras.size(), 2U);
  EXPECT_EQ(found.rig.cameras[0].camera.modelName(), "kannala_brandt");
  EXPECT_EQ(found.rig.cameras[0].camera.parameters(),
            (Values{190.5, 190.25, 254.5, 256.5, 0.0034, 0.0007, -0.002, 0.0002}));
  EXPECT_EQ(found.rig.cameras[1].camera.parameters(),
            (Values{191.5, 191.25, 252.5, 254.5, 0.0035, 0.0008, -0.003, 0.0003}));
  // Tlr takes (1, 2, 3) of the second camera to (-2 + 0.1, 1 + 0.2, 3.3) of the first, and Tbc
  // that, (x, y, z), to (x + 0.01, -z + 0.02, y + 0.03) of the IMU.
  const Vec3d in_imu = found.rig.cameras[1].T_body_camera * Vec3d{{1, 2, 3}};
  EXPECT_LT((in_imu - Vec3d{{-1.89, -3.28, 1.23}}).norm(), 1e-6);
  EXPECT_EQ(errorOf(with(text, "0.004\n", "-0.004\n")),
            "file: IMU.NoiseGyro is negative, expected 0 or more");
}

TEST(calibrationFile, SaysWhereWhatIsWrong) {
  const struct {
    std::string text;
    const char* message;
  } cases[] = {
      {"", "file: is empty"},
      {"# only a comment\n\n", "file: is empty"},
      {"lens: 5\nname: x\n", "file: is no calibration of a known format, expected one of kalibr, "},
      {"lens: 5\nname: x\n", "it has lens, name"},
      {"a b c\n", "it begins with \"a b c\""},
      {"a: [1, 2\n", "file:"},
      {with(kKalibr, "[458.5, 457.25, 367.0, 248.0]", "[458.5, 457.25, 367.0]"),
       "file: cam0 / intrinsics has 3 numbers, expected 4"},
      {with(kKalibr, "458.5", ".nan"), "cam0 / intrinsics [0] is not finite"},
      {with(kKalibr, "458.5", "many"), "cam0 / intrinsics [0] is of type string"},
      {with(kKalibr, "458.5", "-458.5"), "cam0 is no camera: fx"},
      {with(kKalibr, "[752, 480]", "[752, 480.5]"), "cam0 / resolution [1] is 480.5"},
      {with(kKalibr, "[752, 480]", "[752, 48000000000]"), "expected a whole number of pixels"},
      {with(kKalibr, "pinhole", "pinhle"), "cam0 / camera_model is 'pinhle', expected pinhole, "},
      {with(kKalibr, "radtan", "radtn"), "cam0 has the distortion 'radtn', expected radtan, "},
      {with(kKalibr, "cam1:", "cam5:"), "file: cam1 is missing"},
      {with(kKalibr, "- [0.0, -1.0, 0.0, 0.01]", "- [0.0, -1.5, 0.0, 0.01]"),
       "cam0 / T_cam_imu is no pose"},
      {with(kKalibr, "- [0.0, 0.0, 0.0, 1.0]", "- [0.0, 0.0, 1.0, 1.0]"),
       "cam0 / T_cam_imu is no pose: its last row"},
      {with(kCameraInfo, "[438.783367, 0.000000, ", "[438.783367, 0.5, "),
       "camera_matrix has skew"},
      {with(kCameraInfo, "-0.361976, 0.110510, ", ""), "has 3 coefficients, expected one of 0, 4"},
      {with(kOcam, "5 -3.258881e+02", "6 -3.258881e+02"), "file: is no calibration"},
      {with(kOcam, "480 640", "480"), "file:19"},
      {with(kOcam, "261.744395 326.939156", "261.744395"), "file:11"},
      {with(kDsoFov, "crop", "corp"), "file:3:1: is 'corp', expected crop, full, none"},
      {with(kDsoFov, "1280 1024", "1280"), "file:2"},
      {with(kDsoFov, "\n640 480\n", "\n"), "expected width and height of what is rectified"},
      {"0.5 0.6 0.5 0.5\n640 480\ncrop\n640 480\n", "file: is no calibration"},
      {"RadTan 0.5 0.6 0.5 0.5\n640 480\ncrop\n640 480\n", "there are 4 parameters, expected 8"},
      {with(kOrbslam3, "Camera2.fy: 456.134\n", ""), "Camera2.fy is missing"},
      {with(kOrbslam3, "PinHole", "Pin"), "Camera.type is 'Pin', expected PinHole, "},
      {with(kBasalt, "\"kb4\"", "\"kb5\""), "camera_type is 'kb5', expected one of ds, eucm"},
      {with(kBasalt, "\"qw\": 1", "\"qw\": 2"), "value0 / T_imu_cam [0] has a quaternion of norm"},
      {with(kStella, "perspective", "radial_division"), "Camera / model is 'radial_division'"},
      {with(kSvo, "cam_d0: 0.171631\n", ""), "file: cam_d0 is missing"},
  };
  for (const auto& each : cases) {
    const std::string found = errorOf(each.text);
    EXPECT_TRUE(has(found, each.message)) << "'" << found << "' has no '" << each.message << "'";
  }
}

TEST(calibrationFile, RefusesWrongOptions) {
  gslam::CalibrationOptions options;
  options.format = "kalib";
  EXPECT_TRUE(has(errorOf(kKalibr, options), "is 'kalib', expected one of kalibr, "));
  EXPECT_TRUE(has(errorOf(kKalibr, sized(640, 0)), "expected both 1 or more, or both 0"));
  options = {};
  options.bare_model = "Fisheye";
  EXPECT_TRUE(has(errorOf(kDsoFov, options), "expected RadTan or EquiDistant"));
  options = {};
  options.format = "basalt";
  EXPECT_TRUE(has(errorOf(kKalibr, options), "value0 is missing"));
  EXPECT_THROW(gslam::readCalibration("/nowhere/calibration.yaml"), gslam::FileError);
  EXPECT_THROW(gslam::readCalibration("/"), gslam::FileError);
}

}  // namespace
