// TUM monoVO: what export writes, read back; photometric calibration with a known response.
#include <gslam/datasets/export_dataset.h>
#include <gslam/datasets/formats.h>
#include <gslam/datasets/synthetic.h>

#include <sstream>

#include "format_case.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)

constexpr int kMonoWidth = 48, kMonoHeight = 32;

class ExportedTumMono {
 public:
  ExportedTumMono() {
    gslam::SyntheticOptions options;
    options.frames = 5;
    options.width = kMonoWidth;
    options.height = kMonoHeight;
    options.sensors = "mono";
    options.model = "fov";
    options.exposure_change = 0.4;
    world_ = gslam::openSynthetic(options);
    gslam::exportDataset(*world_, path(), "tummono");
  }
  std::string path(const std::string& name = "") const {
    return folder_ / (name.empty() ? "sequence_07" : "sequence_07/" + name);
  }
  std::string text(const std::string& name) const { return export_case::readText(path(name)); }
  std::string error(const Svar& parameters = Svar()) const {
    return errorOf(gslam::tumMonoFactory(), path(), parameters);
  }
  const TempFolder& folder() const { return folder_; }
  Dataset& world() const { return *world_; }

 private:
  TempFolder folder_;
  std::unique_ptr<Dataset> world_;
};

std::unique_ptr<Dataset> openTumMono(const std::string& path, const Svar& parameters = Svar()) {
  return open(gslam::tumMonoFactory(), path, parameters);
}

Svar photometric(const std::string& how) {
  return Svar::object({{"photometric", how}});
}

TEST(readTumMono, ReadsWhatWasExported) {
  const ExportedTumMono exported;
  EXPECT_EQ(gslam::datasetFormatOf(exported.path()), "tummono");
  const auto dataset = openTumMono(exported.path());
  const gslam::DatasetInfo &info = dataset->info(), &expected = exported.world().info();
  EXPECT_EQ(info.name, "sequence_07");
  EXPECT_EQ(info.body, "the camera");
  ASSERT_EQ(info.sensors.cameras.size(), 1U);
  const gslam::Camera camera = info.sensors.cameras[0].camera;
  EXPECT_EQ(camera.modelName(), "fov");
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(camera.parameters()[i], expected.sensors.cameras[0].camera.parameters()[i], 1e-9);
  }
  for (std::size_t i = 0; i < 5; ++i) {
    const auto frame = dataset->next(), same = frameAt(exported.world(), i);
    EXPECT_EQ(frame->stamp, same->stamp);
    EXPECT_EQ(frame->images[0].exposure, same->images[0].exposure);
    EXPECT_EQ(frame->images[0].image, same->images[0].image);
    SE3d pose, T_world_body;
    ASSERT_TRUE(info.ground_truth.interpolate(frame->stamp, pose));
    ASSERT_TRUE(expected.ground_truth.interpolate(frame->stamp, T_world_body));
    EXPECT_TRUE(pose.isApprox(T_world_body * expected.sensors.cameras[0].T_body_camera, 1e-9));
  }
}

TEST(readTumMono, TheLicenceIsThatOfTumMonoOnly) {
  const ExportedTumMono exported;
  EXPECT_TRUE(has(openTumMono(exported.path())->info().licence, "TUM monoVO"));
  for (const char* name : {"sequence_00", "sequence_51", "sequence_077", "mine"}) {
    fs::rename(exported.path(), exported.folder() / name);
    EXPECT_EQ(openTumMono(exported.folder() / name)->info().licence, "") << name;
    fs::rename(exported.folder() / name, exported.path());
  }
}

// Lines in the form of the published sequences, whatever export makes of it: times.txt with id, s
// and ms, to ten digits.
TEST(readTumMono, ReadsLinesAsTheyArePublished) {
  const TempFolder folder;
  for (int i = 0; i < 3; ++i) {
    writeImage(folder / ("images/0000" + std::to_string(i) + ".jpg"), numbered(8, 6, i));
  }
  writeText(folder / "times.txt",
            "00000 1435850214.5384142399 0.1996353716\n"
            "00001 1435850214.5884389877 0.2043156773\n"
            "00002 1435850214.638434 12.5\n");
  const auto dataset = openTumMono(folder.path());
  const auto frames = allFrames(*dataset);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0]->stamp, 1435850214538414240);  // to the nearest nanosecond
  EXPECT_EQ(frames[1]->stamp, 1435850214588438988);
  EXPECT_EQ(frames[2]->stamp, 1435850214638434000);
  EXPECT_EQ(frames[0]->images[0].exposure, 199635);
  EXPECT_EQ(frames[1]->images[0].exposure, 204316);
  EXPECT_EQ(frames[2]->images[0].exposure, 12500000);
}

