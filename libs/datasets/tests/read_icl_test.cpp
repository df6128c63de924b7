// ICL-NUIM: both of its layouts, written here or exported, and what goes wrong.
#include <gslam/datasets/export_dataset.h>
#include <gslam/datasets/formats.h>
#include <gslam/datasets/synthetic.h>

#include <sstream>

#include "format_case.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)
using gslam::iclFactory;

gslam::SyntheticOptions roomOptions() {
  gslam::SyntheticOptions options;
  options.width = 160;
  options.height = 120;
  options.frames = 20;
  options.rate = 5;
  options.lens = {120.3, 120, 79.5, 59.5};  // the camera of ICL-NUIM at a quarter of its size
  options.colour = true;
  options.noise = 0;
  options.blur = false;
  return options;
}

// A folder that exportDataset() wrote, and what it was made of.
struct ExportedIcl {
  ExportedIcl() : source(gslam::openSynthetic(roomOptions())) {
    gslam::exportDataset(*source, folder / "icl", "icl");
  }
  std::string path() const { return folder / "icl"; }
  TempFolder folder;
  std::unique_ptr<Dataset> source;
};

// S T S, S = diag(1, -1, 1), by matrices.
SE3d mirrored(const SE3d& pose) {
  SE3d::Matrix m = pose.matrix();
  for (std::size_t i = 0; i < 4; ++i) {
    m(1, i) = -m(1, i);
    m(i, 1) = -m(i, 1);
  }
  return SE3d::fromMatrix(m);
}

void expectWarpsRight(Dataset& dataset, std::size_t i, std::size_t j) {
  dataset.seek(i);
  const auto a = dataset.next();
  dataset.seek(j);
  const auto b = dataset.next();
  const SE3d T_b_a = truthBetween(dataset, *a, *b);
  const Warp right = warp(*a, *b, T_b_a, 2), none = warp(*a, *b, SE3d(), 2);
  const Warp upside_down = warp(*a, *b, mirrored(T_b_a), 2);
  EXPECT_GT(right.points, 1000);
  EXPECT_LT(right.depth_error, 0.005);
  EXPECT_GT(none.depth_error, 4 * right.depth_error);
  EXPECT_GT(upside_down.depth_error, 1.5 * right.depth_error);
  EXPECT_LT(right.grey_error, 0.5 * none.grey_error);
  EXPECT_LT(right.grey_error, 0.5 * upside_down.grey_error);
}

TEST(readIcl, ReadsWhatIsExported) {
  const ExportedIcl icl;
  EXPECT_EQ(gslam::datasetFormatOf(icl.path()), "icl");
  const auto read = open(iclFactory(), icl.path());
  const gslam::DatasetInfo& info = read->info();
  const auto frames = allFrames(*read);
  ASSERT_EQ(frames.size(), 20U);
  ASSERT_EQ(info.ground_truth.size(), 20U);
  EXPECT_TRUE(says(info.remarks, "mirrored"));
  const SE3d T_body_camera = icl.source->info().sensors.cameras[0].T_body_camera;
  SE3d T_source_read;  // from the mirrored world to that of the source
  for (std::size_t i = 0; i < 20; ++i) {
    icl.source->seek(i);
    const auto original = icl.source->next();
    EXPECT_EQ(frames[i]->stamp, std::llround(double(i) * 1e9 / 30));
    EXPECT_EQ(frames[i]->stamp, info.ground_truth[i].stamp);
    EXPECT_EQ(frames[i]->images[0].camera, original->images[0].camera);
    SE3d pose;
    ASSERT_TRUE(icl.source->info().ground_truth.interpolate(original->stamp, pose));
    const SE3d T_world_camera = pose * T_body_camera;
    if (i == 0) T_source_read = T_world_camera * info.ground_truth[0].pose.inverse();
    EXPECT_TRUE((T_source_read * info.ground_truth[i].pose).isApprox(T_world_camera, 1e-9));
    EXPECT_NEAR(depthAt(frames[i]->images[1], 80, 60), depthAt(original->images[1], 80, 60), 1e-3);
  }
}

TEST(readIcl, DepthAndPosesFitTogether) {
  const ExportedIcl icl;
  const auto read = open(iclFactory(), icl.path());
  expectWarpsRight(*read, 0, 1);
  expectWarpsRight(*read, 10, 11);
}

