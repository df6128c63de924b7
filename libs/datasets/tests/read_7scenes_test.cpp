// Microsoft 7-Scenes: real data, its layout in small, and what goes wrong.
#include <gslam/datasets/formats.h>

#include "format_case.h"
#include "test_data.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)
using gslam::sevenScenesFactory;

const char* const kIdentity = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

std::string frameName(std::size_t i, const std::string& ending) {
  return "frame-" + padded(i, 6) + "." + ending;
}

void writeSequence(const std::string& folder) {
  for (std::size_t i = 0; i < 3; ++i) {
    writeImage(folder + "/" + frameName(i, "color.png"), numbered(16, 12, int(i), CV_8UC3));
    cv::Mat depth = numbered(16, 12, int(i), CV_16UC1);
    depth.at<std::uint16_t>(3, 5) = 65535;
    writeImage(folder + "/" + frameName(i, "depth.png"), depth);
    writeText(folder + "/" + frameName(i, "pose.txt"),
              "1 0 0 " + std::to_string(i) + "\n0 0 -1 0\n0 1 0 0\n0 0 0 1\n");
  }
}

std::string realKitchen() {
  return test_data::folder() + "sequences/7scenes_redkitchen";
}

TEST(read7Scenes, RealSequence) {
  NEEDS_TEST_DATA();
  EXPECT_EQ(gslam::datasetFormatOf(realKitchen()), "7scenes");
  const auto dataset = open(sevenScenesFactory(), realKitchen());
  const gslam::DatasetInfo& info = dataset->info();
  EXPECT_EQ(info.frame_count, 300U);
  ASSERT_EQ(info.sensors.cameras.size(), 2U);
  EXPECT_EQ(info.sensors.cameras[0].camera,
            gslam::Camera::fromParameters("pinhole", 640, 480, {585, 585, 320, 240}));
  EXPECT_EQ(info.sensors.cameras[1].depth_scale, 0.001);
  EXPECT_EQ(info.last_stamp, 9966666667);
  ASSERT_EQ(info.ground_truth.size(), 300U);
  const SE3d& first = info.ground_truth[0].pose;
  EXPECT_TRUE(first.translation() == (Vec3d{-0.34045634, 0.016469818, 0.29656917}));
  EXPECT_NEAR(first.rotation().matrix()(0, 2), -0.31422433, 1e-4);  // of frame-000000.pose.txt
  EXPECT_TRUE(says(info.remarks, "not registered"));
  EXPECT_TRUE(says(info.remarks, "no stamps"));
  dataset->seek(123);
  const auto frame = dataset->next();
  const cv::Mat colour = export_case::readImage(realKitchen() + "/frame-000123.color.jpg");
  EXPECT_TRUE(export_case::samePixels<std::uint8_t>(colour, frame->images[0].image, {0, 1, 2}));
  cv::Mat depth = export_case::readImage(realKitchen() + "/frame-000123.depth.png");
  depth.setTo(0, depth == 65535);  // this copy has none of them
  EXPECT_TRUE(export_case::samePixels<std::uint16_t>(depth, frame->images[1].image, {0}));
}

TEST(read7Scenes, DepthAndPosesFitTogether) {
  NEEDS_TEST_DATA();
  const auto dataset = open(sevenScenesFactory(), realKitchen());
  for (const std::size_t i : {0U, 120U, 260U}) {
    dataset->seek(i);
    const auto a = dataset->next();
    dataset->seek(i + 30);
    const auto b = dataset->next();
    const SE3d T_b_a = truthBetween(*dataset, *a, *b);
    const Warp right = warp(*a, *b, T_b_a), none = warp(*a, *b, SE3d());
    const Warp inverse = warp(*a, *b, T_b_a.inverse());
    EXPECT_GT(right.points, 1000) << i;
    EXPECT_LT(right.depth_error, 0.02) << i;
    EXPECT_LT(right.depth_error, 0.5 * none.depth_error) << i;
    EXPECT_LT(right.depth_error, 0.5 * inverse.depth_error) << i;
    EXPECT_LT(right.grey_error, none.grey_error) << i;
    EXPECT_LT(right.grey_error, inverse.grey_error) << i;
    RecordProperty("frame" + std::to_string(i), std::to_string(right.depth_error) + " none " +
                                                    std::to_string(none.depth_error) + " inverse " +
                                                    std::to_string(inverse.depth_error));
  }
}

TEST(read7Scenes, ReadsItsLayout) {
  const TempFolder folder;
  writeSequence(folder / "heads/seq-01");
  EXPECT_EQ(gslam::datasetFormatOf(folder / "heads"), "7scenes");
  const auto dataset = open(sevenScenesFactory(), folder / "heads");
  EXPECT_EQ(dataset->info().name, "heads/seq-01");
  EXPECT_TRUE(says(dataset->info().remarks, "585 585 320 240"));
  const auto frames = allFrames(*dataset);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[1]->stamp, 33333333);
  EXPECT_EQ(frames[2]->stamp, 66666667);
  EXPECT_EQ(frames[2]->images[1].image.at<std::uint16_t>(5, 3), 0);
  const cv::Mat depth = export_case::readImage(folder / "heads/seq-01/frame-000002.depth.png");
  EXPECT_EQ(frames[2]->images[1].image.at<std::uint16_t>(6, 3), depth.at<std::uint16_t>(3, 6));
  // The camera's z axis is the third column: it looks along -y of the world.
  const SE3d& pose = dataset->info().ground_truth[2].pose;
  EXPECT_LT((pose.rotation() * Vec3d{0, 0, 1} - Vec3d{0, -1, 0}).norm(), 1e-15);
  EXPECT_EQ(pose.translation()[0], 2);
  const auto mono = open(sevenScenesFactory(), folder / "heads", Svar::object({{"depth", false}}));
  EXPECT_EQ(mono->next()->images.size(), 1U);
}

