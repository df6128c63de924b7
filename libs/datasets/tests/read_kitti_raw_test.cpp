// KITTI raw: its layout in small, written here after the devkit's readme and dataformat.txt, and
// what goes wrong.
#include <gslam/core/geodesy.h>
#include <gslam/datasets/formats.h>

#include <cstdio>
#include <sstream>

#include "format_case.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)
using gslam::kittiRawFactory;

// 2011-09-26 00:00:00 UTC, by `date -u -d 2011-09-26 +%s`.
constexpr std::int64_t kDay = 1316995200000000000;
constexpr std::int64_t kMorning = kDay + (13 * 3600 + 2 * 60) * 1000000000LL;

// Numbers as the devkit's calibration has them: rotations are exact turns here.
const char* const kCamToCam =
    "calib_time: 09-Jan-2012 13:57:47\n"
    "corner_dist: 9.950000e-02\n"
    "S_00: 40 30\nK_00: 21 0 19 0 22 14 0 0 1\nD_00: -0.37 0.2 0.001 0.0013 -0.07\n"
    "R_00: 1 0 0 0 1 0 0 0 1\nT_00: 0 0 0\n"
    "S_rect_00: 32 24\nR_rect_00: 0 -1 0 1 0 0 0 0 1\n"
    "P_rect_00: 18 0 15 0 0 18 11 0 0 0 1 0\n"
    "S_01: 40 30\nK_01: 23 0 18 0 24 13 0 0 1\nD_01: -0.36 0.19 0.002 0.0012 -0.06\n"
    "R_01: 0 0 1 0 1 0 -1 0 0\nT_01: -0.5 0.25 0.125\n"
    "S_rect_01: 32 24\nR_rect_01: 1 0 0 0 1 0 0 0 1\n"
    "P_rect_01: 18 0 15 -9 0 18 11 0 0 0 1 0\n";
// The axes of the scanner are x forward, y left, z up.
const char* const kVeloToCam =
    "calib_time: 15-Mar-2012 11:37:16\n"
    "R: 0 -1 0 0 0 -1 1 0 0\nT: 0.5 -0.25 -0.125\ndelta_f: 0 0\ndelta_c: 0 0\n";
const char* const kImuToVelo =
    "calib_time: 25-May-2012 16:47:16\nR: 1 0 0 0 1 0 0 0 1\nT: -0.75 0.5 -1\n";

std::string oxtsText(double lat, double lon, double alt, double roll, double pitch, double yaw,
                     int i) {
  std::ostringstream text;
  text.precision(15);
  text << lat << ' ' << lon << ' ' << alt << ' ' << roll << ' ' << pitch << ' ' << yaw;
  text << " 1 2 3 4 5";                    // vn ve vf vl vu
  text << " 0.1 0.2 9." << i << " 7 8 9";  // ax ay az af al au
  text << " 0.01 0.02 0.03 0.4 0.5 0.6";   // wx wy wz wf wl wu
  text << " 0.25 0.5 4 10 6 4 4";          // accuracies, navstat, numsats, three modes
  return text.str() + "\n";
}

std::string clock(int i, const char* decimals) {
  return "2011-09-26 13:02:0" + std::to_string(i) + decimals + "\n";
}

class Drive {
 public:
  explicit Drive(const std::string& kind = "sync") : name("2011_09_26_drive_0001_" + kind) {
    writeDrive(kind == "extract");
    writeText(date("calib_cam_to_cam.txt"), kCamToCam);
    writeText(date("calib_velo_to_cam.txt"), kVeloToCam);
    writeText(date("calib_imu_to_velo.txt"), kImuToVelo);
  }
  void writeDrive(bool is_raw) const {
    std::string times[2], oxts;
    for (int i = 0; i < 4; ++i) {
      const std::string number = padded(std::size_t(i), 10);
      for (int camera = 0; camera < 2; ++camera) {
        const std::string image = "image_0" + std::to_string(camera) + "/data/" + number + ".png";
        writeImage(drive(image), numbered(is_raw ? 40 : 32, is_raw ? 30 : 24, 2 * i + camera));
      }
      times[0] += clock(i, ".123456789");
      times[1] += clock(i, ".125000001");
      oxts += clock(i, ".100000000");
      writeText(drive("oxts/data/" + number + ".txt"),
                oxtsText(49.01, 8.43 + 0.001 * i, 112 + i, 0.1, -0.2, 0.3 + i, i));
    }
    writeText(drive("image_00/timestamps.txt"), times[0]);
    writeText(drive("image_01/timestamps.txt"), times[1]);
    writeText(drive("oxts/timestamps.txt"), oxts);
    fs::create_directories(drive("velodyne_points/data"));
  }
  void rename(const std::string& other) {
    fs::rename(path(), date(other));
    name = other;
  }
  std::string date(const std::string& file) const { return folder / ("2011_09_26/" + file); }
  std::string drive(const std::string& file) const { return date(name + "/" + file); }
  std::string path() const { return date(name); }
  std::string error(const Svar& parameters = Svar()) const {
    return errorOf(kittiRawFactory(), path(), parameters);
  }

