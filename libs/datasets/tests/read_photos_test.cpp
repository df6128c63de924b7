// Real photos of a DJI drone, and images without any EXIF.
#include <gslam/core/geodesy.h>
#include <gslam/datasets/formats.h>

#include <fstream>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "reading_case.h"
#include "test_data.h"

namespace {

using reading_case::hasRemark;
using reading_case::openWith;
using reading_case::TempFolder;

std::string photosFolder() {
  return test_data::folder() + "sfm/dji_brighton_beach/";
}

// image,lat_deg,lon_deg,alt_m
std::map<std::string, std::vector<double>> table() {
  std::ifstream in(photosFolder() + "gps_from_exif.csv");
  std::map<std::string, std::vector<double>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string name, cell;
    std::getline(cells, name, ',');
    while (std::getline(cells, cell, ',')) rows[name].push_back(std::stod(cell));
  }
  return rows;
}

TEST(read_photos, positions_are_those_of_the_table) {
  NEEDS_TEST_DATA();
  EXPECT_EQ(gslam::datasetFormatOf(photosFolder()), "photos");
  const auto dataset = openWith(gslam::photosFactory(), photosFolder());
  const auto rows = table();
  ASSERT_EQ(dataset->info().frame_count, rows.size());
  EXPECT_TRUE(dataset->info().sensors.has_gnss);
  auto row = rows.begin();
  while (const auto frame = dataset->next()) {
    ASSERT_EQ(frame->gnss.size(), 1U);
    const gslam::Geodetic& place = frame->gnss[0].position;
    EXPECT_NEAR(gslam::degreesOfRadians(place.latitude), row->second[0], 1e-8);
    EXPECT_NEAR(gslam::degreesOfRadians(place.longitude), row->second[1], 1e-8);
    EXPECT_NEAR(place.altitude, row->second[2], 1e-3);
    EXPECT_TRUE(frame->has_prior);
    const cv::Mat expected =
        cv::imread(photosFolder() + "images/" + row->first, cv::IMREAD_UNCHANGED);
    EXPECT_TRUE(reading_case::isSame(frame->images.at(0).image, expected));
    ++row;
  }
  // The first was taken on June 23rd, 2016, at 16:31:59.
  EXPECT_EQ(dataset->info().first_stamp, 1466699519000000000);
}

cv::Mat greyOf(const gslam::Frame& frame) {
  const gslam::Image& image = frame.images.at(0).image;
  cv::Mat grey;
  cv::cvtColor(cv::Mat(image.height(), image.width(), CV_8UC3,
                       const_cast<std::uint8_t*>(image.bytes()), image.stride()),
               grey, cv::COLOR_BGR2GRAY);
  return grey;
}

// Where a pixel of one photo is in another, by the features that both have: the beach is flat.
cv::Point2d follow(const cv::Point2d& pixel, const gslam::Frame& from, const gslam::Frame& to) {
  const cv::Ptr<cv::SIFT> sift = cv::SIFT::create(4000);
  std::vector<cv::KeyPoint> points[2];
  cv::Mat descriptors[2];
  sift->detectAndCompute(greyOf(from), cv::noArray(), points[0], descriptors[0]);
  sift->detectAndCompute(greyOf(to), cv::noArray(), points[1], descriptors[1]);
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher().knnMatch(descriptors[0], descriptors[1], matches, 2);
  std::vector<cv::Point2f> a, b;
  for (const std::vector<cv::DMatch>& match : matches) {
    if (match[0].distance > 0.75F * match[1].distance) continue;
    a.push_back(points[0][std::size_t(match[0].queryIdx)].pt);
    b.push_back(points[1][std::size_t(match[0].trainIdx)].pt);
  }
  const cv::Mat homography = cv::findHomography(a, b, cv::RANSAC, 3);
  std::vector<cv::Point2d> result;
  if (!homography.empty()) {
    cv::perspectiveTransform(std::vector<cv::Point2d>{pixel}, result, homography);
  }
  return result.empty() ? cv::Point2d() : result[0];
}

