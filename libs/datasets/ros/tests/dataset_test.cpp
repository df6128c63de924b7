// Recordings as datasets.
#include <gslam/datasets_ros/ros_dataset.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "dataset/group_images.h"
#include "dataset/topics.h"
#include "db3_writer.h"
#include "mcap_writer.h"
#include "test_data.h"

namespace {

using gslam::Dataset;
using gslam::Frame;
using gslam::ImageKind;
using gslam::Svar;

constexpr Coding kCoding = Coding::little_cdr;
constexpr std::int64_t kMs = 1000000;
constexpr std::int64_t kStart = 1600000000000000000;
constexpr int kFrameWidth = 4, kFrameHeight = 3, kFrames = 6;

// When it was measured; it was received 3 ms later.
std::int64_t stampOf(int i) {
  return kStart + i * 50 * kMs;
}

std::vector<std::uint8_t> pixelsOf(int camera, int i) {
  return noise(std::size_t(kFrameWidth * kFrameHeight * (camera == 0 ? 1 : 3)),
               std::uint32_t(100 * camera + i));
}

Recorded imageOf(int camera, int i, std::int64_t later = 0) {
  const bool is_left = camera == 0;
  const std::int64_t stamp = stampOf(i) + later;
  return {is_left ? "/left/image_raw" : "/right/image_raw", "sensor_msgs/Image", stamp + 3 * kMs,
          imageBytes(kCoding, stamp, is_left ? "left" : "right", kFrameWidth, kFrameHeight,
                     is_left ? "mono8" : "rgb8", kFrameWidth * (is_left ? 1 : 3), false,
                     pixelsOf(camera, i))};
}

std::vector<Recorded> rigMessages() {
  std::vector<Recorded> all;
  InfoFields right;
  right.model = "equidistant";
  right.d = {0.1, 0.01, 0.001, 0.0001};
  // The camera looks along x of the unit: its z is their x, its x their -y.
  all.push_back(
      {"/tf_static", "tf2_msgs/TFMessage", kStart,
       transformBytes(kCoding, kStart, "imu", "left", {0.1, 0.2, 0.3, -0.5, 0.5, -0.5, 0.5})});
  all.push_back({"/tf_static", "tf2_msgs/TFMessage", kStart,
                 transformBytes(kCoding, kStart, "left", "right", {0.5, 0, 0, 0, 0, 0, 1})});
  all.push_back({"/tf_static", "tf2_msgs/TFMessage", kStart,
                 transformBytes(kCoding, kStart, "gps", "imu", {-1, -2, -3, 0, 0, 0, 1})});
  for (int i = 0; i < kFrames; ++i) {
    const std::int64_t stamp = stampOf(i), received = stamp + 3 * kMs;
    all.push_back(imageOf(0, i));
    all.push_back(imageOf(1, i, 2 * kMs));
    all.push_back({"/left/camera_info", "sensor_msgs/CameraInfo", received,
                   infoBytes(kCoding, stamp, "left", InfoFields())});
    all.push_back({"/right/camera_info", "sensor_msgs/CameraInfo", received,
                   infoBytes(kCoding, stamp, "right", right)});
    for (int k = 0; k < 5; ++k) {
      const std::int64_t at = stamp + k * 10 * kMs;
      all.push_back({"/imu", "sensor_msgs/Imu", at + kMs, imuBytes(kCoding, at, i + k / 10.0)});
    }
    all.push_back({"/fix", "sensor_msgs/NavSatFix", received,
                   fixBytes(kCoding, stamp, 0, {48.0 + i, 11, 500})});
    all.push_back({"/vicon/pose", "geometry_msgs/PoseStamped", received,
                   poseBytes(kCoding, stamp, {double(i), 0, 0, 0, 0, 0, 1})});
    all.push_back({"/chatter", "std_msgs/String", received, Encoder(kCoding).text("hi").bytes()});
  }
  return all;
}

std::string writeMcap(const std::string& name, const std::vector<Recorded>& messages,
                      const std::string& compression = "lz4") {
  const std::string path = folderOfTests() + name;
  mcap_writer::Shape shape;
  shape.compression = compression;
  shape.chunk_messages = 7;
  writeFile(path, mcap_writer::write(messages, shape));
  return path;
}

std::unique_ptr<Dataset> open(const std::string& path, const Svar& parameters = Svar()) {
  return gslam::rosFactory().open(path, parameters);
}

void expectPixels(const gslam::Image& image, const std::vector<std::uint8_t>& pixels) {
  const std::size_t row = image.rowBytes();
  ASSERT_EQ(row * std::size_t(image.height()), pixels.size());
  for (int y = 0; y < image.height(); ++y) {
    EXPECT_TRUE(std::equal(image.bytes(y), image.bytes(y) + row,
                           pixels.begin() + std::ptrdiff_t(std::size_t(y) * row)));
  }
}

void expectRig(const std::string& path) {
  const auto dataset = open(path);
  const gslam::DatasetInfo& info = dataset->info();
  ASSERT_EQ(info.sensors.cameras.size(), 2U);
  EXPECT_EQ(info.sensors.cameras[0].name, "left");
  EXPECT_EQ(info.sensors.cameras[1].name, "right");
  EXPECT_EQ(info.sensors.cameras[0].kind, ImageKind::grey);
  EXPECT_EQ(info.sensors.cameras[1].kind, ImageKind::rgb);
  EXPECT_EQ(info.frame_count, std::size_t(kFrames));
  for (int i = 0; i < kFrames; ++i) {
    const auto frame = dataset->next();
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->stamp, stampOf(i));
    ASSERT_EQ(frame->images.size(), 2U);
    expectPixels(frame->images[0].image, pixelsOf(0, i));
    expectPixels(frame->images[1].image, pixelsOf(1, i));
    EXPECT_EQ(frame->imu.size(), i == 0 ? 1U : 5U);
    EXPECT_EQ(frame->imu.back().stamp, stampOf(i));
    EXPECT_EQ(frame->imu.back().gyro, (gslam::Vec3d{double(i), i + 1.0, i + 2.0}));
    EXPECT_EQ(frame->imu.back().accel, (gslam::Vec3d{i + 3.0, i + 4.0, i + 5.0}));
    ASSERT_EQ(frame->gnss.size(), 1U);
    EXPECT_NEAR(frame->gnss[0].position.latitude, (48 + i) * 3.14159265358979 / 180, 1e-12);
    EXPECT_EQ(frame->gnss[0].covariance(1, 1), 5);
    EXPECT_EQ(frame->gnss[0].fix, gslam::GnssFix::single);
    EXPECT_FALSE(frame->has_prior);
  }
  EXPECT_EQ(dataset->next(), nullptr);
}