  TempFolder folder;
  std::string name;
};

TEST(readKittiRaw, StampsAreExact) {
  const Drive drive;
  for (const std::string& path : {drive.path(), drive.date(""), drive.folder.path()}) {
    EXPECT_EQ(gslam::datasetFormatOf(path), "kittiraw");
    const auto dataset = open(kittiRawFactory(), path);
    EXPECT_EQ(dataset->info().name, drive.name);
    ASSERT_EQ(dataset->info().frame_count, 4U);
    EXPECT_EQ(dataset->info().first_stamp, kMorning + 123456789);
    EXPECT_EQ(dataset->info().last_stamp, kMorning + 3123456789);
    EXPECT_EQ(dataset->info().ground_truth[1].stamp, kMorning + 1100000000);
  }
  writeText(drive.drive("image_00/timestamps.txt"),
            "1970-01-01 00:00:00.000000001\r\n2000-02-29 23:59:59\r\n"
            "2000-03-01 00:00:00.5\r\n2036-12-31 12:00:00.0\r\n");
  fs::remove_all(drive.drive("oxts"));
  const auto dataset = open(kittiRawFactory(), drive.path());
  const auto frames = allFrames(*dataset);
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_EQ(frames[0]->stamp, 1);  // the others by `date -u -d ... +%s`
  EXPECT_EQ(frames[1]->stamp, 951868799000000000);
  EXPECT_EQ(frames[2]->stamp, 951868800500000000);
  EXPECT_EQ(frames[3]->stamp, 2114337600000000000);
  writeText(drive.drive("image_00/timestamps.txt"),
            "2096-02-29 12:00:00\n2100-02-28 23:59:59\n2100-03-01 00:00:00\n");
  const auto later = open(kittiRawFactory(), drive.path());
  EXPECT_EQ(later->info().first_stamp, 3981355200000000000);
  EXPECT_EQ(later->info().last_stamp, 4107542400000000000);  // there is no 2100-02-29
}

TEST(readKittiRaw, RectifiedCamerasOnTheImu) {
  const Drive drive;
  const auto dataset = open(kittiRawFactory(), drive.path());
  const gslam::DatasetInfo& info = dataset->info();
  EXPECT_TRUE(has(info.body, "inertial unit"));
  ASSERT_EQ(info.sensors.cameras.size(), 2U);
  const gslam::Camera expected = gslam::Camera::fromParameters("pinhole", 32, 24, {18, 18, 15, 11});
  // By the devkit: x = P_rect R_rect_00 (R | T)_velo_to_cam (R | T)_imu_to_velo X.
  const Vec3d X = {10, 1, 0.5};
  const Vec3d velo = X + Vec3d{-0.75, 0.5, -1};
  const Vec3d left = Vec3d{-velo[1], -velo[2], velo[0]} + Vec3d{0.5, -0.25, -0.125};
  const Vec3d rectified = {-left[1], left[0], left[2]};
  for (std::size_t i = 0; i < 2; ++i) {
    const gslam::CameraSensor& camera = info.sensors.cameras[i];
    EXPECT_EQ(camera.camera, expected);
    const double tx = i == 0 ? 0 : -9;
    Vec2d pixel;
    ASSERT_TRUE(camera.camera.project(camera.T_body_camera.inverse() * X, pixel));
    EXPECT_NEAR(pixel[0], (18 * rectified[0] + 15 * rectified[2] + tx) / rectified[2], 1e-12);
    EXPECT_NEAR(pixel[1], (18 * rectified[1] + 11 * rectified[2]) / rectified[2], 1e-12);
  }
  EXPECT_TRUE(info.sensors.imu.T_body_imu.isApprox(SE3d(), 0));
  EXPECT_TRUE(says(info.remarks, "velodyne_points was not read"));
}

