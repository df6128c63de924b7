// Files of trajectories: what was written comes back, and what cannot be right is refused.
#include <gmock/gmock.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/geometry/random.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <clocale>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <locale>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "pose_bits.h"
#include "problem_when.h"

namespace {

using gslam::DuplicateStamps;
using gslam::parseTrajectory;
using gslam::printTrajectory;
using gslam::SE3d;
using gslam::SO3d;
using gslam::StampedPose;
using gslam::StampUnit;
using gslam::Trajectory;
using gslam::TrajectoryFileOptions;
using gslam::TrajectoryFormat;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

Trajectory read(const std::string& text, TrajectoryFormat format = TrajectoryFormat::any) {
  TrajectoryFileOptions options;
  options.format = format;
  return parseTrajectory(text, "poses.txt", options);
}

std::string trajectoryProblem(const std::string& text,
                              TrajectoryFormat format = TrajectoryFormat::any) {
  return problemWhen([&] { read(text, format); });
}

Trajectory drawnTrajectory(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<StampedPose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t stamp = static_cast<std::int64_t>(random()) >> (random() % 40);
    SE3d pose = gslam::randomOf<SE3d>(random);
    for (int n = static_cast<int>(i % 4); n > 0; --n) pose *= pose;  // of every magnitude
    poses.push_back({stamp, SE3d(pose.rotation().normalized(), pose.translation())});
  }
  return Trajectory(poses);
}

void expectSame(const Trajectory& a, const Trajectory& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].stamp, b[i].stamp);
    ASSERT_EQ(bitsOf(a[i].pose), bitsOf(b[i].pose)) << i;
  }
}

const char kTum[] =
    "# a comment\n"
    "1305031098.6659 1.3563 0.6305 1.6380 0.6132 0.5962 -0.3311 -0.3986\n"
    "1305031098.6758 1.3543 0.6306 1.6360 0.6129 0.5966 -0.3316 -0.3980\n";
const char kEuroc[] =
    "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y []\n"
    "1403715273262142976,0.878895,2.1834,0.948427,0.069433,-0.824237,-0.106942,-0.551702\n";
const char kKitti[] =
    "1 0 0 0.5 0 1 0 -0.25 0 0 1 2\n"
    "0 -1 0 1 1 0 0 2 0 0 1 3\n";

TEST(TrajectoryFile, TumHasSecondsAndEndsWithW) {
  const Trajectory t = read(kTum);
  ASSERT_EQ(t.size(), 2U);
  EXPECT_EQ(t[0].stamp, 1305031098665900000);
  EXPECT_EQ(t[1].stamp, 1305031098675800000);
  EXPECT_EQ(t[1].pose.translation(), (gslam::Vec3d{1.3543, 0.6306, 1.6360}));
  EXPECT_NEAR(t[1].pose.rotation().x(), 0.6129, 1e-4);
  EXPECT_NEAR(t[1].pose.rotation().w(), -0.3980, 1e-4);
}

TEST(TrajectoryFile, EurocHasNanosecondsAndBeginsWithW) {
  const Trajectory t = read(kEuroc);
  ASSERT_EQ(t.size(), 1U);
  EXPECT_EQ(t[0].stamp, 1403715273262142976);
  EXPECT_NEAR(t[0].pose.rotation().w(), 0.069433, 1e-5);
  EXPECT_NEAR(t[0].pose.rotation().x(), -0.824237, 1e-5);
  EXPECT_NEAR(t[0].pose.rotation().z(), -0.551702, 1e-5);
  EXPECT_EQ(t[0].pose.translation()[2], 0.948427);
}

TEST(TrajectoryFile, KittiHasRowsOfAMatrixAndNoStamps) {
  const Trajectory t = read(kKitti);
  ASSERT_EQ(t.size(), 2U);
  EXPECT_EQ(t[0].stamp, 0);
  EXPECT_EQ(t[1].stamp, 1);  // the number of the frame
  EXPECT_EQ(t[1].pose.translation(), (gslam::Vec3d{1, 2, 3}));
  EXPECT_LE((t[1].pose.rotation() * gslam::Vec3d{1, 0, 0} - gslam::Vec3d{0, 1, 0}).norm(), 1e-15);
}