TEST(ros_dataset, a_rig_comes_back_as_it_was_written) {
  expectRig(writeMcap("rig.mcap", rigMessages()));
  expectRig(writeMcap("rig_zstd.mcap", rigMessages(), "zstd"));
  expectRig(writeMcap("rig_plain.mcap", rigMessages(), ""));
  const std::string path = folderOfTests() + "rig.db3";
  db3_writer::write(path, rigMessages());
  expectRig(path);
}

TEST(ros_dataset, calibrations_and_places_of_sensors) {
  const auto dataset = open(writeMcap("rig.mcap", rigMessages()));
  const gslam::SensorRig& rig = dataset->info().sensors;
  EXPECT_EQ(rig.cameras[0].camera,
            gslam::Camera::fromParameters("pinhole", 4, 3, {100, 110, 1.5, 1}));
  EXPECT_EQ(rig.cameras[1].camera.modelName(), "kannala_brandt");
  // A point in front of the left camera lies along x of the unit.
  const gslam::Vec3d ahead = rig.cameras[0].T_body_camera * gslam::Vec3d{0, 0, 2};
  EXPECT_NEAR((ahead - gslam::Vec3d{2.1, 0.2, 0.3}).norm(), 0, 1e-12);
  // The right camera is half a metre along x of the left one: -y of the unit.
  const gslam::Vec3d right = rig.cameras[1].T_body_camera.translation();
  EXPECT_NEAR((right - gslam::Vec3d{0.1, -0.3, 0.3}).norm(), 0, 1e-12);
  EXPECT_TRUE(rig.has_imu);
  EXPECT_NEAR(rig.imu.rate, 100, 1e-6);
  EXPECT_TRUE(rig.has_gnss);
  EXPECT_NEAR((rig.gnss_antenna - gslam::Vec3d{1, 2, 3}).norm(), 0, 1e-12);
  EXPECT_EQ(dataset->info().body, "the inertial unit of /imu (frame 'imu')");
  EXPECT_EQ(dataset->info().format, "ros");
  EXPECT_EQ(dataset->info().name, "rig");
}

TEST(ros_dataset, ground_truth_and_what_was_not_read) {
  const auto dataset = open(writeMcap("rig.mcap", rigMessages()));
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  ASSERT_EQ(truth.size(), std::size_t(kFrames));
  EXPECT_EQ(truth[2].stamp, stampOf(2));
  EXPECT_EQ(truth[2].pose.translation()[0], 2);
  const auto& remarks = dataset->info().remarks;
  EXPECT_TRUE(hasAny(remarks, "topic /chatter of type std_msgs/msg/String was not read (6"));
  EXPECT_FALSE(hasAny(remarks, "topic /imu"));
  EXPECT_FALSE(hasAny(remarks, "topic /tf_static"));
  EXPECT_TRUE(hasAny(remarks, "of which frame /vicon/pose has the poses is not said"));
  EXPECT_FALSE(hasAny(remarks, "the identity was taken"));
}