TEST(readIcl, ArchiveReadsTheSame) {
  const ExportedIcl icl;
  zipFolder(icl.path(), icl.folder / "icl.zip", "living_room_traj0_frei_png/");
  EXPECT_EQ(gslam::datasetFormatOf(icl.folder / "icl.zip"), "icl");
  const auto a = open(iclFactory(), icl.path()), b = open(iclFactory(), icl.folder / "icl.zip");
  expectSame(*a, *b);
}

// rgb/i.png, depth/i.png of 16 x 12; poses begin with frame 1, as livingRoom0.gt.freiburg does.
void writeTumStyle(const TempFolder& folder) {
  std::string associations, truth;
  for (int i = 0; i < 12; ++i) {
    const std::string name = std::to_string(i) + ".png", number = std::to_string(i);
    writeImage(folder / ("rgb/" + name), numbered(16, 12, i, CV_8UC3));
    writeImage(folder / ("depth/" + name), numbered(16, 12, i, CV_16UC1));
    associations += number + " depth/" + name + " " + number + " rgb/" + name + "\n";
    if (i > 0) truth += number + " 0 " + number + " 2 0.1 0.2 0.3 0.9273618495495704\n";
  }
  writeText(folder / "associations.txt", associations);
  writeText(folder / "livingRoom0.gt.freiburg", truth);
}

TEST(readIcl, PublishedLayout) {
  const TempFolder folder;
  writeTumStyle(folder);
  const auto dataset = open(iclFactory(), folder.path());
  const gslam::DatasetInfo& info = dataset->info();
  EXPECT_EQ(info.sensors.cameras[0].camera,
            gslam::Camera::fromParameters("pinhole", 640, 480, {481.2, 480, 319.5, 239.5})
                .resized(16, 12));
  ASSERT_EQ(info.ground_truth.size(), 11U);
  EXPECT_EQ(info.ground_truth[0].stamp, 33333333);
  const SE3d in_file(SO3d::fromQuaternion(0.1, 0.2, 0.3, 0.9273618495495704), {{0, 1, 2}});
  EXPECT_TRUE(info.ground_truth[0].pose.isApprox(mirrored(in_file), 1e-12));
  EXPECT_TRUE(says(info.remarks, "1 of 12 frames are not in the time"));
  const auto frames = allFrames(*dataset);
  ASSERT_EQ(frames.size(), 12U);
  const cv::Mat tenth = export_case::readImage(folder / "rgb/10.png");  // not by name, but number
  EXPECT_TRUE(export_case::samePixels<std::uint8_t>(tenth, frames[10]->images[0].image, {0, 1, 2}));
  EXPECT_EQ(frames[10]->stamp, 333333333);

  const auto kept = open(iclFactory(), folder.path(), Svar::object({{"mirror", false}}));
  EXPECT_TRUE(kept->info().ground_truth[0].pose.isApprox(in_file, 1e-12));
  writeText(folder / "calibration.txt", "12 12 7.5 5.5\n");
  const auto positive = open(iclFactory(), folder.path());
  EXPECT_TRUE(positive->info().ground_truth[0].pose.isApprox(in_file, 1e-12));
  const auto mono = open(iclFactory(), folder.path(), Svar::object({{"depth", false}}));
  EXPECT_EQ(mono->next()->images.size(), 1U);
}

TEST(readIcl, AssociationsTheOtherWayRoundInSeconds) {
  const TempFolder folder;
  writeTumStyle(folder);
  writeText(folder / "associations.txt",
            "7.25 rgb/1.png 7.26 depth/1.png\r\n8 rgb/3.png 8.01 depth/3.png\r\n");
  writeText(folder / "livingRoom0.gt.freiburg", "7.25 0 0 0 0 0 0 1\n");
  const auto dataset = open(iclFactory(), folder.path());
  EXPECT_EQ(dataset->info().first_stamp, 7250000000);
  EXPECT_EQ(dataset->info().last_stamp, 8000000000);
  EXPECT_EQ(dataset->next()->images[1].kind, ImageKind::depth);
}