TEST(TrajectoryFile, TumAndEurocComeBackToTheBit) {
  const Trajectory t = drawnTrajectory(2000, 1);
  for (const TrajectoryFormat format : {TrajectoryFormat::tum, TrajectoryFormat::euroc}) {
    expectSame(read(printTrajectory(t, format), format), t);
  }
}

TEST(TrajectoryFile, KittiComesBackToRounding) {
  const Trajectory t = drawnTrajectory(500, 2);
  const Trajectory again = read(printTrajectory(t, TrajectoryFormat::kitti));
  ASSERT_EQ(again.size(), t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    ASSERT_EQ(again[i].pose.translation(), t[i].pose.translation());
    ASSERT_TRUE(again[i].pose.rotation().isApprox(t[i].pose.rotation(), 4e-15));
  }
}

TEST(TrajectoryFile, TheFormatIsFound) {
  EXPECT_EQ(gslam::detectTrajectoryFormat(kTum, ""), TrajectoryFormat::tum);
  EXPECT_EQ(gslam::detectTrajectoryFormat(kEuroc, ""), TrajectoryFormat::euroc);
  EXPECT_EQ(gslam::detectTrajectoryFormat(kKitti, ""), TrajectoryFormat::kitti);
  const auto of = [](const std::string& line) { return gslam::detectTrajectoryFormat(line, ""); };
  EXPECT_EQ(of("1403715273.26,0,0,0,0,0,0,1"), TrajectoryFormat::tum);  // commas, but seconds
  EXPECT_EQ(of("0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0"), TrajectoryFormat::euroc);
  EXPECT_EQ(of("0,0,0,0,1,0,0,0,0,0,0,"), TrajectoryFormat::euroc);  // VINS-Mono's
  EXPECT_EQ(of("#timestamp [ns],p\n0,0,0,0,1,0,0,0"), TrajectoryFormat::euroc);
  EXPECT_EQ(of("#time(ns),p\n0,0,0,0,1,0,0,0"), TrajectoryFormat::euroc);
  EXPECT_THAT(trajectoryProblem("0,0,0,0,1,0,0,0"),
              AllOf(StartsWith("poses.txt:1:1: "), HasSubstr("TUM"), HasSubstr("EuRoC"),
                    HasSubstr("say which")));
  EXPECT_EQ(of("1403715273262142976,0,0,0,1,0,0,0,0,0,0,0"), TrajectoryFormat::euroc);
  EXPECT_EQ(of("1,0,0,0,0,1,0,0,0,0,1,0"), TrajectoryFormat::kitti);
  EXPECT_THAT(trajectoryProblem("1 2 3"),
              HasSubstr("the line has 3 numbers, expected a line of TUM"));
  EXPECT_THAT(trajectoryProblem("\n# x\n  1\n"),
              StartsWith("poses.txt:3:3: the line has 1 number, "));
  EXPECT_THAT(trajectoryProblem("hello world"), HasSubstr("'hello', expected a finite number"));
}

TEST(TrajectoryFile, EightNumbersWithCommasAreNotGuessedWhereTumHasNanoseconds) {
  TrajectoryFileOptions options;
  options.tum_stamps = StampUnit::nanoseconds;
  const std::string line = "1403715273262142976,0,0,0,1,0,0,0\n";
  for (const std::string& text : {line, "#timestamp [ns],p\n" + line}) {
    EXPECT_THAT(problemWhen([&] { parseTrajectory(text, "poses.txt", options); }),
                AllOf(HasSubstr("TUM in nanoseconds"), HasSubstr("say which format")));
  }
  for (const TrajectoryFormat format : {TrajectoryFormat::tum, TrajectoryFormat::euroc}) {
    options.format = format;
    const Trajectory t = parseTrajectory(line, "poses.txt", options);
    EXPECT_EQ(t.front().stamp, 1403715273262142976);
    EXPECT_EQ(t.front().pose.rotation().w(), format == TrajectoryFormat::euroc ? 1 : 0);
  }
}