TEST(readTumMono, ImagesInAnArchiveOfTheirOwn) {
  const ExportedTumMono exported;
  const auto expected = openTumMono(exported.path());
  for (const std::string inside : {"", "images/"}) {
    const ExportedTumMono other;
    zipFolder(other.path("images"), other.path("images.zip"), inside);
    fs::remove_all(other.path("images"));
    EXPECT_EQ(gslam::datasetFormatOf(other.path()), "tummono");
    const auto found = openTumMono(other.path());
    expected->seek(0);
    expectSame(*expected, *found);
    zipFolder(other.path(), other.folder() / "both.zip");
    EXPECT_TRUE(has(errorOf(gslam::tumMonoFactory(), other.folder() / "both.zip"),
                    "images.zip: cannot be opened; in an archive it has to be unpacked first"));
  }
}

TEST(readTumMono, AnArchiveReadsTheSame) {
  const ExportedTumMono exported;
  zipFolder(exported.path(), exported.folder() / "seq.zip", "sequence_07/");
  const auto folder = openTumMono(exported.path(), photometric("u8"));
  const auto archive = openTumMono(exported.folder() / "seq.zip", photometric("u8"));
  expectSame(*folder, *archive);
  EXPECT_EQ(archive->info().name, "sequence_07");
}

TEST(readTumMono, GroundTruthAtTheEndsOnly) {
  const ExportedTumMono exported;
  std::istringstream lines(exported.text("groundtruthSync.txt"));
  std::string text, line;
  for (int i = 0; std::getline(lines, line); ++i) {
    text += i < 2 || i > 3 ? line : line.substr(0, line.find(' ')) + " NaN NaN NaN NaN NaN NaN NaN";
    text += "\r\n";
  }
  writeText(exported.path("groundtruthSync.txt"), text);
  const auto dataset = openTumMono(exported.path());
  EXPECT_EQ(dataset->info().ground_truth.size(), 3U);
  EXPECT_TRUE(says(dataset->info().remarks, "2 of 5 lines of groundtruthSync.txt have no pose"));
  writeText(exported.path("groundtruthSync.txt"), "\n1 2 3 NaN 0 0 0 1\n\n4 5 6 7 0 0 0 0\n");
  EXPECT_TRUE(has(exported.error(), "groundtruthSync.txt:4:"));  // lines are those of the file
}

// The response of this camera is G(x) = 255 sqrt(x / 255), so that G^-1(I) = I^2 / 255; its file
// has it in another unit. The vignette falls to a half in the corner.
class KnownCamera {
 public:
  explicit KnownCamera(const ExportedTumMono& exported) {
    std::string response;
    for (int i = 0; i < 256; ++i) response += std::to_string(7 + 3 * i * i) + ".0 ";
    writeText(exported.path("pcalib.txt"), response + "\n");
    cv::Mat vignette(kMonoHeight, kMonoWidth, CV_16UC1);
    for (int y = 0; y < kMonoHeight; ++y) {
      for (int x = 0; x < kMonoWidth; ++x) {
        vignette.at<std::uint16_t>(y, x) =
            static_cast<std::uint16_t>(std::lround(40000 * attenuation(x, y)));
      }
    }
    writeImage(exported.path("vignette.png"), vignette);
    for (int i = 0; i < 5; ++i) {
      cv::Mat image(kMonoHeight, kMonoWidth, CV_8UC1);
      for (int y = 0; y < kMonoHeight; ++y) {
        for (int x = 0; x < kMonoWidth; ++x) {
          const double seen = attenuation(x, y) * radiance(x, y, i);
          image.at<std::uint8_t>(y, x) =
              static_cast<std::uint8_t>(std::lround(255 * std::sqrt(seen / 255)));
        }
      }
      writeImage(exported.path("images/0000" + std::to_string(i) + ".png"), image);
    }
  }

