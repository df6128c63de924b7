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
  EXPECT_EQ(model("equidistant", "[0.1, 0.02, 0.003, 0.0004]").modelName(), "kannala_brandt");
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
  } models[] = {
      {"1 SIMPLE_PINHOLE 640 480 500 320 240", "pinhole"},
      {"1 PINHOLE 640 480 500 501 320 240", "pinhole"},
      {"1 RADIAL 640 480 500 320 240 0.1 -0.01", "radtan"},
      {"1 OPENCV 640 480 500 501 320 240 0.1 -0.01 0.001 0.002", "radtan"},
      {"1 OPENCV_FISHEYE 640 480 500 501 320 240 0.1 -0.01 0.001 0.002", "kannala_brandt"},
      {"1 SIMPLE_RADIAL_FISHEYE 640 480 500 320 240 0.1", "kannala_brandt"},
      {"1 RADIAL_FISHEYE 640 480 500 320 240 0.1 -0.01", "kannala_brandt"},
      {"1 FOV 640 480 500 501 320 240 0.9", "fov"}};
  for (const auto& each : models) {
    const Calibration found = parse(each.line);
    EXPECT_EQ(found.rig.cameras[0].camera.modelName(), each.model) << each.line;
    EXPECT_EQ(found.rig.cameras[0].camera.parameter("cx"), 319.5);
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
  EXPECT_EQ(cameraOf("EquiDistant 500 501 320 240 0.1 0.01 0.001 0.002").modelName(),
            "kannala_brandt");
  EXPECT_EQ(cameraOf("KannalaBrandt 500 501 320 240 0.1 0.01 0.001 0.002").modelName(),
            "kannala_brandt");
  const std::string bare = "0.37 0.37 0.49 0.50 0.0034 0.0007 -0.002 0.0002" + tail;
  EXPECT_EQ(parse(bare).rig.cameras[0].camera.modelName(), "radtan");
  EXPECT_TRUE(says(parse(bare).remarks, "in TUM-VI's files they are EquiDistant"));
  gslam::CalibrationOptions options;
  options.bare_model = "EquiDistant";
  EXPECT_EQ(parse(bare, options).rig.cameras[0].camera.modelName(), "kannala_brandt");
  EXPECT_TRUE(says(parse("0.5 0.6 0.5 0.5 0\n640 480\n0.4 0.53 0.5 0.5 0\n320 240\n").remarks,
                   "to 320 x 240"));
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