TEST(TrajectoryFile, FormsOfTextAreTaken) {
  const Trajectory expected = read("1.5 1 2 3 0 0 0 1\n2.5 4 5 6 0 0 1 0\n");
  for (const char* text :
       {"1.5 1 2 3 0 0 0 1\r\n2.5 4 5 6 0 0 1 0\r\n",                   // Windows
        "1.5 1 2 3 0 0 0 1\n2.5 4 5 6 0 0 1 0",                         // no end
        "1.5\t1\t2\t3\t0\t0\t0\t1\n\n \t\r\n2.5 4 5 6 0 0 1 0 \t\n\n",  // tabs and blank lines
        "1.5,1,2,3,0,0,0,1\n2.5, 4, 5, 6, 0, 0, 1, 0,\n",               // commas
        "# c\n 1.5 1 2 3 0 0 0 1 # c\n#\n  # 9 9\n2.5 4 5 6 0 0 1 0#\n",
        "2.5 4 5 6 0 0 1 0\n1.5 1 2 3 0 0 0 1\n",             // not by stamp
        "+1.5 1. +2 3e0 -0 .0 00 01\n2.5 4.0 5 6 0 0 1 0\n",  // numbers that JSON does not have
        "1.5E0 1 2 0.3e1 0 0 0 1\n2500e-3 40e-1 5 6 0 0 1.000 0\n"}) {
    SCOPED_TRACE(text);
    const Trajectory t = read(text, TrajectoryFormat::tum);
    ASSERT_EQ(t.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(t[i].stamp, expected[i].stamp);
      EXPECT_EQ(t[i].pose.translation(), expected[i].pose.translation());
      EXPECT_EQ(t[i].pose.rotation().w(), expected[i].pose.rotation().w());
    }
  }
}

TEST(TrajectoryFile, AByteOrderMarkIsPassedOver) {
  EXPECT_EQ(read("\xEF\xBB\xBF" + std::string("1.5 1 2 3 0 0 0 1")).front().stamp, 1500000000);
  EXPECT_THAT(trajectoryProblem("\xEF\xBB\xBF" + std::string("x")), StartsWith("poses.txt:1:1: "));
}

TEST(TrajectoryFile, ErrorsNamePlaceFindingAndExpectation) {
  const auto tum = [](const std::string& text) {
    return trajectoryProblem(text, TrajectoryFormat::tum);
  };
  const std::string good = "1 0 0 0 0 0 0 1\n";
  EXPECT_EQ(
      tum(good + "2 0 0 0 0 0 0\n"),
      "poses.txt:2:14: the line ends after 7 numbers, expected timestamp tx ty tz qx qy qz qw "
      "(TUM)");
  EXPECT_EQ(
      tum(good + "2 0 0 0 0 0 0 1 5\n"),
      "poses.txt:2:17: the line goes on after 8 numbers with '5', expected timestamp tx ty tz qx "
      "qy qz qw (TUM)");
  EXPECT_EQ(tum(good + "\n2 0 1x 0 0 0 0 1\n"),
            "poses.txt:3:5: ty is '1x', expected a finite number");
  EXPECT_EQ(tum("2 0 nan 0 0 0 0 1"), "poses.txt:1:5: ty is 'nan', expected a finite number");
  EXPECT_EQ(tum("2 0 -inf 0 0 0 0 1"), "poses.txt:1:5: ty is '-inf', expected a finite number");
  EXPECT_EQ(tum("2 0 1e999 0 0 0 0 1"), "poses.txt:1:5: ty is '1e999', too large for a double");
  EXPECT_THAT(tum("2 0 0 0 0 0 0 0"),
              StartsWith("poses.txt:1:9: the quaternion has the norm 0, expected 1 within 0.02"));
  EXPECT_THAT(tum("2 0 0 0 0 0 0 1.03"), HasSubstr("norm 1.03"));
  EXPECT_THAT(tum("2,,0 0 0 0 0 0 1"),
              StartsWith("poses.txt:1:3: nothing stands before this comma"));
  EXPECT_THAT(tum(",2 0 0 0 0 0 0 1"),
              StartsWith("poses.txt:1:1: nothing stands before this comma"));
  EXPECT_THAT(tum("x 0 0 0 0 0 0 1"), HasSubstr("'x' is no number, expected a stamp in seconds"));
  EXPECT_THAT(tum(std::string("1 0 \0 0 0 0 0 1", 15)), HasSubstr("'\\x00'"));
  EXPECT_THAT(tum("\xFF\xFE"
                  "1"),
              HasSubstr("UTF-16"));
  EXPECT_THAT(tum(std::string(1000000, '7')), HasSubstr("7777..."));
  EXPECT_EQ(tum("# nothing\n"),
            "poses.txt: has no poses, expected timestamp tx ty tz qx qy qz qw (TUM)");
  EXPECT_THAT(trajectoryProblem(""), StartsWith("poses.txt: has no poses, expected a line of TUM"));
  for (const char* bad : {"+", "-", ".", "-.", "1e", "1e+", "+-1", "0x1", "1.2.3", "1,", "--1",
                          "+nan", "1_0", "\xC2\xA0"}) {
    EXPECT_THAT(tum(std::string("1 0 ") + bad + " 0 0 0 0 1 1"),
                testing::AnyOf(StartsWith("poses.txt:1:5: ty is"), HasSubstr("goes on")))
        << bad;
  }
}