TEST(readIcl, FilesThatAreWrong) {
  const TempFolder folder;
  writeTumStyle(folder);
  const auto error = [&]() { return errorOf(iclFactory(), folder.path()); };
  fs::remove(folder / "depth/3.png");
  const auto gap = open(iclFactory(), folder.path());
  EXPECT_EQ(gap->info().frame_count, 11U);
  EXPECT_TRUE(says(gap->info().remarks, "depth/3.png"));
  cutInHalf(folder / "rgb/1.png");
  const auto cut = open(iclFactory(), folder.path());
  ASSERT_NE(cut->next(), nullptr);
  EXPECT_THROW(cut->next(), gslam::FileError);
  writeText(folder / "calibration.txt", "12 0 7.5 5.5\n");
  EXPECT_TRUE(has(error(), "calibration.txt:1"));
  fs::remove(folder / "calibration.txt");
  writeText(folder / "livingRoom0.gt.freiburg", "1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  EXPECT_TRUE(has(error(), "livingRoom0.gt.freiburg:2"));
  writeText(folder / "livingRoom0.gt.freiburg", "1 0 0 0 0 0 inf 1\n");
  EXPECT_TRUE(has(error(), "livingRoom0.gt.freiburg:1:13"));
  writeText(folder / "livingRoom0.gt.freiburg", "1 0 0 0 0 0 0 1\n# x\n 1.5 0 0 0 0 0 0 1\n");
  EXPECT_TRUE(has(error(), "livingRoom0.gt.freiburg:3:2") && has(error(), "no number of a frame"))
      << error();
  fs::remove(folder / "livingRoom0.gt.freiburg");
  EXPECT_TRUE(says(open(iclFactory(), folder.path())->info().remarks, "no ground truth"));
  writeText(folder / "associations.txt", "0 depth/0.png 0\n");
  EXPECT_TRUE(has(error(), "associations.txt:1"));
  writeText(folder / "associations.txt", "0 depth/0.png 0 rgb/0.png 5\n");
  EXPECT_TRUE(has(error(), "associations.txt:1:27"));
  writeText(folder / "associations.txt", "\n");
  EXPECT_TRUE(has(error(), "associations.txt"));
  const TempFolder empty;
  EXPECT_TRUE(has(errorOf(iclFactory(), empty.path()), "neither associations.txt"));
}

std::string povLine(const std::string& name, const Vec3d& v, double scale = 1) {
  std::ostringstream line;
  line.precision(12);
  line << name << " = [" << v[0] * scale << ", " << v[1] * scale << ", " << v[2] * scale << "]';\n";
  return line.str();
}

// The original layout of what a computed world shows: images as they are, distances along rays, a
// camera in POV-Ray's world, whose y is that of ours turned round.
// @param unit  metres that 1 stands for
std::unique_ptr<Dataset> writeOriginal(const std::string& folder, const std::string& begin,
                                       std::size_t digits, double unit) {
  auto source = gslam::openSynthetic(roomOptions());
  const gslam::Camera camera = source->info().sensors.cameras[0].camera;
  const std::vector<double> k = camera.parameters();
  const SE3d T_body_camera = source->info().sensors.cameras[0].T_body_camera;
  for (std::size_t i = 9; i < 12; ++i) {
    source->seek(i);
    const auto frame = source->next();
    const std::string base = folder + "/" + begin + padded(i, digits);
    cv::Mat image(120, 160, CV_8UC3);
    std::ostringstream depth;
    depth.precision(9);
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        for (int c = 0; c < 3; ++c) {
          image.ptr<std::uint8_t>(y)[3 * x + 2 - c] =
              frame->images[0].image.at<std::uint8_t>(x, y, c);
        }
        const double z = depthAt(frame->images[1], x, y);
        const double ray = Vec3d{(x - k[2]) / k[0], (y - k[3]) / k[1], 1}.norm();
        depth << (x == 5 && y == 7 ? 1e7 : z * ray / unit) << (x == 159 ? "\n" : " ");
      }
    }
    writeImage(base + ".png", image);
    writeText(base + ".depth", depth.str());
    SE3d pose;
    EXPECT_TRUE(source->info().ground_truth.interpolate(frame->stamp, pose));
    const SE3d pov = mirrored(pose * T_body_camera);
    const auto axis = [&](std::size_t j) { return pov.rotation().matrix().col(j); };
    writeText(base + ".txt", povLine("cam_pos     ", pov.translation(), 1 / unit) +
                                 povLine("cam_dir     ", axis(2)) +
                                 povLine("cam_up      ", axis(1)) + "cam_lookat   = [0, 0, 1]';\n" +
                                 povLine("cam_right   ", axis(0), 160 / k[0]) +
                                 "cam_angle    = 90;\n");
  }
  return source;
}

