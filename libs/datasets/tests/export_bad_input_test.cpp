#include <sys/resource.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <limits>
#include <map>

#include "export_case.h"
#include "thrown.h"

namespace {

using namespace export_case;  // NOLINT(google-build-using-namespace)
using gslam::ArgumentError;
using gslam::Error;
using gslam::exportDataset;
using gslam::ExportOptions;
using gslam::ExportReport;
using gslam::FileError;

const char* const kFormats[] = {"tum", "euroc", "kitti", "icl", "tummono", "tumvi"};

// A dataset that fits a format.
Case fitting(const std::string& format) {
  Case c;
  c.models = {format == "tumvi" ? "kannala_brandt" : "pinhole"};
  c.has_depth = true;
  c.has_imu = true;
  return c;
}

// A dataset some of whose frames cannot be read.
class Broken : public gslam::Dataset {
 public:
  Broken(const Case& c, std::function<bool(std::size_t)> is_broken)
      : whole_(c.dataset()), is_broken_(std::move(is_broken)) {}
  const gslam::DatasetInfo& info() const override { return whole_->info(); }
  std::shared_ptr<const Frame> next() override {
    const std::shared_ptr<const Frame> frame = whole_->next();
    if (frame != nullptr && is_broken_(frame->id)) {
      throw FileError("000" + std::to_string(frame->id) + ".png", "is truncated");
    }
    return frame;
  }
  void seek(std::size_t index) override { whole_->seek(index); }

 private:
  std::unique_ptr<gslam::MemoryDataset> whole_;
  std::function<bool(std::size_t)> is_broken_;
};

// No file may grow beyond this many bytes: as on a full disk, fwrite() fails.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(Export, FormatsAreListedAndKnown) {
  const std::vector<gslam::ExportFormat> formats = gslam::exportFormats();
  ASSERT_EQ(formats.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(formats[i].name, kFormats[i]);
    EXPECT_FALSE(formats[i].summary.empty());
    const NewFolder folder;
    EXPECT_EQ(exportDataset(*fitting(kFormats[i]).dataset(), folder / "x", kFormats[i]).frames, 5U);
  }
}

TEST(ExportBadInput, UnknownFormatNamesTheKnown) {
  const NewFolder folder;
  const std::string message =
      thrownBy<ArgumentError>([&] { exportDataset(*Case().dataset(), folder / "x", "rosbag"); });
  EXPECT_EQ(message, "format is 'rosbag', expected one of tum, euroc, kitti, icl, tummono, tumvi");
  EXPECT_FALSE(fs::exists(folder / "x"));
}

TEST(ExportBadInput, FolderThatIsNotEmptyIsLeftAlone) {
  const NewFolder folder;
  std::ofstream(folder / "precious") << "data";
  for (const char* format : kFormats) {
    const std::string message = thrownBy<FileError>(
        [&] { exportDataset(*fitting(format).dataset(), folder.path(), format); });
    EXPECT_NE(message.find("is not empty"), std::string::npos) << message;
  }
  EXPECT_EQ(countFiles(folder.path()), 1U);
  EXPECT_EQ(readText(folder / "precious"), "data");
  EXPECT_THROW(exportDataset(*Case().dataset(), folder / "precious", "tum"), FileError);
  EXPECT_EQ(readText(folder / "precious"), "data");
}

TEST(ExportBadInput, FolderThatCannotBeMade) {
  const NewFolder folder;
  std::ofstream(folder / "file") << "data";
  EXPECT_THROW(exportDataset(*Case().dataset(), folder / "file/below", "tum"), FileError);
  EXPECT_THROW(exportDataset(*Case().dataset(), "/proc/gslam/x", "tum"), FileError);
  EXPECT_THROW(exportDataset(*Case().dataset(), "", "tum"), ArgumentError);
}

TEST(ExportBadInput, EmptyFolderIsFine) {
  const NewFolder folder;
  EXPECT_EQ(exportDataset(*Case().dataset(), folder.path(), "tum").frames, 5U);
}