TEST(TrajectoryFile, ErrorsOfKittiAndEuroc) {
  EXPECT_THAT(trajectoryProblem("1 0 0 0 0 1 0 0 0 0 1.1 0\n"),
              AllOf(StartsWith("poses.txt:1:1: the matrix is 0.1"), HasSubstr("at most 0.001")));
  EXPECT_THAT(trajectoryProblem("1 0 0 0 0 1 0 0 0 0 -1 0\n"),
              HasSubstr("the matrix is 2"));  // reflection
  EXPECT_THAT(trajectoryProblem("0 0 0 0 0 0 0 0 0 0 0 0\n"), HasSubstr("the matrix is"));
  EXPECT_THAT(trajectoryProblem(std::string(kKitti) + "1 0 0\n"),
              StartsWith("poses.txt:3:6: the line ends"));
  EXPECT_THAT(trajectoryProblem("0,0,0,0,1,0,0,0,7\n1,0,0,0,1,0,0,0\n"),
              HasSubstr("2:16: the line has 8 numbers, the first one 9"));
  EXPECT_THAT(trajectoryProblem("0,0,0,0,1,0,0,0,x\n"), HasSubstr("'x', expected a finite number"));
  EXPECT_THAT(trajectoryProblem("1403715273.26,0,0,0,1,0,0,0\n", TrajectoryFormat::euroc),
              HasSubstr("is no whole number of nanoseconds; is it in seconds?"));
  EXPECT_EQ(read("1403715273262142976.0,0,0,0,1,0,0,0\n").front().stamp, 1403715273262142976);
}

TEST(TrajectoryFile, NanosecondsForSecondsAreRecognised) {
  const std::string orb_slam3 = "1403636579763555584.000000 0 0 0 0 0 0 1\n";
  EXPECT_THAT(trajectoryProblem(orb_slam3),
              AllOf(StartsWith("poses.txt:1:1: '1403636579763555584.000000' "),
                    HasSubstr("is it in nanoseconds?")));
  TrajectoryFileOptions options;
  options.tum_stamps = StampUnit::nanoseconds;
  EXPECT_EQ(parseTrajectory(orb_slam3, "", options).front().stamp, 1403636579763555584);
  EXPECT_THAT(trajectoryProblem("1403636579763 0 0 0 0 0 0 1\n"),
              HasSubstr("is it in milliseconds?"));
}

TEST(TrajectoryFile, AStampTwiceIsRefusedWithBothLines) {
  const std::string text = "3 1 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n# c\n3.000 3 0 0 0 0 0 1\n";
  EXPECT_EQ(trajectoryProblem(text),
            "poses.txt:4:1: has the stamp 3.000000000 s, as line 1 has, expected each stamp once");
  TrajectoryFileOptions options;
  options.duplicates = DuplicateStamps::keep_first;
  const Trajectory first = parseTrajectory(text, "", options);
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[1].pose.translation()[0], 1);
  options.duplicates = DuplicateStamps::keep_last;
  const Trajectory last = parseTrajectory(text, "", options);
  ASSERT_EQ(last.size(), 2U);
  EXPECT_EQ(last[0].pose.translation()[0], 2);
  EXPECT_EQ(last[1].pose.translation()[0], 3);
}