TEST(ros_dataset, topics_that_parameters_name) {
  const std::string path = writeMcap("rig.mcap", rigMessages());
  const auto one = open(path, Svar::object({{"images", "/right/image_raw"},
                                            {"imu", "none"},
                                            {"gnss", "none"},
                                            {"ground_truth", "none"},
                                            {"camera_info", "/left/camera_info"}}));
  EXPECT_EQ(one->info().sensors.cameras.size(), 1U);
  EXPECT_EQ(one->info().sensors.cameras[0].camera.modelName(), "pinhole");
  EXPECT_FALSE(one->info().sensors.has_imu);
  EXPECT_FALSE(one->info().sensors.has_gnss);
  EXPECT_TRUE(one->info().ground_truth.empty());
  EXPECT_EQ(one->info().body, "camera 'right' (frame 'right')");
  const auto both = open(path, Svar::object({{"images", "/right/image_raw, /left/image_raw"}}));
  EXPECT_EQ(both->info().sensors.cameras[0].name, "right");
  const auto listed = open(path, Svar::object({{"images", Svar::array({"/left/image_raw"})},
                                               {"ground_truth", "/tf_static:gps.imu"}}));
  EXPECT_EQ(listed->info().sensors.cameras.size(), 1U);
  ASSERT_EQ(listed->info().ground_truth.size(), 1U);
  EXPECT_EQ(listed->info().ground_truth[0].pose.translation()[2], -3);
}

TEST(ros_dataset, names_that_are_wrong_are_errors_that_list_what_there_is) {
  const std::string path = writeMcap("rig.mcap", rigMessages());
  const auto error = [&](const char* parameter, const char* value) {
    return errorOf([&] { open(path, Svar::object({{parameter, value}})); });
  };
  EXPECT_TRUE(has(error("images", "/front"), "has no topic '/front'; there are: /tf_static ("));
  EXPECT_TRUE(has(error("images", "/front"), "/imu (sensor_msgs/msg/Imu)"));
  EXPECT_TRUE(has(error("images", "/imu"), "/imu, which is of type sensor_msgs/msg/Imu, expected"));
  EXPECT_TRUE(has(error("imu", "/fix"), "expected sensor_msgs/Imu"));
  EXPECT_TRUE(has(error("imu", "/imu,/fix"), "names several topics"));
  EXPECT_TRUE(has(error("ground_truth", "/chatter"), "which has no poses"));
  EXPECT_TRUE(has(error("ground_truth", "/tf_static"), "/tf_static:gps.imu, /tf_static:imu.left"));
  EXPECT_TRUE(has(error("ground_truth", "/tf_static:a.b"), "has no transform 'a.b'"));
  EXPECT_TRUE(has(error("camera_info", "/left/camera_info"), "one for each of 2 cameras"));
  EXPECT_TRUE(has(error("stamps", "mine"), "expected header or received"));
  EXPECT_TRUE(has(errorOf([&] { open(path, Svar::object({{"tolerance", -1.0}})); }), "tolerance"));
  EXPECT_TRUE(has(errorOf([&] { open(path, Svar::object({{"imagess", "x"}})); }), "images"));
}

TEST(ros_dataset, stamps_when_messages_were_received) {
  const auto dataset =
      open(writeMcap("rig.mcap", rigMessages()), Svar::object({{"stamps", "received"}}));
  EXPECT_EQ(dataset->info().first_stamp, stampOf(0) + 3 * kMs);
}

// In all of what has stamps, or a truth would be 3 ms beside its images.
TEST(ros_dataset, stamps_when_messages_were_received_count_for_all_topics) {
  std::vector<Recorded> messages = rigMessages();
  for (int i = 0; i < kFrames; ++i) {
    messages.push_back({"/odom", "nav_msgs/Odometry", stampOf(i) + 3 * kMs,
                        odometryBytes(kCoding, stampOf(i), {double(i), 0, 0, 0, 0, 0, 1}, 0.1)});
  }
  const auto dataset =
      open(writeMcap("received.mcap", messages),
           Svar::object({{"stamps", "received"}, {"odometry", "/odom"}, {"tolerance", 0.0025}}));
  EXPECT_EQ(dataset->info().ground_truth[1].stamp, stampOf(1) + 3 * kMs);
  dataset->seek(1);
  const auto frame = dataset->next();
  EXPECT_EQ(frame->stamp, stampOf(1) + 3 * kMs);
  ASSERT_TRUE(frame->has_prior);
  EXPECT_EQ(frame->prior.pose().translation()[0], 1);
  ASSERT_FALSE(frame->imu.empty());
  EXPECT_EQ(frame->imu.back().stamp, stampOf(1) + kMs);  // of /imu, 1 ms after it was measured
  ASSERT_EQ(frame->gnss.size(), 1U);
  EXPECT_EQ(frame->gnss[0].stamp, stampOf(1) + 3 * kMs);
}