TEST(ExportBadInput, FullDiskNamesTheFileAndLeavesWholeOnes) {
  for (const char* format : kFormats) {
    SCOPED_TRACE(format);
    const NewFolder folder;
    const auto dataset = fitting(format).dataset();
    std::string message;
    {
      const FileSizeLimit limit(1000);  // less than an image of noise
      message = thrownBy<FileError>([&] { exportDataset(*dataset, folder / "x", format); });
    }
    EXPECT_EQ(message.rfind(folder / "x", 0), 0U) << message;
    EXPECT_NE(message.find("File too large"), std::string::npos) << message;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "x")) {
      if (!entry.is_regular_file()) continue;
      const std::string path = entry.path().string();
      if (entry.path().extension() == ".png") {
        EXPECT_FALSE(readImage(path).empty());
      } else {
        const std::string text = readText(path);
        EXPECT_TRUE(text.empty() || text.back() == '\n') << path;
      }
    }
  }
}

// The disk is full when some text has grown: images and lists end with the same frame.
TEST(ExportBadInput, DiskThatBecomesFullLeavesWholeFrames) {
  const std::map<std::string, std::vector<std::string>> files = {
      {"tum", {"rgb.txt", "rgb", "depth.txt", "depth"}},
      {"euroc", {"mav0/cam0/data.csv", "mav0/cam0/data"}},
      {"kitti", {"poses/00.txt", "sequences/00/times.txt", "sequences/00/image_0"}},
      {"icl", {"associations.txt", "traj0.gt.freiburg", "rgb", "depth"}},
      {"tummono", {"times.txt", "groundtruthSync.txt", "images"}},
      {"tumvi", {"dso/cam0/times.txt", "mav0/cam0/data.csv", "mav0/cam0/data"}}};
  for (const char* format : kFormats) {
    SCOPED_TRACE(format);
    const NewFolder folder;
    Case c = fitting(format);
    c.frames = 120;
    const std::string name = format;
    c.has_truth = name == "kitti" || name == "icl" || name == "tummono";  // those that grow
    const auto dataset = c.dataset();
    {
      const FileSizeLimit limit(4000);
      EXPECT_THROW(exportDataset(*dataset, folder / "x", format), FileError);
    }
    std::vector<std::size_t> counts;
    for (const std::string& file : files.at(format)) {
      const std::string path = folder / ("x/" + file);
      counts.push_back(fs::is_directory(path) ? countFiles(path) : readTable(path).size());
    }
    EXPECT_GT(counts[0], 2U);
    EXPECT_LT(counts[0], 120U);
    EXPECT_EQ(counts, std::vector<std::size_t>(counts.size(), counts[0]));
  }
}

TEST(ExportBadInput, WithoutGroundTruthThereIsNone) {
  for (const char* format : kFormats) {
    SCOPED_TRACE(format);
    const NewFolder folder;
    Case c = fitting(format);
    c.has_truth = false;
    const ExportReport report = exportDataset(*c.dataset(), folder / "x", format);
    EXPECT_EQ(report.frames, 5U);
    EXPECT_TRUE(says(report.remarks, "no ground truth"));
    for (const auto& entry : fs::recursive_directory_iterator(folder / "x")) {
      const std::string name = entry.path().filename().string();
      EXPECT_EQ(name.find("gt"), std::string::npos) << name;
      EXPECT_EQ(name.find("roundtruth"), std::string::npos) << name;
      EXPECT_EQ(name.find("poses"), std::string::npos) << name;
      EXPECT_EQ(name.find("mocap"), std::string::npos) << name;
    }
  }
}

TEST(ExportBadInput, WithoutModelWhereItMustBe) {
  for (const char* format : kFormats) {
    SCOPED_TRACE(format);
    const NewFolder folder;
    Case c = fitting(format);
    c.models = {""};
    const std::string name = format;
    if (name == "tum" || name == "icl") {  // they have no place for it anyway
      EXPECT_EQ(exportDataset(*c.dataset(), folder / "x", format).frames, 5U);
      EXPECT_FALSE(fs::exists(folder / "x/calibration.txt"));
      continue;
    }
    const std::string message =
        thrownBy<ArgumentError>([&] { exportDataset(*c.dataset(), folder / "x", format); });
    EXPECT_NE(message.find("camera 'cam0' has no camera model"), std::string::npos) << message;
    EXPECT_FALSE(fs::exists(folder / "x")) << "before anything is written";
  }
}