TEST(TrajectoryFile, MayBeEmptyWhereThatIsSaid) {
  TrajectoryFileOptions options;
  options.may_be_empty = true;
  for (const TrajectoryFormat format : {TrajectoryFormat::any, TrajectoryFormat::tum,
                                        TrajectoryFormat::kitti, TrajectoryFormat::euroc}) {
    options.format = format;
    const TrajectoryFormat written =
        format == TrajectoryFormat::any ? TrajectoryFormat::tum : format;
    EXPECT_TRUE(parseTrajectory(printTrajectory(Trajectory(), written), "", options).empty());
    EXPECT_TRUE(parseTrajectory("", "", options).empty());
  }
}

TEST(TrajectoryFile, RoundedMatricesBecomeRotations) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    const SE3d pose = gslam::randomOf<SE3d>(random);
    const auto m = pose.matrix();
    char line[512];
    std::snprintf(line, sizeof line, "%.6e %.6e %.6e %.6e %.6e %.6e %.6e %.6e %.6e %.6e %.6e %.6e",
                  m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3), m(2, 0),
                  m(2, 1), m(2, 2), m(2, 3));
    const SE3d again = read(line).front().pose;
    ASSERT_TRUE(again.rotation().isApprox(pose.rotation(), 1e-6));
    ASSERT_NEAR(again.rotation().quaternion().norm(), 1, 1e-15);
  }
}

TEST(TrajectoryFile, WhatIsNotFiniteIsNotWritten) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Trajectory t({{7, SE3d(SO3d(), {{0, nan, 0}})}});
  for (const TrajectoryFormat format :
       {TrajectoryFormat::tum, TrajectoryFormat::kitti, TrajectoryFormat::euroc}) {
    EXPECT_THAT(problemWhen([&] { printTrajectory(t, format); }), HasSubstr("not finite at 7 ns"));
  }
  EXPECT_THROW(printTrajectory(t, TrajectoryFormat::any), gslam::ArgumentError);
}

// A prefix of a file is some of its poses, perhaps the last of them with a number cut short.
TEST(TrajectoryFile, AFileCutAnywhereIsReadOrRefused) {
  for (const TrajectoryFormat format :
       {TrajectoryFormat::tum, TrajectoryFormat::kitti, TrajectoryFormat::euroc}) {
    const std::string whole = printTrajectory(drawnTrajectory(5, 4), format);
    const Trajectory poses = read(whole, format);
    for (std::size_t size = 0; size <= whole.size(); ++size) {
      try {
        const Trajectory part = read(whole.substr(0, size), format);
        ASSERT_LE(part.size(), poses.size());
        for (std::size_t i = 0; i + 1 < part.size(); ++i) ASSERT_EQ(part[i].stamp, poses[i].stamp);
      } catch (const gslam::ParseError& error) {
        ASSERT_THAT(error.what(), StartsWith("poses.txt:"));
      }
    }
  }
}

TEST(TrajectoryFile, AnyFlippedBitIsReadOrRefused) {
  for (const char* text : {kTum, kEuroc, kKitti}) {
    std::string flipped = text;
    for (std::size_t i = 0; i < 8 * flipped.size(); ++i) {
      flipped[i / 8] = static_cast<char>(flipped[i / 8] ^ (1 << i % 8));
      try {
        for (const StampedPose& p : read(flipped)) {
          ASSERT_NEAR(p.pose.rotation().quaternion().norm(), 1, 1e-15);
        }
      } catch (const gslam::ParseError&) {
      }
      flipped[i / 8] = static_cast<char>(flipped[i / 8] ^ (1 << i % 8));
    }
  }
}

struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(TrajectoryFile, TheLocaleChangesNothing) {
  const Trajectory t = drawnTrajectory(20, 5);
  const std::string text = printTrajectory(t);
  const std::string old_c = std::setlocale(LC_ALL, nullptr);
  const std::locale old = std::locale::global(std::locale(std::locale(), new CommaPoint));
  (void)std::setlocale(LC_ALL, "de_DE.UTF-8");  // where there is one
  std::ostringstream out;
  gslam::writeTrajectory(out, t);
  std::istringstream in(text);
  const Trajectory again = gslam::readTrajectory(in, "stream");
  std::locale::global(old);
  (void)std::setlocale(LC_ALL, old_c.c_str());
  EXPECT_EQ(out.str(), text);
  expectSame(again, t);
}

