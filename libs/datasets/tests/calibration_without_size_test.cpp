// Calibrations whose files do not say how large the images are: every format that takes one from
// the user takes the size from the first image.
#include <gslam/datasets/export_dataset.h>
#include <gslam/datasets/formats.h>
#include <gslam/datasets/synthetic.h>

#include <opencv2/videoio.hpp>

#include "format_case.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)

constexpr int kGivenWidth = 64, kGivenHeight = 48;

// ORB-SLAM2's settings, as most users have them.
const char* const kSettings =
    "%YAML:1.0\nCamera.fx: 50.5\nCamera.fy: 51.5\nCamera.cx: 31.5\nCamera.cy: 23.5\n"
    "Camera.k1: 0.1\nCamera.k2: -0.01\nCamera.p1: 0.0\nCamera.p2: 0.0\nCamera.fps: 30.0\n";

class calibrationWithoutSize : public testing::Test {
 protected:
  calibrationWithoutSize() { writeText(file_, kSettings); }

  void exportAs(const std::string& format, const std::string& sensors,
                const std::string& model = "pinhole") const {
    gslam::SyntheticOptions options;
    options.frames = 3;
    options.width = kGivenWidth;
    options.height = kGivenHeight;
    options.sensors = sensors;
    options.model = model;
    gslam::exportDataset(*gslam::openSynthetic(options), sequence_, format);
  }
  void writeImages(const std::vector<std::string>& names, int type = CV_8UC3) const {
    for (std::size_t i = 0; i < names.size(); ++i) {
      writeImage(sequence_ + "/" + names[i], numbered(kGivenWidth, kGivenHeight, int(i), type));
    }
  }
  void expectRead(const DatasetFactory& factory, const std::string& path = "") const {
    const auto dataset =
        open(factory, path.empty() ? sequence_ : path, Svar::object({{"calibration", file_}}));
    expectCamera(dataset->info().sensors.cameras[0].camera);
    EXPECT_NE(dataset->next(), nullptr);
  }
  static void expectCamera(const gslam::Camera& camera) {
    EXPECT_EQ(camera.modelName(), "radtan");
    EXPECT_EQ(camera.width(), kGivenWidth);
    EXPECT_EQ(camera.height(), kGivenHeight);
    EXPECT_EQ(camera.parameters(), (std::vector<double>{50.5, 51.5, 31.5, 23.5, 0.1, -0.01, 0, 0}));
  }

  const TempFolder folder_;
  const std::string sequence_ = folder_ / "sequence", file_ = folder_ / "settings.yaml";
};

TEST_F(calibrationWithoutSize, Euroc) {
  exportAs("euroc", "stereo");
  expectRead(gslam::eurocFactory());
}

TEST_F(calibrationWithoutSize, TumVi) {
  exportAs("tumvi", "stereo", "kannala_brandt");
  expectRead(gslam::tumViFactory());
}

TEST_F(calibrationWithoutSize, TumMono) {
  exportAs("tummono", "mono");
  expectRead(gslam::tumMonoFactory());
}

TEST_F(calibrationWithoutSize, Tum) {
  exportAs("tum", "rgbd");
  expectRead(gslam::tumFactory());
}

TEST_F(calibrationWithoutSize, Icl) {
  exportAs("icl", "rgbd");
  expectRead(gslam::iclFactory());
}

TEST_F(calibrationWithoutSize, SevenScenes) {
  for (int i = 0; i < 2; ++i) {
    const std::string base = sequence_ + "/frame-00000" + std::to_string(i);
    writeImage(base + ".color.png", numbered(kGivenWidth, kGivenHeight, i, CV_8UC3));
    writeImage(base + ".depth.png", numbered(kGivenWidth, kGivenHeight, i, CV_16UC1));
    writeText(base + ".pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  }
  expectRead(gslam::sevenScenesFactory());
}

TEST_F(calibrationWithoutSize, Photos) {
  writeImages({"1.jpg", "2.jpg"});
  expectRead(gslam::photosFactory());
}

TEST_F(calibrationWithoutSize, DroneMap) {
  writeImages({"1.5.png", "2.5.png"});
  writeText(sequence_ + "/frames.txt", "1.5 1.5.png\n2.5 2.5.png\n");
  expectRead(gslam::droneMapFactory());
}

TEST_F(calibrationWithoutSize, CvMono) {
  writeImages({"1.png", "2.png"});
  expectRead(gslam::cvMonoFactory());
  expectRead(gslam::cvMonoFactory(), sequence_ + "/*.png");
}

TEST_F(calibrationWithoutSize, CvMonosVideo) {
  const std::string video = folder_ / "video.avi";
  {
    cv::VideoWriter writer(video, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10,
                           {kGivenWidth, kGivenHeight});
    ASSERT_TRUE(writer.isOpened());
    for (int i = 0; i < 3; ++i) writer << numbered(kGivenWidth, kGivenHeight, i, CV_8UC3);
  }
  expectRead(gslam::cvMonoFactory(), video);
}

TEST_F(calibrationWithoutSize, Folder) {
  writeImages({"images/0.png", "images/1.png"}, CV_8UC1);
  writeText(sequence_ + "/settings.yaml", kSettings);
  writeText(sequence_ + "/dataset.yaml",
            "cameras:\n  - {images: images, rate: 10, calibration: settings.yaml}\n");
  const auto dataset = open(gslam::folderFactory(), sequence_);
  expectCamera(dataset->info().sensors.cameras[0].camera);
}

}  // namespace
