// Folders that have more than one sequence, and those that more than one format could be of.
#include <gslam/datasets/export_dataset.h>
#include <gslam/datasets/formats.h>
#include <gslam/datasets/synthetic.h>

#include "format_case.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)

void exportTo(const std::string& folder, const std::string& format) {
  gslam::SyntheticOptions options;
  options.width = 40;
  options.height = 30;
  options.frames = 2;
  options.colour = true;
  const auto source = gslam::openSynthetic(options);
  gslam::exportDataset(*source, folder, format);
}

void writeStrecha(const std::string& folder) {
  writeImage(folder + "/0000.png", numbered(32, 24, 1));
  writeText(folder + "/0000.png.camera",
            "20 0 15.5\n0 21 11.5\n0 0 1\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-7 -8 0.5\n32 24\n");
}

void writeScene(const std::string& folder) {
  writeImage(folder + "/frame-000000.color.png", numbered(16, 12, 1, CV_8UC3));
  writeImage(folder + "/frame-000000.depth.png", numbered(16, 12, 1, CV_16UC1));
  writeText(folder + "/frame-000000.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
}

// That nothing is chosen where several are meant; whoever names one gets it.
void expectAsks(const DatasetFactory& factory, const TempFolder& folder) {
  EXPECT_EQ(gslam::datasetFormatOf(folder.path()), factory.name);
  const std::string error = errorOf(factory, folder.path());
  EXPECT_TRUE(has(error, "has 2 sequences") && has(error, "one of first, second")) << error;
  EXPECT_FALSE(has(error, "unpack"));
  for (const char* name : {"first", "second"}) {
    EXPECT_EQ(open(factory, folder / name)->info().name, name);
  }
  const TempFolder zips;
  zipFolder(folder.path(), zips / "both.zip");
  EXPECT_TRUE(has(errorOf(factory, zips / "both.zip"), "unpack it"));
  zipFolder(folder / "second", zips / "one.zip", "second/");
  EXPECT_EQ(errorOf(factory, zips / "one.zip"), "");
}

TEST(readSequences, SeveralOfOneFormatAreAskedFor) {
  for (const DatasetFactory& factory :
       {gslam::tumFactory(), gslam::iclFactory(), gslam::eurocFactory(), gslam::tumMonoFactory(),
        gslam::strechaFactory()}) {
    SCOPED_TRACE(factory.name);
    const TempFolder folder;
    for (const char* name : {"first", "second"}) {
      if (factory.name == "strecha") {
        writeStrecha(folder / name);
      } else {
        exportTo(folder / name, factory.name);
      }
    }
    expectAsks(factory, folder);
  }
}

TEST(readSequences, WhatIsSureIsTakenBeforeWhatIsEnough) {
  const TempFolder folder;
  writeImage(folder / "a/images/00000.png", numbered(16, 12, 1));  // no camera.txt
  exportTo(folder / "b", "tummono");
  EXPECT_EQ(gslam::datasetFormatOf(folder.path()), "tummono");
  EXPECT_EQ(open(gslam::tumMonoFactory(), folder.path())->info().name, "b");
}

TEST(readSequences, EqualNamesAreAskedFor) {
  const TempFolder folder;
  for (const char* name : {"chess/seq-01", "fire/seq-01", "fire/seq-02"}) {
    writeScene(folder / name);
  }
  const DatasetFactory factory = gslam::sevenScenesFactory();
  EXPECT_EQ(gslam::datasetFormatOf(folder.path()), "7scenes");
  for (const Svar& wanted : {Svar("seq-01"), Svar("01"), Svar(1)}) {
    const std::string error = errorOf(factory, folder.path(), Svar::object({{"sequence", wanted}}));
    EXPECT_TRUE(has(error, "one of: chess/seq-01, fire/seq-01")) << error;
    EXPECT_FALSE(has(error, "seq-02")) << error;
  }
  const auto nameOf = [&](const Svar& wanted) {
    const auto dataset = open(factory, folder.path(), Svar::object({{"sequence", wanted}}));
    return dataset->info().name.substr(dataset->info().name.find('/') + 1);
  };
  EXPECT_EQ(nameOf("fire/seq-01"), "fire/seq-01");
  EXPECT_EQ(nameOf("chess/seq-01"), "chess/seq-01");
  EXPECT_EQ(nameOf(2), "fire/seq-02");
}

TEST(readSequences, PathsCountBeforeNames) {
  const TempFolder folder;
  writeScene(folder / "seq-01");
  writeScene(folder / "more/seq-01");
  const auto dataset =
      open(gslam::sevenScenesFactory(), folder.path(), Svar::object({{"sequence", "seq-01"}}));
  EXPECT_FALSE(has(dataset->info().name, "more"));
}

TEST(readSequences, PackedScenesAreSaid) {
  const TempFolder folder;
  writeScene(folder / "x/seq-01");
  fs::create_directories(folder / "chess");
  zipFolder(folder / "x", folder / "chess/seq-01.zip");
  zipFolder(folder / "x", folder / "chess/seq-02.zip");
  EXPECT_EQ(gslam::datasetFormatOf(folder / "chess"), "7scenes");
  const std::string error = errorOf(gslam::sevenScenesFactory(), folder / "chess");
  EXPECT_TRUE(has(error, "name one of these archives, or unpack them: seq-01.zip, seq-02.zip"))
      << error;
  EXPECT_EQ(errorOf(gslam::sevenScenesFactory(), folder / "chess/seq-02.zip"), "");
}

// ICL-NUIM as it is made ready for readers of TUM RGB-D.
class IclAsTum {
 public:
  explicit IclAsTum(const std::string& truth_name, int first = 0) {
    std::string rgb = "# color images\n", depth, truth;
    for (int i = first; i < first + 3; ++i) {
      const std::string number = std::to_string(i);
      writeImage(folder / ("rgb/" + number + ".png"), numbered(16, 12, i, CV_8UC3));
      writeImage(folder / ("depth/" + number + ".png"), numbered(16, 12, i, CV_16UC1));
      rgb += number + " rgb/" + number + ".png\n";
      depth += number + " depth/" + number + ".png\n";
      truth += number + " 0 " + number + " 2 0.1 0.2 0.3 0.9273618495495704\n";
    }
    writeText(folder / "rgb.txt", rgb);
    writeText(folder / "depth.txt", depth);
    writeText(folder / truth_name, truth);
  }
  TempFolder folder;
};

TEST(readSequences, IclWithListsOfTumIsIcl) {
  for (const char* truth : {"groundtruth.txt", "livingRoom0.gt.freiburg"}) {
    for (const int first : {0, 1}) {
      const IclAsTum icl(truth, first);
      EXPECT_EQ(gslam::datasetFormatOf(icl.folder.path()), "icl");
      const auto dataset = open(gslam::iclFactory(), icl.folder.path());
      EXPECT_EQ(dataset->info().frame_count, 3U);
      ASSERT_EQ(dataset->info().ground_truth.size(), 3U);
      EXPECT_EQ(dataset->info().ground_truth[1].stamp, first == 0 ? 33333333 : 66666667);
      EXPECT_EQ(dataset->info().ground_truth[1].pose.translation()[1], -(first + 1));  // mirrored
      const auto frame = dataset->next();
      ASSERT_EQ(frame->images.size(), 2U);
      EXPECT_EQ(frame->images[1].kind, ImageKind::depth);
    }
  }
  const IclAsTum late("livingRoom0.gt.freiburg", 5);
  EXPECT_EQ(gslam::datasetFormatOf(late.folder.path()), "icl");
}

TEST(readSequences, IclWithListsThatAreWrong) {
  const IclAsTum icl("groundtruth.txt");
  fs::remove(icl.folder / "depth.txt");
  const auto mono = open(gslam::iclFactory(), icl.folder.path());
  EXPECT_EQ(mono->next()->images.size(), 1U);
  EXPECT_TRUE(says(mono->info().remarks, "no depth.txt"));
  writeText(icl.folder / "rgb.txt", "0.5 rgb/0.png\n1 rgb/1.png\n");
  writeText(icl.folder / "depth.txt", "0.51 depth/0.png\n1.03 depth/1.png\n");
  writeText(icl.folder / "groundtruth.txt", "0.5 0 0 0 0 0 0 1\n");
  const auto seconds = open(gslam::iclFactory(), icl.folder.path());
  EXPECT_EQ(seconds->info().frame_count, 1U);
  EXPECT_TRUE(has(seconds->info().clock, "rgb.txt"));
  writeText(icl.folder / "rgb.txt", "0\n");
  EXPECT_TRUE(has(errorOf(gslam::iclFactory(), icl.folder.path()), "rgb.txt:1"));
}

TEST(readSequences, TumSaysWhereItMayBeIcl) {
  const IclAsTum icl("groundtruth.txt", 5);  // nothing tells it from a TUM recording but stamps
  EXPECT_EQ(gslam::datasetFormatOf(icl.folder.path()), "tum");
  const auto dataset = open(gslam::tumFactory(), icl.folder.path());
  EXPECT_TRUE(says(dataset->info().remarks, "icl:" + icl.folder.path() + " reads it so"));
  EXPECT_EQ(errorOf(gslam::iclFactory(), icl.folder.path()), "");
  writeText(icl.folder / "rgb.txt", "5 rgb/5.png\n6.5 rgb/6.png\n");
  const auto other = open(gslam::tumFactory(), icl.folder.path(), Svar::object({{"depth", false}}));
  EXPECT_FALSE(says(other->info().remarks, "icl:"));
}

TEST(readSequences, ListsThatCannotBeReadAreOfTum) {
  for (const char* text : {"", "\xFF\xFE", ",", "0", "0,,", "0 \n", "# 0 rgb/0.png\n"}) {
    const TempFolder folder;
    writeText(folder / "rgb.txt", text);
    EXPECT_EQ(gslam::datasetFormatOf(folder.path()), "tum");
    EXPECT_TRUE(has(errorOf(gslam::tumFactory(), folder.path()), "rgb.txt")) << text;
  }
}

TEST(readSequences, TumWithAssociationsStaysTum) {
  const TempFolder folder;
  exportTo(folder / "tum", "tum");
  writeText(folder / "tum/associations.txt", "0 depth/0.png 0 rgb/0.png\n");
  EXPECT_EQ(gslam::datasetFormatOf(folder / "tum"), "tum");
}

TEST(readSequences, ExportsHaveNoLicenceOfOthers) {
  for (const DatasetFactory& factory :
       {gslam::tumFactory(), gslam::iclFactory(), gslam::kittiFactory()}) {
    const TempFolder folder;
    exportTo(folder / "mine", factory.name);
    EXPECT_EQ(open(factory, folder / "mine")->info().licence, "") << factory.name;
  }
  for (const char* truth : {"livingRoom0.gt.freiburg", "traj0.gt.freiburg"}) {
    const IclAsTum published(truth);
    EXPECT_EQ(open(gslam::iclFactory(), published.folder.path())->info().licence, "CC BY 3.0");
  }
  const IclAsTum other("groundtruth.txt");
  EXPECT_EQ(open(gslam::iclFactory(), other.folder.path())->info().licence, "");
  const TempFolder folder;
  fs::copy(other.folder.path(), folder / "living_room_traj1n_frei_png",
           fs::copy_options::recursive);
  EXPECT_EQ(open(gslam::iclFactory(), folder / "living_room_traj1n_frei_png")->info().licence,
            "CC BY 3.0");
}

}  // namespace
