// Messages of both serializations, against bytes that the tests write themselves.
#include <gslam/geometry/camera.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "messages/camera.h"
#include "messages/decode.h"
#include "messages/image.h"
#include "recorded.h"

namespace {

using namespace gslam::ros;  // NOLINT(google-build-using-namespace): what is tested
using gslam::ImageKind;
using gslam::PixelType;

const Coding kCodings[] = {Coding::ros1, Coding::little_cdr, Coding::big_cdr};
const std::string kName = "test message";

WireKind kindOf(Coding coding) {
  return coding == Coding::ros1 ? WireKind::ros1 : WireKind::cdr;
}

template <class Message>
Message decoded(const RawBytes& bytes, Coding coding) {
  return decode<Message>(Bytes(bytes), kindOf(coding), kName);
}

constexpr std::int64_t kStamp = 1234567890123456789;

TEST(messages, imu) {
  for (const Coding coding : kCodings) {
    const RawBytes bytes = imuBytes(coding, kStamp, 0.25);
    const auto message = decoded<ImuMessage>(bytes, coding);
    EXPECT_EQ(message.header.stamp, kStamp);
    EXPECT_EQ(message.header.frame_id, "imu");
    EXPECT_EQ(message.orientation, (Quadruple{0, 0, 0, 1}));
    EXPECT_EQ(message.angular_velocity, (Triple{0.25, 1.25, 2.25}));
    EXPECT_EQ(message.linear_acceleration, (Triple{3.25, 4.25, 5.25}));
  }
}

// Bytes of the specification's rules by hand, so that the encoder is not alone in what it thinks.
TEST(messages, cdr_by_hand) {
  const RawBytes bytes = {0, 1, 0, 0,                       // little-endian CDR
                          2, 0, 0, 0,                       // seconds
                          3, 0, 0, 0,                       // nanoseconds
                          2, 0, 0, 0, 'a', 0,               // "a", with its zero
                          0, 0,                             // to a multiple of 8: 16
                          0, 0, 0, 0, 0,   0, 0xF0, 0x3F,   // 1
                          0, 0, 0, 0, 0,   0, 0,    0x40,   // 2
                          0, 0, 0, 0, 0,   0, 0x08, 0x40};  // 3
  const auto message = decoded<PointStamped>(bytes, Coding::little_cdr);
  EXPECT_EQ(message.header.stamp, 2000000003);
  EXPECT_EQ(message.header.frame_id, "a");
  EXPECT_EQ(message.point, (Triple{1, 2, 3}));
  // XCDR2 has doubles at multiples of 4: here 20, where 8 would want 24.
  RawBytes xcdr2 = {0, 7, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 5, 0, 0, 0, 'a', 'b', 'c', 'd', 0, 0, 0, 0};
  xcdr2.insert(xcdr2.end(), bytes.end() - 24, bytes.end());
  EXPECT_EQ(decoded<PointStamped>(xcdr2, Coding::little_cdr).point, (Triple{1, 2, 3}));
}

TEST(messages, other_representations_are_refused) {
  RawBytes bytes = imuBytes(Coding::little_cdr, kStamp, 0);
  bytes[1] = 3;  // a parameter list
  const std::string error = errorOf([&] { decoded<ImuMessage>(bytes, Coding::little_cdr); });
  EXPECT_TRUE(has(error, "expected plain CDR")) << error;
  EXPECT_TRUE(has(errorOf([] { decode<Header>(Bytes(), WireKind::unknown, kName); }),
                  "neither of ROS 1 nor CDR"));
}

TEST(messages, poses_transforms_and_odometry) {
  const std::vector<double> pose = {1, 2, 3, 0.5, -0.5, 0.5, 0.5};
  for (const Coding coding : kCodings) {
    const auto stamped = decoded<PoseStamped>(poseBytes(coding, kStamp, pose), coding);
    EXPECT_EQ(stamped.pose.position, (Triple{1, 2, 3}));
    EXPECT_EQ(stamped.pose.orientation, (Quadruple{0.5, -0.5, 0.5, 0.5}));
    const auto odometry = decoded<Odometry>(odometryBytes(coding, kStamp, pose, 0.25), coding);
    EXPECT_EQ(odometry.child_frame_id, "base");
    EXPECT_EQ(odometry.pose.position, (Triple{1, 2, 3}));
    EXPECT_EQ(odometry.covariance[0], 0.25);
    EXPECT_EQ(odometry.covariance[1], 0);
    EXPECT_EQ(odometry.covariance[35], 0.25);
    const auto tf = decoded<TfMessage>(transformBytes(coding, kStamp, "a", "bc", pose), coding);
    ASSERT_EQ(tf.transforms.size(), 1U);
    EXPECT_EQ(tf.transforms[0].header.frame_id, "a");
    EXPECT_EQ(tf.transforms[0].child_frame_id, "bc");
    EXPECT_EQ(tf.transforms[0].transform.orientation, (Quadruple{0.5, -0.5, 0.5, 0.5}));
  }
}

TEST(messages, satellite_fixes_and_calibrations) {
  InfoFields fields;
  fields.d = {0.1, -0.2, 0.01, 0.02, 0.3};
  for (const Coding coding : kCodings) {
    const auto fix = decoded<NavSatFix>(fixBytes(coding, kStamp, -1, {48.5, 11.25, 500}), coding);
    EXPECT_EQ(fix.status, -1);
    EXPECT_EQ(fix.latitude, 48.5);
    EXPECT_EQ(fix.longitude, 11.25);
    EXPECT_EQ(fix.altitude, 500);
    EXPECT_EQ(fix.covariance[4], 5);
    EXPECT_EQ(fix.covariance_type, 2);
    const auto info = decoded<CameraInfo>(infoBytes(coding, kStamp, "cam", fields), coding);
    EXPECT_EQ(info.width, 4U);
    EXPECT_EQ(info.distortion_model, "plumb_bob");
    EXPECT_EQ(info.d, fields.d);
    EXPECT_EQ(info.k[4], 110);
    EXPECT_EQ(info.r[8], 1);
  }
}

TEST(messages, every_prefix_ends_early) {
  for (const Coding coding : kCodings) {
    const RawBytes tf = transformBytes(coding, kStamp, "a", "b", {1, 2, 3, 0, 0, 0, 1});
    const RawBytes info = infoBytes(coding, kStamp, "a", InfoFields());
    for (std::size_t size = 0; size < tf.size(); ++size) {
      const RawBytes cut(tf.begin(), tf.begin() + std::ptrdiff_t(size));
      EXPECT_THROW(decoded<TfMessage>(cut, coding), gslam::ParseError) << size;
    }
    for (std::size_t size = 0; size < info.size(); ++size) {
      const RawBytes cut(info.begin(), info.begin() + std::ptrdiff_t(size));
      EXPECT_THROW(decoded<CameraInfo>(cut, coding), gslam::ParseError) << size;
    }
  }
}

TEST(messages, a_count_beyond_the_message_takes_no_memory) {
  const RawBytes bytes = {0, 1, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 1, 2};
  const std::string error = errorOf([&] { decoded<TfMessage>(bytes, Coding::little_cdr); });
  EXPECT_EQ(error,
            "test message, byte 8: a list should have 4294967295 elements, but there are 2 "
            "bytes left");
}

// --- images --------------------------------------------------------------------------------------

struct EncodingCase {
  const char* encoding;
  int bytes;  // of a pixel
  PixelType type;
  int channels;
  ImageKind kind;
};

const EncodingCase kImages[] = {{"mono8", 1, PixelType::u8, 1, ImageKind::grey},
                                {"mono16", 2, PixelType::u16, 1, ImageKind::grey},
                                {"8UC1", 1, PixelType::u8, 1, ImageKind::grey},
                                {"16UC1", 2, PixelType::u16, 1, ImageKind::depth},
                                {"32FC1", 4, PixelType::f32, 1, ImageKind::depth},
                                {"rgb8", 3, PixelType::u8, 3, ImageKind::rgb},
                                {"bgr8", 3, PixelType::u8, 3, ImageKind::bgr},
                                {"rgba8", 4, PixelType::u8, 4, ImageKind::rgba},
                                {"bgra8", 4, PixelType::u8, 4, ImageKind::bgra},
                                {"bayer_rggb8", 1, PixelType::u8, 1, ImageKind::bayer},
                                {"bayer_grbg16", 2, PixelType::u16, 1, ImageKind::bayer}};

TEST(images, every_encoding_step_and_byte_order_gives_the_pixels) {
  constexpr int kWidth = 5, kHeight = 4;
  for (const EncodingCase& one : kImages) {
    for (const int gap : {0, 3}) {
      for (const bool is_big : {false, true}) {
        SCOPED_TRACE(std::string(one.encoding) + (is_big ? " big" : " little"));
        const int step = kWidth * one.bytes + gap;
        const RawBytes data = noise(std::size_t(step * kHeight), 3);
        const Coding coding = is_big ? Coding::big_cdr : Coding::ros1;
        const RawBytes bytes =
            imageBytes(coding, kStamp, "cam", kWidth, kHeight, one.encoding, step, is_big, data);
        const DecodedImage image = decodeRaw(decoded<ImageMessage>(bytes, coding), false, kName);
        ASSERT_EQ(image.image.type(), one.type);
        ASSERT_EQ(image.image.channels(), one.channels);
        EXPECT_EQ(image.kind, one.kind);
        const std::size_t unit = gslam::pixelTypeSize(one.type);
        for (int y = 0; y < kHeight; ++y) {
          for (int i = 0; i < kWidth * one.bytes; ++i) {
            const std::size_t at = std::size_t(i), in_unit = at % unit;
            const std::size_t from = at - in_unit + (is_big ? unit - 1 - in_unit : in_unit);
            ASSERT_EQ(image.image.bytes(y)[i], data[std::size_t(y * step) + from]) << y << " " << i;
          }
        }
      }
    }
  }
}

ImageMessage smallImage(const RawBytes& data) {
  ImageMessage message;
  message.width = 4;
  message.height = 2;
  message.step = 4;
  message.encoding = "mono8";
  message.data = Bytes(data);
  return message;
}

TEST(images, sizes_that_do_not_fit_are_refused) {
  const RawBytes data(8);
  ImageMessage message = smallImage(data);
  EXPECT_EQ(decodeRaw(message, false, kName).image.height(), 2);
  const auto error = [&] { return errorOf([&] { decodeRaw(message, false, kName); }); };
  message.step = 3;
  EXPECT_TRUE(has(error(), "a step of 3")) << error();
  message.step = 5;
  EXPECT_TRUE(has(error(), "8 bytes")) << error();
  message = smallImage(data);
  message.height = 0xFFFFFFFF;
  EXPECT_TRUE(has(error(), "4 x 4294967295 pixels")) << error();
  message.height = 0;
  EXPECT_TRUE(has(error(), "4 x 0 pixels")) << error();
  message = smallImage(data);
  message.step = 0xFFFFFFFF;
  EXPECT_NE(error(), "");
  message = smallImage(data);
  message.encoding = "yuv422";
  EXPECT_TRUE(has(error(), "the encoding of the image is 'yuv422'")) << error();
}

TEST(images, grey_images_of_16_bits_are_depth_where_the_topic_says_so) {
  const RawBytes data(16);
  ImageMessage message = smallImage(data);
  message.encoding = "mono16";
  message.step = 8;
  EXPECT_EQ(decodeRaw(message, false, kName).kind, ImageKind::grey);
  const DecodedImage depth = decodeRaw(message, true, kName);
  EXPECT_EQ(depth.kind, ImageKind::depth);
  EXPECT_EQ(depth.depth_scale, 0.001);
  message.encoding = "32FC1";
  message.width = 2;
  EXPECT_EQ(decodeRaw(message, false, kName).depth_scale, 1);
}

RawBytes encoded(const char* ending, const cv::Mat& pixels) {
  RawBytes bytes;
  EXPECT_TRUE(cv::imencode(ending, pixels, bytes));
  return bytes;
}

DecodedImage decodeAs(const std::string& format, const RawBytes& data, bool is_depth = false) {
  CompressedImageMessage message;
  message.format = format;
  message.data = Bytes(data);
  return decodeCompressed(message, is_depth, kName);
}

bool isEqual(const gslam::Image& image, const cv::Mat& pixels) {
  const cv::Mat ours(image.height(), image.width(), pixels.type(),
                     const_cast<std::uint8_t*>(image.bytes()), image.stride());
  return image.width() == pixels.cols && image.height() == pixels.rows &&
         cv::norm(ours, pixels, cv::NORM_INF) == 0;
}

TEST(images, compressed_ones_are_as_opencv_decodes_them) {
  cv::Mat colour(20, 30, CV_8UC3), depth(20, 30, CV_16UC1);
  cv::randu(colour, 0, 256);
  cv::randu(depth, 0, 65536);
  const RawBytes png = encoded(".png", colour), jpeg = encoded(".jpg", colour);
  EXPECT_TRUE(isEqual(decodeAs("bgr8; png compressed ", png).image, colour));
  EXPECT_EQ(decodeAs("png", png).kind, ImageKind::bgr);
  EXPECT_TRUE(isEqual(decodeAs("rgb8; jpeg compressed bgr8", jpeg).image,
                      cv::imdecode(jpeg, cv::IMREAD_COLOR)));
  const DecodedImage decoded_depth = decodeAs("16UC1; png compressed ", encoded(".png", depth));
  EXPECT_TRUE(isEqual(decoded_depth.image, depth));
  EXPECT_EQ(decoded_depth.kind, ImageKind::depth);
}

TEST(images, compressed_ones_are_jpeg_or_png_and_as_large_as_expected) {
  cv::Mat colour(20, 30, CV_8UC3);
  cv::randu(colour, 0, 256);
  for (const char* ending : {".bmp", ".tiff"}) {
    const std::string error = errorOf([&] { decodeAs("32FC1; tiff", encoded(ending, colour)); });
    EXPECT_TRUE(has(error, "the image of format '32FC1; tiff' is neither JPEG nor PNG")) << error;
  }
  const gslam::reading::ImageShape same = {30, 20, PixelType::u8, 3};
  const gslam::reading::ImageShape other = {20, 30, PixelType::u8, 3};
  for (const char* ending : {".png", ".jpg"}) {
    const RawBytes data = encoded(ending, colour);
    CompressedImageMessage message;
    message.data = Bytes(data);
    EXPECT_EQ(decodeCompressed(message, false, kName, &same).image.width(), 30);
    EXPECT_TRUE(has(errorOf([&] { decodeCompressed(message, false, kName, &other); }),
                    "is 30 x 20, but the camera's first image is 20 x 30"));
  }
}

RawBytes withHead(float a, float b, const RawBytes& png) {
  RawBytes bytes(12 + png.size());
  std::memcpy(bytes.data() + 4, &a, 4);
  std::memcpy(bytes.data() + 8, &b, 4);
  std::copy(png.begin(), png.end(), bytes.begin() + 12);
  return bytes;
}

TEST(images, compressed_depth_of_16_bits_and_of_floats) {
  cv::Mat stored(6, 7, CV_16UC1);
  cv::randu(stored, 1000, 60000);
  stored.at<std::uint16_t>(2, 3) = 0;
  const RawBytes png = encoded(".png", stored);
  const DecodedImage millimetres = decodeAs("16UC1; compressedDepth", withHead(0, 0, png));
  EXPECT_TRUE(isEqual(millimetres.image, stored));
  EXPECT_EQ(millimetres.kind, ImageKind::depth);
  EXPECT_EQ(millimetres.depth_scale, 0.001);
  // depth = a / (stored - b), by compressed_depth_image_transport/src/codec.cpp.
  const DecodedImage metres = decodeAs("32FC1; compressedDepth png", withHead(20000, -10, png));
  ASSERT_EQ(metres.image.type(), PixelType::f32);
  EXPECT_EQ(metres.depth_scale, 1);
  EXPECT_TRUE(std::isnan(metres.image.at<float>(3, 2)));
  CompressedImageMessage again;
  again.format = "32FC1; compressedDepth png";
  const RawBytes data = withHead(20000, -10, png);
  again.data = Bytes(data);
  const gslam::reading::ImageShape shape = gslam::reading::shapeOf(metres.image);
  EXPECT_EQ(decodeCompressed(again, true, kName, &shape).image.type(), PixelType::f32);
  const double wanted = 20000.0 / (stored.at<std::uint16_t>(1, 1) + 10.0);
  EXPECT_NEAR(metres.image.at<float>(1, 1), wanted, 1e-5);
  EXPECT_TRUE(
      has(errorOf([&] { decodeAs("16UC1; compressedDepth rvl", withHead(0, 0, png)); }), "RVL"));
  EXPECT_TRUE(has(errorOf([&] { decodeAs("16UC1; compressedDepth", {1, 2}); }), "12 bytes"));
  EXPECT_NE(errorOf([&] { decodeAs("16UC1; compressedDepth", withHead(0, 0, {})); }), "");
  EXPECT_NE(errorOf([&] { decodeAs("jpeg", {}); }), "");
  EXPECT_NE(errorOf([&] { decodeAs("jpeg", {0xFF, 0xD8, 0xFF}); }), "");
}

// --- cameras -------------------------------------------------------------------------------------

CameraInfo infoOf(const InfoFields& fields) {
  const RawBytes bytes = infoBytes(Coding::ros1, kStamp, "cam", fields);
  return decoded<CameraInfo>(bytes, Coding::ros1);
}

TEST(cameras, every_model_of_ros) {
  InfoFields fields;
  fields.width = 640;
  fields.height = 480;
  fields.k = {500, 0, 320, 0, 510, 240, 0, 0, 1};
  EXPECT_EQ(cameraOf(infoOf(fields), false, kName).modelName(), "pinhole");
  fields.d = {0.1, -0.2, 0.001, 0.002, 0};
  const gslam::Camera four = cameraOf(infoOf(fields), false, kName);
  EXPECT_EQ(four, gslam::Camera::fromParameters("radtan", 640, 480,
                                                {500, 510, 320, 240, 0.1, -0.2, 0.001, 0.002}));
  fields.d[4] = 0.3;
  EXPECT_EQ(cameraOf(infoOf(fields), false, kName).parameterCount(), 9U);
  fields.model = "rational_polynomial";
  fields.d = {0.1, 0.2, 0.001, 0.002, 0.03, 0.4, 0.5, 0.06};
  EXPECT_EQ(cameraOf(infoOf(fields), false, kName).parameterCount(), 12U);
  fields.model = "equidistant";
  fields.d = {0.01, 0.02, 0.003, 0.0004};
  EXPECT_EQ(cameraOf(infoOf(fields), false, kName),
            gslam::Camera::fromParameters("kannala_brandt", 640, 480,
                                          {500, 510, 320, 240, 0.01, 0.02, 0.003, 0.0004}));
}

TEST(cameras, zero_k_is_no_calibration_and_nonsense_is_an_error) {
  InfoFields fields;
  fields.k = std::vector<double>(9, 0);
  EXPECT_FALSE(cameraOf(infoOf(fields), false, kName).isValid());
  fields.k = {-1, 0, 1, 0, 1, 1, 0, 0, 1};
  EXPECT_TRUE(has(errorOf([&] { cameraOf(infoOf(fields), false, kName); }), "makes no camera"));
  fields.k = {100, 0, 1, 0, 100, 1, 0, 0, 1};
  fields.width = 0;
  EXPECT_TRUE(has(errorOf([&] { cameraOf(infoOf(fields), false, kName); }), "0 x 3 pixels"));
  fields.width = 4;
  fields.model = "scaramuzza";
  fields.d = {1};
  EXPECT_TRUE(has(errorOf([&] { cameraOf(infoOf(fields), false, kName); }), "'scaramuzza'"));
  fields.model = "equidistant";
  fields.d = {1, 2, 3, 4, 5};
  EXPECT_TRUE(has(errorOf([&] { cameraOf(infoOf(fields), false, kName); }), "too many"));
}

TEST(cameras, rectified_images_have_p_and_parts_of_images_their_part) {
  InfoFields fields;
  fields.width = 640;
  fields.height = 480;
  fields.k = {500, 0, 320, 0, 510, 240, 0, 0, 1};
  fields.d = {0.1, 0, 0, 0, 0};
  fields.p = {450, 0, 310, -45, 0, 451, 230, 0, 0, 0, 1, 0};
  EXPECT_EQ(cameraOf(infoOf(fields), true, kName),
            gslam::Camera::fromParameters("pinhole", 640, 480, {450, 451, 310, 230}));
  CameraInfo info = infoOf(fields);
  info.d.clear();
  info.roi_x = 100;
  info.roi_y = 50;
  info.roi_width = 200;
  info.roi_height = 100;
  info.binning_x = info.binning_y = 2;
  const gslam::Camera part = cameraOf(info, false, kName);
  EXPECT_EQ(part.width(), 100);
  EXPECT_EQ(part.height(), 50);
  EXPECT_EQ(part.parameter("fx"), 250);
  EXPECT_EQ(part.parameter("cx"), (320 - 100 + 0.5) / 2 - 0.5);
  // Pixels that fill no binned one are left out, and change no focal length.
  info.roi_width = 203;
  info.roi_height = 101;
  info.binning_x = 4;
  info.binning_y = 2;
  const gslam::Camera odd = cameraOf(info, false, kName);
  EXPECT_EQ(odd.width(), 50);
  EXPECT_EQ(odd.height(), 50);
  EXPECT_EQ(odd.parameter("fx"), 125);
  EXPECT_EQ(odd.parameter("fy"), 255);
  EXPECT_EQ(odd.parameter("cx"), (320 - 100 + 0.5) / 4 - 0.5);
  info.roi_height = 0;
  EXPECT_TRUE(has(errorOf([&] { cameraOf(info, false, kName); }), "has 203 x 0 pixels"));
}

TEST(cameras, the_fourth_column_of_p_is_a_place) {
  InfoFields fields;
  fields.p = {400, 0, 310, -48, 0, 500, 230, 50, 0, 0, 1, 0};
  EXPECT_EQ(offsetOf(infoOf(fields)), (gslam::Vec3d{0.12, -0.1, 0}));
  fields.p[3] = std::nan("");
  EXPECT_EQ(offsetOf(infoOf(fields)), (gslam::Vec3d{0, 0, 0}));
  EXPECT_EQ(offsetOf(infoOf(InfoFields())), (gslam::Vec3d{0, 0, 0}));
}

}  // namespace