TEST(ExportBadInput, ModelsThatALayoutLacksAreRefusedWithThoseItHas) {
  const struct {
    const char* format;
    std::vector<std::string> refused;
  } cases[] = {{"tum", {"kannala_brandt", "fov", "eucm"}},
               {"icl", {"radtan4", "kannala_brandt", "fov", "eucm"}},
               {"euroc", {"radtan5", "fov", "eucm"}},
               {"kitti", {"radtan4", "kannala_brandt", "fov", "eucm"}},
               {"tummono", {"radtan5", "eucm"}},
               {"tumvi", {"pinhole", "radtan4", "fov", "eucm"}}};
  for (const auto& each : cases) {
    for (const std::string& model : each.refused) {
      SCOPED_TRACE(each.format + (" " + model));
      const NewFolder folder;
      Case c = fitting(each.format);
      c.models = {model};
      const std::string message =
          thrownBy<ArgumentError>([&] { exportDataset(*c.dataset(), folder / "x", each.format); });
      EXPECT_NE(message.find("camera 'cam0' has the model"), std::string::npos) << message;
      EXPECT_NE(message.find(std::string(each.format) + " can only have"), std::string::npos)
          << message;
      EXPECT_FALSE(fs::exists(folder / "x"));
    }
  }
}

TEST(ExportBadInput, RigsThatALayoutCannotHave) {
  const NewFolder folder;
  Case c;
  c.models = {"pinhole", "pinhole"};
  c.is_rectified = false;
  EXPECT_NE(thrownBy<ArgumentError>([&] {
              exportDataset(*c.dataset(), folder / "x", "kitti");
            }).find("is not the rectified right one"),
            std::string::npos);
  EXPECT_NE(thrownBy<ArgumentError>([&] {
              exportDataset(*Case().dataset(), folder / "x", "icl");
            }).find("has no depth images"),
            std::string::npos);
  Case depth;
  depth.has_depth = true;
  gslam::DatasetInfo info = depth.info();
  const auto frames = depth.makeFrames(info);
  info.sensors.cameras[1].T_body_camera = SE3d();
  for (const char* format : {"tum", "icl"}) {
    gslam::MemoryDataset dataset(info, frames);
    EXPECT_NE(thrownBy<ArgumentError>([&] {
                exportDataset(dataset, folder / "x", format);
              }).find("measures depth from elsewhere"),
              std::string::npos);
  }
  info.sensors.cameras.erase(info.sensors.cameras.begin());
  for (const char* format : kFormats) {
    gslam::MemoryDataset dataset(info, frames);
    EXPECT_NE(thrownBy<ArgumentError>([&] {
                exportDataset(dataset, folder / "x", format);
              }).find("has no camera for brightness or colour"),
              std::string::npos);
  }
  EXPECT_FALSE(fs::exists(folder / "x"));
}

TEST(ExportBadInput, SequencesThatAreNoFileNames) {
  const NewFolder folder;
  for (const char* name : {"..", "../x", "a/b", ".hidden", "a b", "a\nb"}) {
    ExportOptions options;
    options.sequence = name;
    EXPECT_THROW(exportDataset(*Case().dataset(), folder / "x", "kitti", options), ArgumentError);
  }
  EXPECT_FALSE(fs::exists(folder / "x"));
}

TEST(ExportBadInput, FramesThatCannotBeReadAreCounted) {
  for (const char* format : kFormats) {
    SCOPED_TRACE(format);
    const NewFolder folder;
    Broken dataset(fitting(format), [](std::size_t i) { return i == 1 || i == 2; });
    const ExportReport report = exportDataset(dataset, folder / "x", format);
    EXPECT_EQ(report.frames, 3U);
    EXPECT_TRUE(says(report.left_out, "2 frames: cannot be read, such as 0001.png: is truncated"));
  }
}