TEST(read7Scenes, SequencesAreChosen) {
  const TempFolder folder;
  writeSequence(folder / "heads/seq-01");
  writeSequence(folder / "heads/seq-02");
  const std::string error = errorOf(sevenScenesFactory(), folder / "heads");
  EXPECT_TRUE(has(error, "seq-01, seq-02")) << error;
  for (const Svar& name : {Svar("seq-02"), Svar("02"), Svar(2)}) {
    const auto dataset =
        open(sevenScenesFactory(), folder / "heads", Svar::object({{"sequence", name}}));
    EXPECT_EQ(dataset->info().name, "heads/seq-02");
  }
}

TEST(read7Scenes, ArchiveReadsTheSame) {
  const TempFolder folder;
  writeSequence(folder / "seq-03");
  writeText(folder / "seq-03/camera-intrinsics.txt", "16 0 7\r\n0 17 6\r\n0 0 1\r\n");
  zipFolder(folder / "seq-03", folder / "seq-03.zip");
  EXPECT_EQ(gslam::datasetFormatOf(folder / "seq-03.zip"), "7scenes");
  const auto a = open(sevenScenesFactory(), folder / "seq-03");
  const auto b = open(sevenScenesFactory(), folder / "seq-03.zip");
  EXPECT_EQ(a->info().sensors.cameras[0].camera,
            gslam::Camera::fromParameters("pinhole", 16, 12, {16, 17, 7, 6}));
  expectSame(*a, *b);
}

TEST(read7Scenes, PosesThatAreWrong) {
  const TempFolder folder;
  writeSequence(folder.path());
  const std::string file = folder / "frame-000001.pose.txt";
  const auto remarksOf = [&]() {
    const auto dataset = open(sevenScenesFactory(), folder.path());
    EXPECT_EQ(dataset->info().frame_count, 3U);
    EXPECT_EQ(dataset->info().ground_truth.size(), 2U);
    return dataset->info().remarks;
  };
  writeText(file, "nan nan nan nan\nnan nan nan nan\nnan nan nan nan\n0 0 0 1\n");
  EXPECT_TRUE(says(remarksOf(), "frame-000001.pose.txt"));
  writeText(file, "-1.#IND 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  EXPECT_TRUE(says(remarksOf(), "not finite"));
  writeText(file, "0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 0\n");
  EXPECT_TRUE(says(remarksOf(), "no rotation"));
  fs::remove(file);
  EXPECT_TRUE(says(remarksOf(), "no pose.txt, of 1 frame"));
  writeText(file, "1 0 0 0\n0 1 0 0\n0 0 1 0\n");
  EXPECT_TRUE(has(errorOf(sevenScenesFactory(), folder.path()),
                  "frame-000001.pose.txt:3: the file has 12"));
  writeText(file, std::string(kIdentity) + "5\n");
  EXPECT_TRUE(has(errorOf(sevenScenesFactory(), folder.path()), "frame-000001.pose.txt:5:1"));
  writeText(file, "1 0 x 0\n");
  EXPECT_TRUE(has(errorOf(sevenScenesFactory(), folder.path()), "frame-000001.pose.txt:1:5"));
}

TEST(read7Scenes, ImagesThatAreMissingOrBroken) {
  const TempFolder folder;
  writeSequence(folder.path());
  fs::remove(folder / "frame-000001.depth.png");
  const auto dataset = open(sevenScenesFactory(), folder.path());
  EXPECT_EQ(dataset->info().frame_count, 2U);
  EXPECT_EQ(dataset->info().last_stamp, 66666667);
  EXPECT_TRUE(says(dataset->info().remarks, "frame-000001"));
  cutInHalf(folder / "frame-000002.color.png");
  const auto cut = open(sevenScenesFactory(), folder.path());
  ASSERT_NE(cut->next(), nullptr);
  EXPECT_THROW(cut->next(), gslam::FileError);
  fs::remove(folder / "frame-000000.depth.png");
  fs::remove(folder / "frame-000002.depth.png");
  EXPECT_TRUE(
      says(open(sevenScenesFactory(), folder.path(), Svar())->info().remarks, "no depth images"));
  writeText(folder / "camera-intrinsics.txt", "16 1 7 0 17 6 0 0 1");
  EXPECT_TRUE(has(errorOf(sevenScenesFactory(), folder.path()), "camera-intrinsics.txt:1"));
  writeText(folder / "camera-intrinsics.txt", "-585 0 7 0 17 6 0 0 1");
  EXPECT_TRUE(has(errorOf(sevenScenesFactory(), folder.path()), "camera-intrinsics.txt:1"));
  const TempFolder empty;
  EXPECT_TRUE(has(errorOf(sevenScenesFactory(), empty.path()), "has no sequence"));
}

}  // namespace
