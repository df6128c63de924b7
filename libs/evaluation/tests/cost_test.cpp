#include <gslam/evaluation/cost.h>
#include <gslam/svar/json.h>
#include <gtest/gtest.h>

#include <numeric>

#include "spender_child.h"

namespace {

using gslam::Cost;
using gslam::CostSource;
using gslam::FrameTime;
using gslam::Svar;

std::vector<FrameTime> hundredFrames() {
  std::vector<FrameTime> frames;
  for (int i = 1; i <= 100; ++i) {
    FrameTime f;
    f.frame = std::uint64_t(i);
    f.delivered = i * 10000000LL;
    f.has_result = i != 100;
    f.wall_ms = f.has_result ? i : 0;
    f.feed_ms = 2;
    f.cpu_ms = 0.5 * i;
    f.cpu_ms_before = 1000.0 * i;  // others use more
    f.has_allocations = true;
    f.allocations = std::uint64_t(i);
    f.allocated_bytes = 10 * std::uint64_t(i);
    f.allocations_before = 2000 * std::uint64_t(i);
    f.allocated_bytes_before = 2000 * std::uint64_t(i);
    frames.push_back(f);
  }
  FrameTime dropped;
  dropped.is_dropped = true;
  dropped.delivered = 5000000000;
  frames.push_back(dropped);
  return frames;
}

CostSource source() {
  CostSource source;
  source.frames = hundredFrames();
  source.resources.seconds = 2;
  source.resources.used.cpu_seconds = 3;
  source.resources.used.voluntary_switches = 11;
  source.resources.used.major_faults = 4;
  source.resources.cpu_percent = 150;
  source.resources.peak_rss_bytes = 123000000;
  source.resources.core_percent = {100, 50};
  source.resources.energy.package_joules = 20;
  source.resources.gpu.why_not = "no GPU tells its load";
  source.resources.overhead_percent = 0.25;
  source.allocations.is_counted = true;
  source.allocations.calls = 5050;
  source.allocations.peak_live_bytes = 77000000;
  return source;
}

TEST(Cost, sumsUpFrames) {
  const Cost cost = gslam::costOf(source());
  EXPECT_EQ(cost.delivered, 100u);
  EXPECT_EQ(cost.results, 99u);
  EXPECT_EQ(cost.dropped, 1u);
  EXPECT_NEAR(cost.frame_ms.median, 50, 1e-9);
  EXPECT_NEAR(cost.frame_ms.max, 99, 1e-9);
  EXPECT_NEAR(cost.frame_ms.p95, 1 + 0.95 * 98, 1e-9);
  EXPECT_NEAR(cost.cpu_ms.mean, 0.5 * 50.5, 1e-9);
  EXPECT_NEAR(cost.feed_ms.std, 0, 1e-9);
  EXPECT_NEAR(cost.allocations_per_frame, 50.5, 1e-9);
  EXPECT_NEAR(cost.allocated_bytes_per_frame, 505, 1e-9);
  EXPECT_NEAR(cost.cpu_ms_per_frame, 0.5 * 50.5, 1e-9);
  EXPECT_EQ(cost.overlapping, 0u);
  // From 0.01 s to the pose of frame 99, 0.99 + 0.099 s; a dropped frame has no time.
  EXPECT_NEAR(cost.span_seconds, 1.089 - 0.01, 1e-9);
  EXPECT_NEAR(cost.frames_per_second, 100 / 1.079, 1e-9);
}

// Two frames overlap with a third; a fourth is alone. What belongs to several counts once.
TEST(Cost, countsWhatFramesShareOnce) {
  const double spans[][2] = {{100, 50}, {120, 10}, {140, 40}, {500, 5}};
  CostSource made;
  made.allocations.is_counted = true;
  for (const auto& span : spans) {
    FrameTime f;
    f.has_allocations = true;
    f.cpu_ms_before = span[0];
    f.cpu_ms = span[1];
    f.allocations_before = std::uint64_t(span[0]);
    f.allocations = std::uint64_t(span[1]);
    f.allocated_bytes_before = 10 * f.allocations_before;
    f.allocated_bytes = 10 * f.allocations;
    made.frames.insert(made.frames.begin(), f);  // in any order
  }
  const Cost cost = gslam::costOf(made);
  EXPECT_NEAR(cost.cpu_ms_per_frame, 85.0 / 4, 1e-9);
  EXPECT_NEAR(cost.allocations_per_frame, 85.0 / 4, 1e-9);
  EXPECT_NEAR(cost.allocated_bytes_per_frame, 850.0 / 4, 1e-9);
  EXPECT_EQ(cost.overlapping, 2u);
  EXPECT_EQ(gslam::costToSvar(cost)["frames"]["overlapping"].as<int>(), 2);
  EXPECT_NE(gslam::costText(cost).find("21.250 ms a frame"), std::string::npos);
}

TEST(Cost, becomesJson) {
  const Svar json = gslam::parseJson(gslam::printJson(gslam::costToSvar(gslam::costOf(source()))));
  EXPECT_EQ(json["measured"].as<std::string>(), "process");
  EXPECT_NEAR(json["frame_ms"]["median"].as<double>(), 50, 1e-9);
  EXPECT_NEAR(json["frame_ms"]["p95"].as<double>(), 94.1, 1e-9);
  EXPECT_NEAR(json["frame_ms"]["max"].as<double>(), 99, 1e-9);
  EXPECT_EQ(json["frames"]["dropped"].as<int>(), 1);
  EXPECT_NEAR(json["peak_rss_mb"].as<double>(), 123, 1e-9);
  EXPECT_NEAR(json["cpu_percent"].as<double>(), 150, 1e-9);
  EXPECT_NEAR(json["allocations_per_frame"].as<double>(), 50.5, 1e-9);
  EXPECT_EQ(json["allocations"]["calls"].as<int>(), 5050);
  EXPECT_FALSE(json["allocations"].contains("live_mb"));  // which is not of the run
  EXPECT_NEAR(json["heap"]["peak_mb"].as<double>(), 77, 1e-9);
  EXPECT_NEAR(json["cpu_ms_per_frame"].as<double>(), 25.25, 1e-9);
  EXPECT_EQ(json["core_percent"].size(), 2u);
  EXPECT_EQ(json["voluntary_switches"].as<int>(), 11);
  EXPECT_EQ(json["major_faults"].as<int>(), 4);
  EXPECT_NEAR(json["energy"]["package_j"].as<double>(), 20, 1e-9);
  EXPECT_NEAR(json["energy"]["package_w"].as<double>(), 10, 1e-9);
  EXPECT_TRUE(json["energy"]["dram_j"].isNull());
  EXPECT_TRUE(json["gpu"].isNull());
  EXPECT_EQ(json["why_no_gpu"].as<std::string>(), "no GPU tells its load");
  EXPECT_FALSE(json.contains("why_no_energy"));
  EXPECT_FALSE(json.contains("why_no_allocations"));
  EXPECT_NEAR(json["sampling"]["overhead_percent"].as<double>(), 0.25, 1e-9);
}

TEST(Cost, saysWhatIsNotKnown) {
  CostSource nothing;
  nothing.is_slam_alone = true;
  const Cost cost = gslam::costOf(nothing);
  const Svar json = gslam::parseJson(gslam::printJson(gslam::costToSvar(cost)));
  EXPECT_EQ(json["measured"].as<std::string>(), "slam");
  for (const char* name :
       {"frames_per_second", "peak_rss_mb", "cpu_percent", "energy", "gpu", "allocations", "heap",
        "cpu_ms_per_frame", "allocations_per_frame", "core_percent", "sampling"}) {
    EXPECT_TRUE(json.contains(name)) << name;
    EXPECT_TRUE(json[name].isNull()) << name;
  }
  EXPECT_TRUE(json["frame_ms"]["median"].isNull());
  EXPECT_EQ(json["frame_ms"]["count"].as<int>(), 0);
  for (const char* name :
       {"why_no_resources", "why_no_energy", "why_no_gpu", "why_no_allocations"}) {
    EXPECT_FALSE(json[name].as<std::string>().empty()) << name;
  }
  const std::string text = gslam::costText(cost);
  EXPECT_NE(text.find("none: they were not measured"), std::string::npos);
  EXPECT_NE(text.find("none: no frame has it"), std::string::npos);
  EXPECT_NE(text.find("SLAM system alone"), std::string::npos);
}

TEST(Cost, becomesAText) {
  CostSource made = source();
  made.resources.gpu.why_not = std::string(1000, 'x');  // of any length
  const std::string text = gslam::costText(gslam::costOf(made));
  for (const char* part : {"100 given, 99 with a pose, 1 dropped", "most 123.0 MB", "150.0 %",
                           "11 voluntary", "4 major", "20.0 J", "50.5 of 505 bytes", "94.100"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
  }
  EXPECT_NE(text.find(made.resources.gpu.why_not), std::string::npos);
  made.resources.gpu.why_not = "";
  EXPECT_EQ(gslam::costText(gslam::costOf(made)).find("memory most"), std::string::npos);
  made.resources.gpu.has_memory = true;
  EXPECT_NE(gslam::costText(gslam::costOf(made)).find("memory most 0.0 MB"), std::string::npos);
  EXPECT_EQ(text.back(), '\n');
}

// All of it, of a program whose cost is known.
TEST(Cost, isRightForAProgramOfKnownCost) {
  ASSERT_TRUE(gslam::countAllocationsOfChildren());
  spender::Child child({"burn", "0.3", "2"});
  gslam::ProcessTreeOptions options;
  options.root = child.number();
  const auto tree = std::make_shared<gslam::ProcessTree>(options);
  const gslam::AllocationCounts before = gslam::allocationCountsOf(child.number());
  gslam::ResourceMonitor monitor(tree);
  child.go();
  EXPECT_EQ(child.line(), "done");
  CostSource made;
  made.resources = monitor.stop();
  made.allocations = gslam::allocatedBetween(before, gslam::allocationCountsOf(child.number()));
  made.is_slam_alone = true;
  const Svar json = gslam::costToSvar(gslam::costOf(made));
  EXPECT_NEAR(json["cpu_s"].as<double>(), 0.6, 0.06);
  EXPECT_GE(json["threads"].as<int>(), 3);
  EXPECT_LE(json["threads"].as<int>(), 3 + int(spender::kOtherThreads));
  EXPECT_LE(json["sampling"]["overhead_percent"].as<double>(), 1);
  if (spender::canCount()) {
    EXPECT_LE(json["allocations"]["calls"].as<int>(), 50);
    EXPECT_GE(json["allocations"]["calls"].as<int>(), 2);  // of threads
  }
}

}  // namespace