// As stereo_image_proc has it: both cameras name the frame of the left one.
TEST(ros_dataset, the_right_camera_of_a_rectified_pair_is_where_p_says) {
  constexpr double kBaseline = 0.25;
  const auto messagesOf = [](const std::string& name, const char* frame, double p3) {
    InfoFields info;
    info.p = {100, 0, 1.5, p3, 0, 100, 1, 0, 0, 0, 1, 0};
    return std::vector<Recorded>{{"/" + name + "/image_rect", "sensor_msgs/Image", kStart,
                                  imageBytes(kCoding, kStart, frame, kFrameWidth, kFrameHeight,
                                             "mono8", kFrameWidth, false, pixelsOf(0, 1))},
                                 {"/" + name + "/camera_info", "sensor_msgs/CameraInfo", kStart,
                                  infoBytes(kCoding, kStart, frame, info)}};
  };
  std::vector<Recorded> messages = messagesOf("left", "optical", 0);
  const auto right = messagesOf("right", "optical", -100 * kBaseline);
  messages.insert(messages.end(), right.begin(), right.end());
  const auto pair = open(writeMcap("pair.mcap", messages));
  const auto& cameras = pair->info().sensors.cameras;
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].T_body_camera.translation(), (gslam::Vec3d{0, 0, 0}));
  EXPECT_EQ(cameras[1].T_body_camera.translation(), (gslam::Vec3d{kBaseline, 0, 0}));
  // P in the frame of the left camera, and the right camera from where it is: the same pixel.
  const gslam::Vec3d point{0.3, -0.2, 5};
  const gslam::Vec3d in_right = cameras[1].T_body_camera.inverse() * point;
  const double u = (100 * point[0] + 1.5 * point[2] - 100 * kBaseline) / point[2];
  EXPECT_NEAR(100 * in_right[0] / in_right[2] + 1.5, u, 1e-12);
  EXPECT_TRUE(hasAny(pair->info().remarks, "P of /right/camera_info is the calibration"));
  EXPECT_FALSE(hasAny(pair->info().remarks, "was not applied"));

  const auto alone = open(writeMcap("alone.mcap", messagesOf("right", "optical", -25)));
  EXPECT_EQ(alone->info().sensors.cameras[0].T_body_camera.translation(), (gslam::Vec3d{0, 0, 0}));
  EXPECT_TRUE(hasAny(alone->info().remarks, "the fourth column of P of camera 'right' was not"));

  // Where the right one comes first, it is still beside the frame, which is the body.
  const auto turned = open(writeMcap("pair.mcap", messages),
                           Svar::object({{"images", "/right/image_rect,/left/image_rect"}}));
  EXPECT_EQ(turned->info().sensors.cameras[0].T_body_camera.translation(),
            (gslam::Vec3d{kBaseline, 0, 0}));
  EXPECT_EQ(turned->info().body, "the frame of camera 'right' (frame 'optical')");
}

TEST(ros_dataset, calibrations_that_change_are_said) {
  std::vector<Recorded> messages = rigMessages();
  InfoFields zoomed;
  zoomed.k[0] = 200;
  messages.push_back({"/left/camera_info", "sensor_msgs/CameraInfo", stampOf(9),
                      infoBytes(kCoding, stampOf(9), "left", zoomed)});
  messages.push_back({"/left/camera_info", "sensor_msgs/CameraInfo", stampOf(10), {0, 1, 0, 0}});
  const auto dataset = open(writeMcap("zoom.mcap", messages));
  EXPECT_EQ(dataset->info().sensors.cameras[0].camera.parameter("fx"), 100);
  const auto& remarks = dataset->info().remarks;
  EXPECT_TRUE(hasAny(remarks, "skipped 1 calibrations of /left/camera_info that differ"));
  EXPECT_TRUE(hasAny(remarks, "skipped 1 calibrations of /left/camera_info that cannot be read"));
  EXPECT_FALSE(hasAny(remarks, "calibrations of /right/camera_info"));
}

TEST(ros_dataset, of_static_transforms_that_change_the_last_one_counts) {
  std::vector<Recorded> messages = rigMessages();
  const auto place = [](double x) {
    return Recorded{"/tf_static", "tf2_msgs/TFMessage", stampOf(3),
                    transformBytes(kCoding, kStart, "/left", "right", {x, 0, 0, 0, 0, 0, 1})};
  };
  messages.push_back(place(0.5));  // the same again
  EXPECT_FALSE(hasAny(open(writeMcap("again.mcap", messages))->info().remarks, "changes"));
  messages.push_back(place(0.75));
  const auto dataset = open(writeMcap("moved.mcap", messages));
  const gslam::Vec3d right = dataset->info().sensors.cameras[1].T_body_camera.translation();
  EXPECT_NEAR((right - gslam::Vec3d{0.1, -0.55, 0.3}).norm(), 0, 1e-12);
  EXPECT_TRUE(hasAny(dataset->info().remarks,
                     "the static transform of /left to right changes: the last one was taken"));
}