class OnDisk : public testing::Test {
 protected:
  std::string path(const std::string& name) {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    paths_.push_back(testing::TempDir() + "gslam_trajectory_" + test->name() + "_" + name);
    return paths_.back();
  }
  ~OnDisk() override {
    for (const std::string& path : paths_) std::remove(path.c_str());
  }

 private:
  std::vector<std::string> paths_;
};

TEST_F(OnDisk, FilesComeBack) {
  const Trajectory t = drawnTrajectory(100, 6);
  const std::string file = path("any");
  for (const TrajectoryFormat format : {TrajectoryFormat::tum, TrajectoryFormat::euroc}) {
    gslam::writeTrajectory(file, t, format);
    TrajectoryFileOptions options;
    options.format = format;
    expectSame(gslam::readTrajectory(file, options), t);
  }
  expectSame(gslam::readEurocTrajectory(file), t);
  EXPECT_THAT(problemWhen([&] { gslam::readTumTrajectory(file); }), StartsWith(file + ":"));
  gslam::writeTrajectory(file, t);
  expectSame(gslam::readTumTrajectory(file), t);
  std::ifstream left_over(file + ".0.tmp");
  EXPECT_FALSE(left_over.is_open());
}

TEST_F(OnDisk, ALinkStaysOneAndADeviceToo) {
  const Trajectory t = drawnTrajectory(10, 6);
  const std::string file = path("file"), link = path("link");
  gslam::writeTrajectory(file, Trajectory());
  ASSERT_EQ(::symlink(file.c_str(), link.c_str()), 0);
  gslam::writeTrajectory(link, t);
  expectSame(gslam::readTumTrajectory(file), t);
  gslam::writeStamps(link, t);
  EXPECT_EQ(gslam::readStamps(file).size(), t.size());
  EXPECT_NO_THROW(gslam::writeTrajectory("/dev/null", t));
  EXPECT_TRUE(std::ifstream("/dev/null"));
}

TEST_F(OnDisk, KittiGetsItsTimesFromTheOtherFile) {
  const Trajectory t = drawnTrajectory(100, 7);
  const std::string poses = path("poses"), times = path("times");
  gslam::writeTrajectory(poses, t, TrajectoryFormat::kitti);
  gslam::writeStamps(times, t);
  const Trajectory again = gslam::readKittiTrajectory(poses, times);
  ASSERT_EQ(again.size(), t.size());
  for (std::size_t i = 0; i < t.size(); ++i) ASSERT_EQ(again[i].stamp, t[i].stamp);
  std::vector<std::int64_t> stamps = gslam::readStamps(times);
  EXPECT_EQ(stamps.size(), t.size());
  std::swap(stamps[3], stamps[4]);
  EXPECT_EQ(gslam::readKittiTrajectory(poses, stamps).size(), t.size());
  stamps.pop_back();
  EXPECT_THAT(problemWhen([&] { gslam::readKittiTrajectory(poses, stamps); }),
              HasSubstr("has 100 poses, but the caller has 99 times, expected as many"));
}

TEST_F(OnDisk, FilesThatAreNotThereOrCannotBeMadeAreNamed) {
  const std::string file = path("missing") + "/poses.txt";
  EXPECT_THAT(problemWhen([&] { gslam::readTrajectory(file); }),
              StartsWith(file + ": cannot be opened"));
  EXPECT_THAT(problemWhen([&] { gslam::writeTrajectory(file, Trajectory()); }),
              StartsWith(file + ": cannot be written"));
  EXPECT_THAT(problemWhen([&] { gslam::readKittiTrajectory(file, file); }), StartsWith(file));
  EXPECT_THROW(gslam::readTrajectory(testing::TempDir()), gslam::FileError);
}

TEST(TrajectoryFile, AStreamThatFailsIsSaid) {
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  EXPECT_THROW(gslam::writeTrajectory(out, Trajectory()), gslam::FileError);
  EXPECT_STREQ(gslam::trajectoryFormatName(TrajectoryFormat::kitti), "kitti");
  EXPECT_STREQ(gslam::trajectoryFormatName(static_cast<TrajectoryFormat>(77)), "unknown");
}

}  // namespace