  static double attenuation(int x, int y) {
    return 1 - 0.5 * double(x * x + y * y) / (kMonoWidth * kMonoWidth + kMonoHeight * kMonoHeight);
  }
  static double radiance(int x, int y, int frame) { return 20 + 3 * x + 2 * y + 5 * frame; }
  // What a grey level more or less makes of it.
  static double step(int x, int y, int frame) {
    return 2 * std::sqrt(radiance(x, y, frame) * attenuation(x, y) / 255) / attenuation(x, y) / 2;
  }
};

TEST(readTumMono, PhotometricCorrectionRecoversTheRadiance) {
  const ExportedTumMono exported;
  const KnownCamera known(exported);
  const auto floats = openTumMono(exported.path(), photometric("f32"));
  const auto bytes = openTumMono(exported.path(), photometric("u8"));
  EXPECT_TRUE(says(floats->info().remarks, "images are corrected"));
  for (int i = 0; i < 5; ++i) {
    const auto f32 = floats->next(), u8 = bytes->next();
    ASSERT_EQ(f32->images[0].image.type(), PixelType::f32);
    ASSERT_EQ(u8->images[0].image.type(), PixelType::u8);
    for (int y = 0; y < kMonoHeight; ++y) {
      for (int x = 0; x < kMonoWidth; ++x) {
        const double expected = KnownCamera::radiance(x, y, i);
        const double error = KnownCamera::step(x, y, i) + 0.05;
        const double found = double(f32->images[0].image.at<float>(x, y));
        ASSERT_NEAR(found, expected, error) << x << " " << y;
        ASSERT_NEAR(u8->images[0].image.at<std::uint8_t>(x, y), std::min(found, 255.0), 0.51);
      }
    }
  }
  // As they are in the files, they are far off.
  const auto raw = openTumMono(exported.path());
  EXPECT_EQ(raw->next()->images[0].image.at<std::uint8_t>(0, 0),
            std::lround(255 * std::sqrt(20 / 255.0)));
}

TEST(readTumMono, DarkVignetteIsSaid) {
  const ExportedTumMono exported;
  cv::Mat vignette(kMonoHeight, kMonoWidth, CV_8UC1, cv::Scalar(200));
  vignette.at<std::uint8_t>(3, 5) = 0;
  writeImage(exported.path("vignette.png"), vignette);
  const auto dataset = openTumMono(exported.path(), photometric("f32"));
  EXPECT_TRUE(says(dataset->info().remarks, "vignette.png is 0 at 1 pixels"));
  EXPECT_EQ(dataset->next()->images[0].image.at<float>(5, 3), 0);
}

TEST(readTumMono, PhotometricCalibrationThatIsWrong) {
  const ExportedTumMono exported;
  EXPECT_TRUE(has(exported.error(photometric("u16")), "photometric is 'u16', expected none, u8"));
  std::string response = exported.text("pcalib.txt");
  writeText(exported.path("pcalib.txt"), "0 1 2\n");
  EXPECT_EQ(exported.error(), "");  // not asked for
  EXPECT_TRUE(has(exported.error(photometric("u8")), "pcalib.txt: has 3 values"));
  writeText(exported.path("pcalib.txt"), "0 1 2 1.5\n");
  EXPECT_TRUE(has(exported.error(photometric("u8")), "pcalib.txt:1:7: value 3 is less than"));
  writeText(exported.path("pcalib.txt"), response + " 256");
  EXPECT_TRUE(has(exported.error(photometric("u8")), "pcalib.txt"));
  fs::remove(exported.path("pcalib.txt"));
  EXPECT_TRUE(has(exported.error(photometric("u8")), "pcalib.txt"));
  writeText(exported.path("pcalib.txt"), response);
  writeImage(exported.path("vignette.png"), numbered(8, 8, 1));
  EXPECT_TRUE(has(exported.error(photometric("f32")), "photometric calibration is for 8 x 8"));
  writeImage(exported.path("vignette.png"),
             cv::Mat(kMonoHeight, kMonoWidth, CV_8UC1, cv::Scalar(0)));
  EXPECT_TRUE(has(exported.error(photometric("f32")), "vignette.png: is black"));
  writeImage(exported.path("vignette.png"), numbered(kMonoWidth, kMonoHeight, 1, CV_8UC3));
  EXPECT_TRUE(has(exported.error(photometric("f32")), "expected grey of 8 or 16 bits"));
}