TEST(ros_dataset, a_topic_of_images_that_cannot_be_read_stops_no_other) {
  std::vector<Recorded> messages = rigMessages();
  messages.push_back({"/cloud/image", "sensor_msgs/Image", kStart,
                      imageBytes(kCoding, kStart, "left", 4, 3, "yuv422", 8, false, noise(24, 1))});
  const std::string path = writeMcap("yuv.mcap", messages);
  const auto dataset = open(path);
  EXPECT_EQ(dataset->info().sensors.cameras.size(), 2U);
  const auto& remarks = dataset->info().remarks;
  EXPECT_TRUE(hasAny(remarks, "camera 'cloud' was left out: "));
  EXPECT_TRUE(hasAny(remarks, "the encoding of the image is 'yuv422'"));
  EXPECT_TRUE(hasAny(remarks, "topic /cloud/image of type sensor_msgs/msg/Image was not read"));
  EXPECT_TRUE(has(errorOf([&] {
                    open(path, Svar::object({{"images", "/cloud/image"}}));
                  }),
                  "the encoding of the image is 'yuv422'"));
  EXPECT_TRUE(has(errorOf([&] { open(writeMcap("only_yuv.mcap", {messages.back()})); }),
                  "the encoding of the image is 'yuv422'"));
}

TEST(ros_dataset, stamps_too_dense_for_the_tolerance_and_too_many_cameras_are_refused) {
  std::vector<Recorded> dense;
  for (int i = 0; i < 1200; ++i) {
    for (const char* topic : {"/a/image", "/b/image"}) {
      dense.push_back({topic, "sensor_msgs/Image", kStart + i,
                       imageBytes(kCoding, kStart + i, "f", 1, 1, "mono8", 1, false, {7})});
    }
  }
  const std::string path = writeMcap("dense.mcap", dense);
  const std::string error = errorOf([&] { open(path); });
  EXPECT_TRUE(has(error, "topic /a/image has more than 1000 messages within the `tolerance`"));
  EXPECT_EQ(open(path, Svar::object({{"tolerance", 5e-7}}))->info().frame_count, 1200U);
  std::vector<Recorded> cameras;
  for (int i = 0; i < 300; ++i) {
    cameras.push_back({"/c" + std::to_string(i) + "/image", "sensor_msgs/Image", kStart,
                       imageBytes(kCoding, kStart, "f", 1, 1, "mono8", 1, false, {7})});
  }
  const std::string many = writeMcap("cameras.mcap", cameras);
  EXPECT_TRUE(has(errorOf([&] { open(many); }), "has 300 topics of images, more than 256"));
  // Of topics that are not read, the first ones are named.
  const auto few = open(many, Svar::object({{"images", "/c7/image"}}));
  EXPECT_TRUE(hasAny(few->info().remarks, "249 more topics were not read"));
  EXPECT_LT(few->info().remarks.size(), 60U);
}

TEST(ros_dataset, stamps_further_apart_than_an_int64) {
  std::vector<Recorded> messages;
  // CDR has signed seconds; received is what is not.
  for (const std::int64_t stamp : {-2147483648LL * 1000000000, 2147483647LL * 1000000000}) {
    Encoder out(kCoding);
    out.number(static_cast<std::int32_t>(stamp / 1000000000)).u32(0).text("map");
    messages.push_back({"/gt", "geometry_msgs/PoseStamped", 5 + std::int64_t(messages.size()),
                        out.f64s({1, 2, 3, 0, 0, 0, 1}).bytes()});
  }
  messages.push_back({"/gt", "geometry_msgs/PoseStamped", INT64_MAX,
                      poseBytes(kCoding, 0, {1, 2, 3, 0, 0, 0, 1})});
  const std::string path = writeMcap("apart.mcap", messages);
  const auto error = errorOf([&] { open(path, Svar::object({{"frame_every", 1.0}})); });
  EXPECT_TRUE(has(error, "from -2147483648.000000000 to 9223372036.854775807 s")) << error;
}

TEST(ros_dataset, a_covariance_of_a_position_that_is_not_finite_is_none) {
  std::vector<Recorded> messages = rigMessages();
  Recorded fix = {"/fix", "sensor_msgs/NavSatFix", stampOf(1) + 10 * kMs,
                  fixBytes(kCoding, stampOf(1) + 10 * kMs, 0, {48, 11, 500})};
  const double nan = std::nan("");
  std::memcpy(&fix.bytes[fix.bytes.size() - 9], &nan, sizeof(nan));  // the last of the nine
  messages.push_back(fix);
  const auto dataset = open(writeMcap("fix.mcap", messages));
  EXPECT_TRUE(hasAny(dataset->info().remarks, "skipped 1 covariances of /fix that are not finite"));
  dataset->seek(2);
  const auto frame = dataset->next();
  ASSERT_EQ(frame->gnss.size(), 2U);
  EXPECT_EQ(frame->gnss[0].covariance, gslam::Mat3d());
  EXPECT_EQ(frame->gnss[1].covariance(1, 1), 5);
}