TEST(ExportBadInput, NothingReadable) {
  const NewFolder folder;
  Broken dataset(Case(), [](std::size_t) { return true; });
  const std::string message =
      thrownBy<Error>([&] { exportDataset(dataset, folder / "x", "euroc"); });
  EXPECT_EQ(message, "no frame could be written: cannot be read: 0000.png: is truncated");
  Case many;
  many.frames = 150;
  Broken longer(many, [](std::size_t i) { return i > 10; });
  EXPECT_NE(thrownBy<Error>([&] {
              exportDataset(longer, folder / "y", "euroc");
            }).find("100 frames in a row"),
            std::string::npos);
  EXPECT_EQ(countFiles(folder / "y/mav0/cam0/data"), 11U) << "what came before stays";
}

TEST(ExportBadInput, NoFrames) {
  for (const char* format : kFormats) {
    const NewFolder folder;
    Case c = fitting(format);
    c.frames = 0;
    EXPECT_EQ(exportDataset(*c.dataset(), folder / "x", format).frames, 0U);
  }
}

TEST(ExportBadInput, FramesWithStrangeImagesAreLeftOut) {
  for (const char* format : kFormats) {
    SCOPED_TRACE(format);
    const NewFolder folder;
    const Case c = fitting(format);
    const gslam::DatasetInfo info = c.info();
    auto frames = c.makeFrames(info);
    const auto change = [&](std::size_t i) -> Frame& {
      const auto changed = std::make_shared<Frame>(*frames[i]);
      frames[i] = changed;
      return *changed;
    };
    change(0).images[0].image = Image(kWidth + 1, kHeight, PixelType::u8);
    change(1).images[0].image = Image(kWidth, kHeight, PixelType::f32);
    change(2).images.clear();
    change(3).images[0].image = Image();
    gslam::MemoryDataset dataset(info, frames);
    const ExportReport report = exportDataset(dataset, folder / "x", format);
    EXPECT_EQ(report.frames, 1U);
    EXPECT_TRUE(says(report.left_out, "4 frames: cannot be written, such as frame 0: "));
    EXPECT_TRUE(says(report.left_out, "is 41 x 30 u8, but the camera has 40 x 30"));
  }
}

TEST(ExportBadInput, DepthWithoutScale) {
  const NewFolder folder;
  Case c = fitting("tum");
  c.depth_scale = 0;
  EXPECT_NE(thrownBy<Error>([&] {
              exportDataset(*c.dataset(), folder / "x", "tum");
            }).find("has the depth scale 0"),
            std::string::npos);
}

TEST(ExportBadInput, StampsThatDoNotGoOn) {
  for (const char* format : kFormats) {
    SCOPED_TRACE(format);
    const NewFolder folder;
    const Case c = fitting(format);
    const gslam::DatasetInfo info = c.info();
    auto frames = c.makeFrames(info);
    const auto changed = std::make_shared<Frame>(*frames[2]);
    changed->stamp = frames[1]->stamp;
    frames[2] = changed;
    gslam::MemoryDataset dataset(info, frames);
    const ExportReport report = exportDataset(dataset, folder / "x", format);
    EXPECT_EQ(report.frames, 4U);
    EXPECT_TRUE(says(report.left_out, "1 frames: not later than the one before"));
  }
}