// The middle of a photo, found in the next one, is where positions and gimbal say, within what a
// receiver without corrections and a guessed focal length can be.
TEST(read_photos, priors_say_how_the_image_moves) {
  NEEDS_TEST_DATA();
  const auto dataset = openWith(gslam::photosFactory(), photosFolder());
  const auto frames = reading_case::allFrames(*dataset);
  for (std::size_t i = 1; i < 4; ++i) {
    const gslam::Frame &first = *frames[i - 1], &second = *frames[i];
    const gslam::Camera& camera = first.images[0].camera;
    const cv::Point2d middle(camera.width() / 2.0, camera.height() / 2.0);
    const cv::Point2d seen = follow(middle, first, second);
    // The drone is 40 m above the place of take-off (XMP's RelativeAltitude).
    gslam::Vec3d ray;
    gslam::Vec2d predicted;
    ASSERT_TRUE(camera.unproject({{middle.x, middle.y}}, ray));
    const gslam::SE3d T_second_first = second.prior.pose().inverse() * first.prior.pose();
    ASSERT_TRUE(camera.project(T_second_first * (ray * (40 / ray[2])), predicted));
    EXPECT_GT(cv::norm(seen - middle), 150);
    EXPECT_LT(cv::norm(seen - cv::Point2d(predicted[0], predicted[1])), 45) << "photo " << i;
  }
}

TEST(read_photos, an_archive_reads_the_same) {
  NEEDS_TEST_DATA();
  const TempFolder folder;
  reading_case::zipFolder(photosFolder() + "images", folder / "photos.zip", "inside/");
  EXPECT_EQ(gslam::datasetFormatOf(folder / "photos.zip"), "photos");
  const auto packed = openWith(gslam::photosFactory(), folder / "photos.zip"),
             plain = openWith(gslam::photosFactory(), photosFolder());
  EXPECT_EQ(packed->info().frame_count, plain->info().frame_count);
  const auto a = packed->next(), b = plain->next();
  EXPECT_EQ(a->images[0].image, b->images[0].image);
  EXPECT_EQ(a->stamp, b->stamp);
  EXPECT_EQ(a->gnss[0].position.latitude, b->gnss[0].position.latitude);
}

TEST(read_photos, images_without_exif_are_one_a_second) {
  const TempFolder folder;
  for (const char* name : {"a.jpg", "b.jpg", "c.png"}) folder.writeImage(name, 1, CV_8UC3);
  folder.write("d.jpg", "no image");
  const auto dataset = openWith(gslam::photosFactory(), folder.path());
  EXPECT_EQ(dataset->info().frame_count, 3U);
  EXPECT_EQ(dataset->info().last_stamp, 2000000000);
  EXPECT_FALSE(dataset->info().sensors.has_gnss);
  EXPECT_TRUE(hasRemark(dataset->info(), "not every photo has a time"));
  EXPECT_TRUE(hasRemark(dataset->info(), "no photo has a position with an altitude"));
  EXPECT_TRUE(hasRemark(dataset->info(), "skipped 1 photos that cannot be read"));
  EXPECT_FALSE(dataset->info().sensors.cameras[0].camera.isValid());
}

TEST(read_photos, the_camera_can_be_given) {
  const TempFolder folder;
  folder.writeImage("a.jpg", 1);
  const auto open = [&](const std::string& camera) {
    return openWith(gslam::photosFactory(), folder.path(),
                    gslam::Svar::object({{"camera", camera}}));
  };
  EXPECT_EQ(open("pinhole 16x12 10 10 8 6")->info().sensors.cameras[0].camera.parameter("fx"), 10);
  EXPECT_THROW(open("pinhole 17x12 10 10 8 6"), gslam::FileError);
  EXPECT_THROW(open("pinhole"), gslam::ArgumentError);
}

TEST(read_photos, an_empty_folder_is_an_error) {
  const TempFolder folder;
  EXPECT_THROW(openWith(gslam::photosFactory(), folder.path()), gslam::FileError);
}

}  // namespace