TEST(readKittiRaw, RawCamerasOfExtracts) {
  const Drive drive("extract");
  const auto dataset = open(kittiRawFactory(), drive.path());
  ASSERT_EQ(dataset->info().frame_count, 4U);
  const gslam::CameraSensor &left = dataset->info().sensors.cameras[0],
                            &right = dataset->info().sensors.cameras[1];
  EXPECT_EQ(left.camera, gslam::Camera::fromParameters(
                             "radtan", 40, 30, {21, 22, 19, 14, -0.37, 0.2, 0.001, 0.0013, -0.07}));
  EXPECT_EQ(right.camera,
            gslam::Camera::fromParameters("radtan", 40, 30,
                                          {23, 24, 18, 13, -0.36, 0.19, 0.002, 0.0012, -0.06}));
  const Vec3d X = {10, 1, 0.5};
  const Vec3d velo = X + Vec3d{-0.75, 0.5, -1};
  const Vec3d in_left = Vec3d{-velo[1], -velo[2], velo[0]} + Vec3d{0.5, -0.25, -0.125};
  const Vec3d in_right = Vec3d{in_left[2], in_left[1], -in_left[0]} + Vec3d{-0.5, 0.25, 0.125};
  EXPECT_LT((left.T_body_camera.inverse() * X - in_left).norm(), 1e-14);
  EXPECT_LT((right.T_body_camera.inverse() * X - in_right).norm(), 1e-14);
  EXPECT_TRUE(has(drive.error(Svar::object({{"tolerance", 0.001}})), "no frame"));
}

TEST(readKittiRaw, SizesTellWhatNamesDoNot) {
  Drive raw("extract"), synced("sync");
  EXPECT_EQ(open(kittiRawFactory(), raw.path())->info().licence, "CC BY-NC-SA 3.0");
  raw.rename("renamed");
  synced.rename("renamed");
  const auto extract = open(kittiRawFactory(), raw.path());
  EXPECT_EQ(extract->info().sensors.cameras[1].camera.modelName(), "radtan");
  EXPECT_FALSE(says(extract->info().remarks, "as rare as images"));
  EXPECT_EQ(extract->info().licence, "");
  // Its images go by their stamps, which are 1.5 ms apart.
  EXPECT_TRUE(has(raw.error(Svar::object({{"tolerance", 0.001}})), "no frame"));
  const auto rectified = open(kittiRawFactory(), synced.path());
  EXPECT_EQ(rectified->info().sensors.cameras[1].camera.modelName(), "pinhole");
  EXPECT_TRUE(says(rectified->info().remarks, "as rare as images"));
  EXPECT_EQ(synced.error(Svar::object({{"tolerance", 0.001}})), "");
  EXPECT_FALSE(says(rectified->info().remarks, "taken to be; extracts"));
}

TEST(readKittiRaw, NamesThatSizesContradictAreSaid) {
  for (const bool is_raw : {false, true}) {
    const Drive drive(is_raw ? "sync" : "extract");
    fs::remove_all(drive.path());
    drive.writeDrive(is_raw);
    const auto dataset = open(kittiRawFactory(), drive.path());
    EXPECT_TRUE(says(dataset->info().remarks, "they go by their size"));
    EXPECT_EQ(dataset->info().sensors.cameras[0].camera.modelName(), is_raw ? "radtan" : "pinhole");
    EXPECT_TRUE(has(drive.error(Svar::object({{"tolerance", 0.001}})), "no frame"));
  }
}