TEST(ExportBadInput, NumbersThatAreNotFinite) {
  for (const char* format : kFormats) {
    SCOPED_TRACE(format);
    const NewFolder folder;
    const Case c = fitting(format);
    gslam::DatasetInfo info = c.info();
    info.ground_truth.add(kFirstStamp + 1000, SE3d(SO3d(), {{NAN, 0, 0}}));
    auto frames = c.makeFrames(info);
    const auto changed = std::make_shared<Frame>(*frames[1]);
    changed->imu[0].accel[1] = INFINITY;
    changed->imu[2].stamp = changed->imu[1].stamp;
    frames[1] = changed;
    gslam::MemoryDataset dataset(info, frames);
    const ExportReport report = exportDataset(dataset, folder / "x", format);
    EXPECT_EQ(report.frames, 5U);
    const std::string name = format;
    if (name == "tum" || name == "euroc" || name == "tumvi") {
      EXPECT_TRUE(says(report.left_out, "1 inertial samples: they are not finite"));
      EXPECT_TRUE(says(report.left_out, "1 inertial samples: they are not later"));
      EXPECT_TRUE(says(report.left_out, "1 poses of the ground truth: they are not finite"));
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder / "x")) {
      if (!entry.is_regular_file() || entry.path().extension() == ".png") continue;
      const std::string text = readText(entry.path().string());
      EXPECT_EQ(text.find("nan"), std::string::npos) << entry.path();
      EXPECT_EQ(text.find("inf"), std::string::npos) << entry.path();
    }
  }
}

TEST(ExportBadInput, StampsAtTheEndsOfTime) {
  for (const std::int64_t first : {std::numeric_limits<std::int64_t>::min() + kPeriod * 2,
                                   std::int64_t(-kPeriod), std::int64_t(0)}) {
    for (const char* format : kFormats) {
      const NewFolder folder;
      Case c = fitting(format);
      c.first_stamp = first;
      c.has_truth = false;
      EXPECT_EQ(exportDataset(*c.dataset(), folder / "x", format).frames, 5U);
    }
  }
}

TEST(Export, StopsAfterAFrameAndLeavesAWholeDataset) {
  const auto rows = [](const std::string& path) { return readTable(path, " ,").size(); };
  const std::map<std::string, std::string> list_of = {
      {"tum", "rgb.txt"},        {"euroc", "mav0/cam0/data.csv"},
      {"kitti", "poses/00.txt"}, {"icl", "associations.txt"},
      {"tummono", "times.txt"},  {"tumvi", "dso/cam0/times.txt"}};
  for (const char* format : kFormats) {
    SCOPED_TRACE(format);
    const NewFolder folder;
    std::atomic<bool> stop{false};
    ExportOptions options;
    options.stop = &stop;
    std::vector<std::size_t> seen;
    options.progress = [&](std::size_t done, std::size_t total) {
      EXPECT_EQ(total, 5U);
      seen.push_back(done);
      stop = done == 2;
    };
    const ExportReport report =
        exportDataset(*fitting(format).dataset(), folder / "x", format, options);
    EXPECT_TRUE(report.is_stopped);
    EXPECT_EQ(report.frames, 2U);
    EXPECT_EQ(seen, (std::vector<std::size_t>{1, 2}));
    EXPECT_EQ(rows(folder / ("x/" + list_of.at(format))), 2U);
  }
}

TEST(Export, ProgressThatThrowsLeavesAWholeDataset) {
  const NewFolder folder;
  ExportOptions options;
  options.progress = [](std::size_t done, std::size_t) {
    if (done == 3) throw std::runtime_error("enough");
  };
  EXPECT_THROW(exportDataset(*Case().dataset(), folder / "x", "tum", options), std::runtime_error);
  EXPECT_EQ(readTable(folder / "x/rgb.txt").size(), 3U);
  EXPECT_EQ(countFiles(folder / "x/rgb"), 3U);
}

TEST(Export, TakesAsManyFramesAsAskedFromWhereTheDatasetIs) {
  const NewFolder folder;
  const auto dataset = Case().dataset();
  dataset->seek(1);
  ExportOptions options;
  options.count = 2;
  const ExportReport report = exportDataset(*dataset, folder / "x", "tum", options);
  EXPECT_EQ(report.frames, 2U);
  EXPECT_FALSE(report.is_stopped);
  const auto rows = readTable(folder / "x/rgb.txt");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(stampOf(rows[0][0]), kFirstStamp + kPeriod);
  EXPECT_EQ(dataset->next()->id, 3U);
}

}  // namespace