TEST(readTumMono, WhatIsMissingIsSaid) {
  const ExportedTumMono exported;
  fs::remove(exported.path("camera.txt"));
  fs::remove(exported.path("groundtruthSync.txt"));
  fs::remove(exported.path("images/00003.png"));
  writeImage(exported.path("images/other.png"), numbered(kMonoWidth, kMonoHeight, 1));
  const auto dataset = openTumMono(exported.path());
  const std::vector<std::string>& remarks = dataset->info().remarks;
  EXPECT_EQ(dataset->info().frame_count, 4U);
  EXPECT_TRUE(says(remarks, "there is no camera.txt"));
  EXPECT_TRUE(says(remarks, "there is no groundtruthSync.txt"));
  EXPECT_TRUE(says(remarks, "1 images that times.txt lists and that do not exist"));
  EXPECT_TRUE(says(remarks, "1 images without a line in times.txt"));
  const auto given =
      openTumMono(exported.path(), Svar::object({{"camera", "pinhole 48x32 40 40 23.5 15.5"}}));
  EXPECT_EQ(given->info().sensors.cameras[0].camera.modelName(), "pinhole");
}

TEST(readTumMono, SaysWhichFileAndLineIsWrong) {
  const struct {
    const char* file;
    const char* text;
    const char* message;
  } cases[] = {
      {"times.txt", "00000\n", "times.txt:1:6: the line ends"},
      {"times.txt", "00000 1.5 0.1\n00001 x 0.1\n", "times.txt:2:7: 'x' is no number"},
      {"times.txt", "00000 1.5 -1\n", "times.txt:1:11: the exposure is negative"},
      {"times.txt", "00000 1.5 1 2\n", "times.txt:1:13: the line goes on"},
      {"times.txt", "", "has no frame"},
      {"camera.txt", "0.5 0.6\n", "camera.txt:1:1: there are 2 parameters, expected 5 or 8"},
      {"groundtruthSync.txt", "1 2 3\n", "groundtruthSync.txt:1:"},
  };
  for (const auto& each : cases) {
    const ExportedTumMono exported;
    writeText(exported.path(each.file), each.text);
    const std::string error = exported.error();
    EXPECT_TRUE(has(error, each.message)) << "'" << error << "' has no '" << each.message << "'";
  }
  const ExportedTumMono exported;
  fs::remove(exported.path("times.txt"));
  EXPECT_TRUE(has(exported.error(), "times.txt"));
  const TempFolder empty;
  EXPECT_TRUE(
      has(errorOf(gslam::tumMonoFactory(), empty.path()), "neither images/ nor images.zip"));
  fs::create_directories(empty / "images");
  EXPECT_TRUE(has(errorOf(gslam::tumMonoFactory(), empty.path()), "has no images"));
}

TEST(readTumMono, OrderAndTwinsAreSaid) {
  const ExportedTumMono exported;
  writeText(exported.path("times.txt"),
            "00001 2.0 1\r\n00000 1.0 1\r\n00002 3.0\r\n00003 3.0 1\r\n00004 4.25 0\r\n");
  const auto dataset = openTumMono(exported.path());
  EXPECT_EQ(dataset->info().frame_count, 4U);
  EXPECT_TRUE(says(dataset->info().remarks, "are not in the order of their stamps"));
  EXPECT_TRUE(says(dataset->info().remarks, "1 images that have the stamp of another"));
  const auto frames = allFrames(*dataset);
  EXPECT_EQ(frames[0]->stamp, 1000000000);
  EXPECT_EQ(frames[0]->images[0].exposure, 1000000);
  EXPECT_EQ(frames[2]->images[0].exposure, 0);
  EXPECT_EQ(frames[3]->stamp, 4250000000);
}

TEST(readTumMono, ACutImageIsAnError) {
  const ExportedTumMono exported;
  cutInHalf(exported.path("images/00002.png"));
  const auto dataset = openTumMono(exported.path());
  dataset->next();
  dataset->next();
  EXPECT_THROW(dataset->next(), gslam::FileError);
  EXPECT_EQ(dataset->next()->id, 3U);
}

}  // namespace