TEST(readKittiRaw, UnknownKindIsSaid) {
  Drive drive;
  drive.rename("renamed");
  std::string text = kCamToCam;
  for (const char* size : {"S_rect_00: 32 24", "S_rect_01: 32 24"}) {
    const std::string raw = "S_0" + std::string(1, size[8]) + ": 40 30";
    text.replace(text.find(raw), raw.size(), raw.substr(0, 6) + "32 24");
  }
  writeText(drive.date("calib_cam_to_cam.txt"), text);
  const auto dataset = open(kittiRawFactory(), drive.path());
  EXPECT_TRUE(says(dataset->info().remarks, "it is taken to be; extracts"));
  EXPECT_EQ(dataset->info().sensors.cameras[0].camera.modelName(), "pinhole");
}

TEST(readKittiRaw, DrivesGoByTheNumberOfTheDrive) {
  const Drive drive;
  for (const char* other : {"2011_09_26_drive_0005_sync", "2011_09_28_drive_0009_sync",
                            "2011_09_28_drive_0009_extract"}) {
    fs::copy(drive.path(), drive.date(other), fs::copy_options::recursive);
  }
  const auto with = [](const Svar& wanted) { return Svar::object({{"sequence", wanted}}); };
  for (const Svar& wanted : {Svar(5), Svar("0005"), Svar("2011_09_26_drive_0005_sync")}) {
    EXPECT_EQ(open(kittiRawFactory(), drive.date(""), with(wanted))->info().name,
              "2011_09_26_drive_0005_sync");
  }
  const auto error = [&](int wanted) {
    return errorOf(kittiRawFactory(), drive.date(""), with(wanted));
  };
  EXPECT_TRUE(has(error(2011), "is '2011', which")) << error(2011);
  EXPECT_TRUE(has(error(9), "drive_0009_extract, 2011_09_28_drive_0009_sync")) << error(9);
}

TEST(readKittiRaw, InertialSamplesAndPositions) {
  const Drive drive;
  const auto dataset = open(kittiRawFactory(), drive.path());
  EXPECT_TRUE(dataset->info().sensors.has_imu);
  EXPECT_TRUE(dataset->info().sensors.has_gnss);
  const auto frames = allFrames(*dataset);
  ASSERT_EQ(frames[2]->imu.size(), 1U);
  const gslam::ImuSample& imu = frames[2]->imu[0];
  EXPECT_EQ(imu.stamp, kMorning + 2100000000);
  EXPECT_TRUE(imu.accel == (Vec3d{0.1, 0.2, 9.2}));
  EXPECT_TRUE(imu.gyro == (Vec3d{0.01, 0.02, 0.03}));
  ASSERT_EQ(frames[2]->gnss.size(), 1U);
  const gslam::GnssSample& gnss = frames[2]->gnss[0];
  EXPECT_NEAR(gnss.position.latitude, 49.01 * M_PI / 180, 1e-15);
  EXPECT_NEAR(gnss.position.longitude, 8.432 * M_PI / 180, 1e-15);
  EXPECT_EQ(gnss.position.altitude, 114);
  EXPECT_TRUE(gnss.velocity == (Vec3d{2, 1, 5}));  // ve vn vu
  EXPECT_EQ(gnss.covariance(0, 0), 0.0625);
  EXPECT_EQ(gnss.fix, gslam::GnssFix::rtk_fixed);
}

// R of convertOxtsToPose.m, written out.
gslam::Mat3d devkitRotation(double rx, double ry, double rz) {
  const double cx = std::cos(rx), sx = std::sin(rx), cy = std::cos(ry), sy = std::sin(ry);
  const double cz = std::cos(rz), sz = std::sin(rz);
  const gslam::Mat3d Rx = {{1, 0, 0, 0, cx, -sx, 0, sx, cx}};
  const gslam::Mat3d Ry = {{cy, 0, sy, 0, 1, 0, -sy, 0, cy}};
  const gslam::Mat3d Rz = {{cz, -sz, 0, sz, cz, 0, 0, 0, 1}};
  return Rz * Ry * Rx;
}