TEST(readIcl, OriginalLayout) {
  const TempFolder folder;
  for (const bool is_office : {false, true}) {
    const std::string path = folder / (is_office ? "office" : "living");
    const auto source = writeOriginal(path, is_office ? "scene_" : "scene_00_", is_office ? 3 : 4,
                                      is_office ? 0.01 : 1);
    EXPECT_EQ(gslam::datasetFormatOf(path), "icl");
    const auto dataset = open(iclFactory(), path);
    const gslam::DatasetInfo& info = dataset->info();
    ASSERT_EQ(info.frame_count, 3U);
    EXPECT_EQ(info.first_stamp, 300000000);
    ASSERT_EQ(info.ground_truth.size(), 3U);
    const gslam::Camera& camera = info.sensors.cameras[0].camera;
    const gslam::Camera& expected = source->info().sensors.cameras[0].camera;
    EXPECT_NEAR(camera.parameter("fx"), expected.parameter("fx"), 1e-6);
    EXPECT_EQ(camera.parameter("cx"), 79.5);
    SE3d first, last;
    source->seek(9);
    ASSERT_TRUE(source->info().ground_truth.interpolate(source->next()->stamp, first));
    source->seek(11);
    const auto original = source->next();
    ASSERT_TRUE(source->info().ground_truth.interpolate(original->stamp, last));
    const SE3d T_body_camera = source->info().sensors.cameras[0].T_body_camera;
    const SE3d moved = info.ground_truth[0].pose.inverse() * info.ground_truth[2].pose;
    EXPECT_TRUE(moved.isApprox((first * T_body_camera).inverse() * last * T_body_camera, 1e-8));
    dataset->seek(2);
    const auto frame = dataset->next();
    EXPECT_EQ(frame->images[1].image.type(), PixelType::f32);
    EXPECT_EQ(depthAt(frame->images[1], 5, 7), 0);
    for (const int x : {0, 80, 159}) {
      EXPECT_NEAR(depthAt(frame->images[1], x, 100), depthAt(original->images[1], x, 100), 1e-5);
    }
  }
}

TEST(readIcl, OriginalDepthAndPosesFitTogether) {
  const TempFolder folder;
  writeOriginal(folder / "living", "scene_00_", 4, 1);
  const auto dataset = open(iclFactory(), folder / "living");
  expectWarpsRight(*dataset, 0, 1);
  expectWarpsRight(*dataset, 2, 1);
}

TEST(readIcl, OriginalFilesThatAreWrong) {
  const TempFolder folder;
  writeOriginal(folder.path(), "scene_00_", 4, 1);
  zipFolder(folder.path(), folder / "a.zip");
  const auto a = open(iclFactory(), folder.path()), b = open(iclFactory(), folder / "a.zip");
  expectSame(*a, *b);
  const std::string camera = folder / "scene_00_0010.txt";
  const std::string whole = export_case::readText(camera);
  const auto error = [&]() { return errorOf(iclFactory(), folder.path()); };
  writeText(camera, whole.substr(0, whole.find("cam_up")));
  EXPECT_TRUE(has(error(), "scene_00_0010.txt:3: expected a line cam_up")) << error();
  writeText(camera, "cam_dir = [0, 0, nan]';\n" + whole);
  EXPECT_TRUE(has(error(), "scene_00_0010.txt:1: expected a line cam_dir"));
  writeText(camera, "cam_dir = [0, 0, 0]';\n" + whole);
  EXPECT_TRUE(has(error(), "scene_00_0010.txt:1: expected a line cam_dir"));
  fs::remove(camera);
  EXPECT_TRUE(says(open(iclFactory(), folder.path())->info().remarks, "scene_00_0010.txt"));
  const std::string first = folder / "scene_00_0009.txt", good = export_case::readText(first);
  writeText(first, "cam_right = [1e-320, 0, 0]';\n" + good);
  EXPECT_TRUE(has(error(), "scene_00_0009.txt: is no camera")) << error();
  writeText(first, good);
  writeText(folder / "scene_00_0011.depth", "1 2 3\n4");
  const auto dataset = open(iclFactory(), folder.path());
  dataset->seek(2);
  try {
    dataset->next();
    FAIL() << "expected an error";
  } catch (const gslam::ParseError& problem) {
    EXPECT_TRUE(has(problem.what(), "scene_00_0011.depth:2: the file has 4 numbers"));
  }
  fs::remove(folder / "scene_00_0011.depth");
  EXPECT_TRUE(says(open(iclFactory(), folder.path())->info().remarks, "scene_00_0011"));
  EXPECT_TRUE(has(errorOf(iclFactory(), folder.path(), Svar::object({{"unit", -1.0}})), "unit is"));
}

}  // namespace
