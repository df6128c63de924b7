#include "options.h"

#include <gslam/optimizer_pba.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "visual_slam.h"

namespace {

using gslam::Svar;
using visual::defaultParameters;
using visual::Options;
using visual::readOptions;

std::string refusalOf(const std::string& name, const Svar& value) {
  Svar parameters = defaultParameters();
  parameters.set(name, value);
  try {
    readOptions(parameters);
  } catch (const gslam::Error& error) {
    return error.what();
  }
  return "";
}

TEST(Options, DefaultsAreThoseOfTheStructures) {
  const Options read = readOptions(defaultParameters()), standard;
  EXPECT_EQ(read.sensor, standard.sensor);
  EXPECT_EQ(read.threaded, standard.threaded);
  EXPECT_EQ(read.workers, standard.workers);
  EXPECT_EQ(read.features.count, standard.features.count);
  EXPECT_EQ(read.features.scale, standard.features.scale);
  EXPECT_EQ(read.tracking.window, standard.tracking.window);
  EXPECT_EQ(read.tracking.most_gap, standard.tracking.most_gap);
  EXPECT_EQ(read.mapping.window, standard.mapping.window);
  EXPECT_EQ(read.mapping.far_baselines, standard.mapping.far_baselines);
  EXPECT_EQ(read.loop.enabled, standard.loop.enabled);
  EXPECT_EQ(read.loop.consistent, standard.loop.consistent);
}

// Each parameter set to something else is read as something else.
TEST(Options, EveryParameterIsRead) {
  Svar p = Svar::object({{"sensor", "mono"},    {"threaded", true},      {"workers", 3},
                         {"seed", 9},           {"depth_baseline", 0.2}, {"detector", "sift"},
                         {"features", 777},     {"scale", 1.3},          {"levels", 5},
                         {"corner", 30},        {"least_corner", 9},     {"window", 11.0},
                         {"least_inliers", 33}, {"keyframe_ratio", 0.6}, {"keyframe_gap", 2},
                         {"most_gap", 44},      {"backend", "pba"},      {"neighbours", 6},
                         {"bundle", 8},         {"far_baselines", 50.0}, {"loops", false},
                         {"adjust_all", false}, {"vocabulary", "words"}, {"loop_matches", 55},
                         {"loop_consistent", 4}});
  ASSERT_EQ(p.size(), defaultParameters().size());
  const Options o = readOptions(gslam::completeParameters(defaultParameters(), p));
  EXPECT_EQ(o.sensor, "mono");
  EXPECT_TRUE(o.threaded);
  EXPECT_EQ(o.workers, 3);
  EXPECT_EQ(o.seed, 9U);
  EXPECT_EQ(o.depth_baseline, 0.2);
  EXPECT_EQ(o.features.detector, "sift");
  EXPECT_EQ(o.features.count, 777);
  EXPECT_EQ(o.features.scale, 1.3);
  EXPECT_EQ(o.features.levels, 5);
  EXPECT_EQ(o.features.threshold, 30);
  EXPECT_EQ(o.features.least_threshold, 9);
  EXPECT_EQ(o.tracking.window, 11);
  EXPECT_EQ(o.tracking.least_inliers, 33);
  EXPECT_EQ(o.tracking.keyframe_ratio, 0.6);
  EXPECT_EQ(o.tracking.keyframe_gap, 2);
  EXPECT_EQ(o.tracking.most_gap, 44);
  EXPECT_EQ(o.mapping.backend, "pba");
  EXPECT_EQ(o.mapping.neighbours, 6);
  EXPECT_EQ(o.mapping.window, 8);
  EXPECT_EQ(o.mapping.far_baselines, 50);
  EXPECT_FALSE(o.loop.enabled);
  EXPECT_FALSE(o.loop.adjust_all);
  EXPECT_EQ(o.loop.vocabulary, "words");
  EXPECT_EQ(o.loop.least_matches, 55);
  EXPECT_EQ(o.loop.consistent, 4);
}

TEST(Options, NamesEveryParameterThatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::vector<Svar>>> wrong = {
      {"sensor", {"lidar", "", 3}},
      {"threaded", {"perhaps"}},
      {"workers", {-1, 1000, "many"}},
      {"seed", {-1}},
      {"depth_baseline", {0.0, -0.1, 100.0, nan}},
      {"detector", {5}},
      {"features", {0, -5, 1000000}},
      {"scale", {1.0, 0.5, 3.0, nan}},
      {"levels", {0, 17}},
      {"corner", {0, 300}},
      {"least_corner", {0, 21}},
      {"window", {0.0, 1e6, nan}},
      {"least_inliers", {3, 100000}},
      {"keyframe_ratio", {0.0, 1.5, nan}},
      {"keyframe_gap", {-1}},
      {"most_gap", {0}},
      {"backend", {"gtsam", 1}},
      {"neighbours", {0, 1000}},
      {"bundle", {1, 10000}},
      {"far_baselines", {0.0, nan}},
      {"loops", {"yes"}},
      {"adjust_all", {"no"}},
      {"vocabulary", {1}},
      {"loop_matches", {2}},
      {"loop_consistent", {0}},
  };
  EXPECT_EQ(wrong.size(), defaultParameters().size());
  for (const auto& parameter : wrong) {
    for (const Svar& value : parameter.second) {
      const std::string refusal = refusalOf(parameter.first, value);
      EXPECT_NE(refusal.find(parameter.first), std::string::npos)
          << parameter.first << ": \"" << refusal << '"';
    }
  }
  EXPECT_NE(refusalOf("sensor", "lidar").find("mono, stereo, rgbd"), std::string::npos);
  EXPECT_NE(refusalOf("backend", "gtsam").find("pba"), std::string::npos);
}

TEST(Options, ThePluginHasTheSame) {
  const gslam::SlamFactory factory = visual::visualFactory();
  EXPECT_EQ(factory.parameters, defaultParameters());
  EXPECT_EQ(factory.help.size(), factory.parameters.size());
  for (const Svar::Member& parameter : factory.parameters.members()) {
    EXPECT_GT(factory.help.get<std::string>(parameter.first, "").size(), 4U) << parameter.first;
  }
  EXPECT_EQ(factory.name, "visual");
  EXPECT_FALSE(factory.description.empty());
}

// The names in the first column of the table, as `a`, `b`.
std::vector<std::string> namesInReadme() {
  std::ifstream file(std::string(GSLAM_VISUAL_SOURCE) + "/README.md");
  std::vector<std::string> names;
  bool is_in_table = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("| parameter |", 0) == 0) is_in_table = true;
    if (!is_in_table || line.rfind("| `", 0) != 0) continue;
    const std::string column = line.substr(0, line.find('|', 1));
    for (std::size_t at = column.find('`'); at != std::string::npos;
         at = column.find('`', at + 1)) {
      const std::size_t end = column.find('`', at + 1);
      names.push_back(column.substr(at + 1, end - at - 1));
      at = end;
    }
  }
  return names;
}

TEST(Options, TheReadmeHasThemAll) {
  std::vector<std::string> names = namesInReadme(), expected;
  const Svar defaults = defaultParameters();
  for (const Svar::Member& member : defaults.members()) expected.push_back(member.first);
  std::sort(names.begin(), names.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(names, expected);
}

}  // namespace