TEST(readKittiRaw, PosesAreTheDevkits) {
  const Drive drive;
  const auto dataset = open(kittiRawFactory(), drive.path());
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  ASSERT_EQ(truth.size(), 4U);
  const double scale = std::cos(49.01 * M_PI / 180), er = 6378137;
  for (std::size_t i = 0; i < 4; ++i) {
    const double east = scale * er * M_PI * 0.001 * double(i) / 180;
    EXPECT_LT((truth[i].pose.translation() - Vec3d{east, 0, double(i)}).norm(), 1e-6);
    const gslam::Mat3d error =
        truth[i].pose.rotation().matrix() - devkitRotation(0.1, -0.2, 0.3 + double(i));
    for (const double element : error.values) EXPECT_NEAR(element, 0, 1e-14);
  }
  // Mercator's scale is that of the first latitude, so that metres are metres.
  const gslam::EnuFrame frame(gslam::geodeticOfDegrees(49.01, 8.43, 112));
  const Vec3d exact = frame.fromGeodetic(gslam::geodeticOfDegrees(49.01, 8.433, 115));
  EXPECT_LT((truth[3].pose.translation() - exact).norm(), 0.003 * exact.norm());
}

TEST(readKittiRaw, SyncedImagesGoByNumber) {
  const Drive drive;
  fs::remove(drive.drive("image_01/data/0000000001.png"));
  fs::remove(drive.drive("image_01/timestamps.txt"));  // not needed: the numbers say it
  const auto dataset = open(kittiRawFactory(), drive.path());
  EXPECT_EQ(dataset->info().frame_count, 3U);
  EXPECT_TRUE(says(dataset->info().remarks, "image_00/data/0000000001.png"));
  const auto frames = allFrames(*dataset);
  const cv::Mat file = export_case::readImage(drive.drive("image_01/data/0000000003.png"));
  EXPECT_TRUE(export_case::samePixels<std::uint8_t>(file, frames[2]->images[1].image, {0}));
}

TEST(readKittiRaw, ArchiveReadsTheSame) {
  const Drive drive;
  zipFolder(drive.date(""), drive.folder / "drive.zip", "2011_09_26/");
  EXPECT_EQ(gslam::datasetFormatOf(drive.folder / "drive.zip"), "kittiraw");
  const auto a = open(kittiRawFactory(), drive.path());
  const auto b = open(kittiRawFactory(), drive.folder / "drive.zip");
  expectSame(*a, *b);
}

TEST(readKittiRaw, CalibrationThatIsMissingOrWrong) {
  const Drive drive;
  const std::string cameras = drive.date("calib_cam_to_cam.txt");
  const std::string whole = kCamToCam;
  writeText(cameras, whole.substr(0, whole.find("P_rect_01")));
  EXPECT_TRUE(has(drive.error(), "P_rect_01 is missing"));
  writeText(cameras, whole + "S_00: 1 2\n");
  EXPECT_TRUE(has(drive.error(), "S_00 stands here again"));
  std::string text = whole;
  writeText(cameras, text.replace(text.find("S_rect_00: 32 24"), 16, "S_rect_00: 33 24"));
  EXPECT_TRUE(has(drive.error(), "but images are 32 x 24"));
  writeText(cameras, ", 1 2\n" + whole);
  EXPECT_TRUE(has(drive.error(), "calib_cam_to_cam.txt:1:1")) << drive.error();
  writeText(cameras, whole);
  writeText(drive.date("calib_velo_to_cam.txt"), "R: 2 0 0 0 1 0 0 0 1\nT: 0 0 0\n");
  EXPECT_TRUE(has(drive.error(), "calib_velo_to_cam.txt:1: R is no rotation"));

  fs::remove(drive.date("calib_velo_to_cam.txt"));
  const auto no_imu = open(kittiRawFactory(), drive.path());
  EXPECT_TRUE(has(no_imu->info().body, "left grey camera"));
  EXPECT_FALSE(no_imu->info().sensors.has_imu);
  EXPECT_TRUE(no_imu->info().ground_truth.empty());
  EXPECT_TRUE(says(no_imu->info().remarks, "oxts was not read"));
  EXPECT_TRUE(
      no_imu->info().sensors.cameras[1].T_body_camera.isApprox(SE3d(SO3d(), {{0.5, 0, 0}}), 1e-15));

  fs::remove(cameras);
  EXPECT_TRUE(has(drive.error(), "calib_cam_to_cam.txt: is missing"));
  const auto mono = open(kittiRawFactory(), drive.path(), Svar::object({{"stereo", false}}));
  EXPECT_FALSE(mono->info().sensors.cameras[0].camera.isValid());
  EXPECT_TRUE(says(mono->info().remarks, "not calibrated"));
}