TEST(ros_dataset, frames_that_lack_an_image) {
  std::vector<Recorded> messages;
  for (int i = 0; i < kFrames; ++i) {
    if (i != 2) messages.push_back(imageOf(0, i));
    if (i != 4) messages.push_back(imageOf(1, i, i == 5 ? 30 * kMs : 0));
  }
  const std::string path = writeMcap("gaps.mcap", messages);
  const auto all = open(path);
  // Image 5 of the right camera is too late for its frame, and makes one of its own.
  ASSERT_EQ(all->info().frame_count, 7U);
  EXPECT_TRUE(hasAny(all->info().remarks, "4 of 7 frames lack an image of a camera"));
  all->seek(2);
  auto frame = all->next();
  ASSERT_EQ(frame->images.size(), 1U);
  EXPECT_EQ(frame->images[0].name, "right");
  expectPixels(frame->images[0].image, pixelsOf(1, 2));
  const auto complete = open(path, Svar::object({{"complete", true}}));
  EXPECT_EQ(complete->info().frame_count, 3U);
  EXPECT_TRUE(hasAny(complete->info().remarks, "4 of 7 frames lack an image of a camera: they"));
  const auto loose = open(path, Svar::object({{"tolerance", 0.035}}));
  EXPECT_EQ(loose->info().frame_count, 6U);
  const auto error = errorOf([&] {
    std::vector<Recorded> apart = {imageOf(0, 0), imageOf(1, 3)};
    open(writeMcap("apart.mcap", apart), Svar::object({{"complete", true}}));
  });
  EXPECT_TRUE(has(error, "a larger `tolerance`")) << error;
}

TEST(ros_dataset, stamps_that_are_zero_twice_or_out_of_order) {
  std::vector<Recorded> messages = {imageOf(0, 2), imageOf(0, 1), imageOf(0, 2), imageOf(0, 3)};
  messages[0].received = messages[1].received - 1;
  messages.push_back(messages[0]);
  messages.back().bytes = imageBytes(kCoding, 0, "left", kFrameWidth, kFrameHeight, "mono8",
                                     kFrameWidth, false, pixelsOf(0, 9));
  messages.back().received = stampOf(9);
  const auto dataset = open(writeMcap("order.mcap", messages));
  EXPECT_EQ(dataset->info().frame_count, 4U);
  EXPECT_EQ(dataset->info().first_stamp, stampOf(1));
  EXPECT_EQ(dataset->info().last_stamp, stampOf(9));
  const auto& remarks = dataset->info().remarks;
  EXPECT_TRUE(hasAny(remarks, "have no stamp: when they were received was taken"));
  EXPECT_TRUE(hasAny(remarks, "are out of order: they were sorted"));
  EXPECT_TRUE(hasAny(remarks, "skipped 1 messages of /left/image_raw with the stamp of another"));
}

TEST(ros_dataset, samples_and_poses_that_are_not_finite_are_skipped_and_said) {
  std::vector<Recorded> messages = rigMessages();
  const double nan = std::nan("");
  messages.push_back({"/imu", "sensor_msgs/Imu", stampOf(7), imuBytes(kCoding, stampOf(7), nan)});
  messages.push_back({"/fix", "sensor_msgs/NavSatFix", stampOf(7),
                      fixBytes(kCoding, stampOf(7), 0, {nan, 11, 500})});
  messages.push_back({"/fix", "sensor_msgs/NavSatFix", stampOf(8),
                      fixBytes(kCoding, stampOf(8), -1, {nan, nan, nan})});
  messages.push_back({"/vicon/pose", "geometry_msgs/PoseStamped", stampOf(7),
                      poseBytes(kCoding, stampOf(7), {nan, 0, 0, 0, 0, 0, 1})});
  messages.push_back({"/vicon/pose", "geometry_msgs/PoseStamped", stampOf(8),
                      poseBytes(kCoding, stampOf(8), {0, 0, 0, 0, 0, 0, 0})});
  messages.push_back({"/vicon/pose", "geometry_msgs/PoseStamped", stampOf(9),
                      poseBytes(kCoding, stampOf(3), {0, 0, 0, 0, 0, 0, 1})});
  const auto dataset = open(writeMcap("nan.mcap", messages));
  const auto& remarks = dataset->info().remarks;
  EXPECT_TRUE(hasAny(remarks, "skipped 1 samples of /imu that are not finite"));
  EXPECT_TRUE(hasAny(remarks, "skipped 1 samples of /fix that are not finite"));
  EXPECT_TRUE(hasAny(remarks, "skipped 2 poses of /vicon/pose that are not finite"));
  EXPECT_TRUE(hasAny(remarks, "skipped 1 poses of /vicon/pose with the stamp of another"));
  EXPECT_EQ(dataset->info().ground_truth.size(), std::size_t(kFrames));
}

TEST(ros_dataset, what_a_damaged_image_throws_names_topic_and_time_and_the_next_frame_comes) {
  std::vector<Recorded> messages = rigMessages();
  for (Recorded& one : messages) {
    if (one.topic == "/left/image_raw" && one.received == stampOf(2) + 3 * kMs) {
      one.bytes.resize(one.bytes.size() - 3);
    }
    if (one.topic == "/left/image_raw" && one.received == stampOf(3) + 3 * kMs) {
      one.bytes = imageBytes(kCoding, stampOf(3), "left", 3, 4, "mono8", 3, false, pixelsOf(0, 3));
    }
  }
  const auto dataset = open(writeMcap("damaged.mcap", messages));
  dataset->next();
  dataset->next();
  const std::string short_error = errorOf([&] { dataset->next(); });
  EXPECT_TRUE(has(short_error, "topic /left/image_raw, message at 1600000000.1")) << short_error;
  EXPECT_TRUE(has(short_error, "ends early")) << short_error;
  EXPECT_TRUE(has(errorOf([&] { dataset->next(); }), "3 x 4"));
  EXPECT_EQ(dataset->next()->stamp, stampOf(4));
}

TEST(ros_dataset, a_calibration_of_another_size_is_an_error_unless_it_is_not_wanted) {
  std::vector<Recorded> messages = {imageOf(0, 0)};
  InfoFields info;
  info.width = 8;
  messages.push_back({"/left/camera_info", "sensor_msgs/CameraInfo", kStart,
                      infoBytes(kCoding, kStart, "left", info)});
  const std::string path = writeMcap("size.mcap", messages);
  EXPECT_TRUE(has(errorOf([&] { open(path); }), "its calibration is for 8 x 3 pixels"));
  const auto without = open(path, Svar::object({{"camera_info", "none"}}));
  EXPECT_FALSE(without->info().sensors.cameras[0].camera.isValid());
  EXPECT_TRUE(hasAny(without->info().remarks, "camera 'left' has no calibration"));
}

TEST(ros_dataset, depth_and_compressed_topics) {
  const auto depth = [&](const char* topic, const char* encoding, int bytes) {
    return Recorded{
        topic, "sensor_msgs/Image", kStart,
        imageBytes(kCoding, kStart, "d", kFrameWidth, kFrameHeight, encoding, kFrameWidth * bytes,
                   false, noise(std::size_t(kFrameWidth * kFrameHeight * bytes), 1))};
  };
  Recorded compressed = {"/cam/image_raw/compressed", "sensor_msgs/CompressedImage", kStart,
                         compressedBytes(kCoding, kStart, "jpeg", {1, 2, 3})};
  const auto dataset = open(writeMcap(
      "depth.mcap", {depth("/cam/image_raw", "mono8", 1), compressed,
                     depth("/depth/image", "mono16", 2), depth("/metres/image", "32FC1", 4)}));
  const auto& cameras = dataset->info().sensors.cameras;
  ASSERT_EQ(cameras.size(), 3U);
  EXPECT_EQ(cameras[0].name, "cam");
  EXPECT_EQ(cameras[1].kind, ImageKind::depth);
  EXPECT_EQ(cameras[1].depth_scale, 0.001);
  EXPECT_EQ(cameras[2].kind, ImageKind::depth);
  EXPECT_EQ(cameras[2].depth_scale, 1);
  EXPECT_TRUE(hasAny(dataset->info().remarks, "topic /cam/image_raw/compressed of type"));
  EXPECT_EQ(cameras[1].name, "depth");
  EXPECT_EQ(cameras[2].name, "metres");
}

// --- without images ------------------------------------------------------------------------------

TEST(ros_dataset, a_recording_without_images_has_frames_at_the_stamps_of_odometry) {
  NEEDS_TEST_DATA();
  const auto dataset = open(test_data::folder() + "bags/ros1/test2_jackal_imu_odom.bag");
  const gslam::DatasetInfo& info = dataset->info();
  // Counts and values were read from the bag with Python's struct and bz2.
  EXPECT_EQ(info.frame_count, 3060U);
  EXPECT_EQ(info.first_stamp, 47584000000);
  EXPECT_EQ(info.last_stamp, 108764000000);
  EXPECT_TRUE(hasAny(info.remarks, "there are no images: frames are at the stamps of /jackal"));
  EXPECT_TRUE(info.sensors.has_imu);
  EXPECT_TRUE(info.sensors.cameras.empty());
  std::size_t samples = 0;
  double sum = 0;
  std::shared_ptr<const Frame> first, last;
  while (const auto frame = dataset->next()) {
    if (!first) first = frame;
    last = frame;
    samples += frame->imu.size();
    for (const gslam::ImuSample& sample : frame->imu) sum += sample.gyro[2];
  }
  EXPECT_EQ(samples, 3060U);  // of 3061: the last one comes after the last frame
  EXPECT_NEAR(sum, 240.10076128366347 - 0.03825877566845808, 1e-9);
  EXPECT_EQ(first->imu[0].stamp, 47580000000);
  EXPECT_EQ(first->imu[0].gyro,
            (gslam::Vec3d{0.006656444803353631, -0.00236638747633773, 0.04275138193045083}));
  EXPECT_EQ(first->imu[0].accel,
            (gslam::Vec3d{-0.5942556862503618, 0.15657528786590588, 9.703827518410009}));
  ASSERT_TRUE(first->has_prior);
  EXPECT_EQ(first->prior.pose().translation(),
            (gslam::Vec3d{0.1571574254425733, -0.00041900730771831583, 0}));
  EXPECT_NEAR(first->prior.covariance()(0, 0), 0.001, 1e-12);
  EXPECT_EQ(last->prior.pose().translation(),
            (gslam::Vec3d{-9.126526952729773, 21.713069580229085, 0}));
  EXPECT_NEAR(last->prior.pose().rotation().z(), -0.8560058512331321, 1e-12);
}