TEST(readKittiRaw, CamerasThatAreNoneAreErrorsWithTheirLine) {
  const Drive drive("extract");
  std::string text = kCamToCam;
  text.replace(text.find("K_01: 23"), 8, "K_01: -3");
  writeText(drive.date("calib_cam_to_cam.txt"), text);
  EXPECT_TRUE(has(drive.error(), "calib_cam_to_cam.txt:12: is no camera")) << drive.error();
}

TEST(readKittiRaw, FilesThatAreWrong) {
  const Drive drive;
  const std::string stamps = drive.drive("image_00/timestamps.txt");
  const std::string whole = export_case::readText(stamps);
  for (const char* line :
       {"2011-13-26 13:02:00.1", "2011-09-26", "2011-09-26 25:02:00.1", "2011-09-26 13:02:61.5",
        "2011-02-31 13:02:00.1", "2011-02-29 13:02:00.1", "2011-04-31 13:02:00.1",
        "2011-12-32 13:02:00.1", "2011-09-26T13:02:00.1", "1.5 2"}) {
    writeText(stamps, clock(0, ".1") + line + "\n");
    EXPECT_TRUE(has(drive.error(), "timestamps.txt:2:1")) << line << " " << drive.error();
  }
  writeText(stamps, clock(0, ".1") + clock(1, ".1 x"));
  EXPECT_TRUE(has(drive.error(), "timestamps.txt:2:23"));
  writeText(stamps, clock(0, ".1") + clock(1, ".1") + clock(1, ".1") + clock(0, ".5"));
  const auto twins = open(kittiRawFactory(), drive.path());
  EXPECT_EQ(twins->info().frame_count, 3U);
  EXPECT_TRUE(says(twins->info().remarks, "sorted"));
  writeText(stamps, clock(0, ".1"));
  EXPECT_EQ(open(kittiRawFactory(), drive.path())->info().frame_count, 1U);
  writeText(stamps, whole);

  const std::string sample = drive.drive("oxts/data/0000000002.txt");
  const std::string good = export_case::readText(sample);
  writeText(sample, good.substr(0, good.size() - 3));
  EXPECT_TRUE(has(drive.error(), "0000000002.txt:1: the file has 29 numbers"));
  writeText(sample, "nan " + good);
  EXPECT_TRUE(has(drive.error(), "0000000002.txt:1:1"));
  writeText(sample, "95" + good.substr(2));
  EXPECT_TRUE(has(drive.error(), "0000000002.txt:1: fields 1 and 2"));
  writeText(sample, "");
  EXPECT_TRUE(has(drive.error(), "0000000002.txt"));
  fs::remove(sample);
  const auto gap = open(kittiRawFactory(), drive.path());
  ASSERT_EQ(gap->info().ground_truth.size(), 3U);
  EXPECT_EQ(gap->info().ground_truth[2].stamp, kMorning + 3100000000);
  writeText(drive.drive("oxts/timestamps.txt"), clock(0, ".1") + clock(0, ".1") + clock(2, ".1"));
  EXPECT_TRUE(says(open(kittiRawFactory(), drive.path())->info().remarks, "stamp of another"));
}

TEST(readKittiRaw, ImagesThatAreMissingOrBroken) {
  const Drive drive;
  cutInHalf(drive.drive("image_01/data/0000000001.png"));
  const auto cut = open(kittiRawFactory(), drive.path());
  ASSERT_NE(cut->next(), nullptr);
  EXPECT_THROW(cut->next(), gslam::FileError);
  EXPECT_NE(cut->next(), nullptr);
  EXPECT_TRUE(has(drive.error(Svar::object({{"cameras", "colour"}})), "image_02/data"));
  fs::remove_all(drive.drive("image_00/data"));
  fs::create_directories(drive.drive("image_00/data"));
  EXPECT_TRUE(has(drive.error(), "image_00/data: has no images"));
  const TempFolder empty;
  EXPECT_TRUE(has(errorOf(kittiRawFactory(), empty.path()), "has no sequence"));
}

}  // namespace