TEST(ros_dataset, without_images_and_poses_frames_follow_the_inertial_unit) {
  std::vector<Recorded> messages;
  for (int i = 0; i < 100; ++i) {
    messages.push_back({"/imu", "sensor_msgs/Imu", kStart + i * 10 * kMs,
                        imuBytes(kCoding, kStart + i * 10 * kMs, i)});
  }
  const std::string path = writeMcap("imu.mcap", messages);
  const auto dataset = open(path);
  EXPECT_EQ(dataset->info().frame_count, 10U);
  dataset->seek(1);
  EXPECT_EQ(dataset->next()->imu.size(), 10U);
  EXPECT_EQ(open(path, Svar::object({{"frame_every", 0.5}}))->info().frame_count, 2U);
  const std::string error = errorOf([&] { open(path, Svar::object({{"imu", "none"}})); });
  EXPECT_TRUE(has(error, "its topics are: /imu (sensor_msgs/msg/Imu, 100)")) << error;
}

TEST(ros_dataset, is_recognized_by_its_name) {
  const gslam::DatasetFactory factory = gslam::rosFactory();
  EXPECT_EQ(factory.name, "ros");
  EXPECT_TRUE(factory.recognizes(writeMcap("rig.mcap", rigMessages())));
  const std::string folder = folderOfTests() + "no_recording";
  ASSERT_EQ(std::system(("mkdir -p '" + folder + "'").c_str()), 0);
  EXPECT_FALSE(factory.recognizes(folder));
}

// --- parts ---------------------------------------------------------------------------------------

TEST(ros_topics, names_of_rectified_images_and_of_depth) {
  using gslam::ros::saysDepth;
  using gslam::ros::saysRectified;
  for (const char* name : {"/left/image_rect", "/left/image_rect_color/compressed",
                           "/image_rectified", "/camera/depth/image_rect_raw"}) {
    EXPECT_TRUE(saysRectified(name)) << name;
  }
  for (const char* name : {"/direct_cam/image_raw", "/rect/image_raw", "/left/image_direct",
                           "/rectangle", "/image_raw/compressed"}) {
    EXPECT_FALSE(saysRectified(name)) << name;
  }
  for (const char* name : {"/camera/depth/image_raw", "/depth_registered/image",
                           "/aligned_depth_to_color", "/cam/image/compressedDepth", "/Depth"}) {
    EXPECT_TRUE(saysDepth(name)) << name;
  }
  for (const char* name : {"/indepth_cam/image", "/depths/image", "/cam/image"}) {
    EXPECT_FALSE(saysDepth(name)) << name;
  }
}

TEST(ros_topics, names_of_cameras) {
  using gslam::ros::cameraNameOf;
  EXPECT_EQ(cameraNameOf("/cam0/image_raw"), "cam0");
  EXPECT_EQ(cameraNameOf("/camera/rgb/image_color/compressed"), "camera_rgb");
  EXPECT_EQ(cameraNameOf("/camera/depth/image_raw/compressedDepth"), "camera_depth");
  EXPECT_EQ(cameraNameOf("/image"), "image");
  EXPECT_EQ(cameraNameOf("/kitti/camera_gray_left"), "kitti_camera_gray_left");
  EXPECT_EQ(cameraNameOf("/"), "camera");
}

TEST(ros_groups, no_stamp_is_lost_or_twice) {
  using gslam::ros::groupImages;
  std::uint32_t seed = 5;
  for (int round = 0; round < 200; ++round) {
    std::vector<std::vector<std::int64_t>> stamps(3);
    for (std::size_t c = 0; c < 3; ++c) {
      std::int64_t stamp = 0;
      for (int i = 0; i < 12; ++i) {
        seed = seed * 1664525U + 1013904223U;
        stamp += 1 + (seed >> 28);
        stamps[c].push_back(stamp);
      }
    }
    const auto groups = groupImages(stamps, 4);
    std::vector<std::size_t> used(3);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      ASSERT_TRUE(g == 0 || groups[g - 1].stamp < groups[g].stamp);
      for (std::size_t c = 0; c < 3; ++c) {
        if (groups[g].images[c] == gslam::ros::kNoImage) continue;
        ASSERT_LE(std::abs(stamps[c][groups[g].images[c]] - groups[g].stamp), 4);
        ASSERT_EQ(groups[g].images[c], used[c]++);  // in order, none left out
      }
    }
    EXPECT_EQ(used, (std::vector<std::size_t>{12, 12, 12}));
  }
}

}  // namespace
