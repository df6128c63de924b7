// The types that cross the border between a program and its plugins have the layout that is written
// here, whatever flags they were compiled with; and a plugin that was compiled with others works.
#include <gslam/core/map_check.h>
#include <gslam/core/map_file.h>
#include <gslam/core/plugins.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "toy_frames.h"
#include "toy_map.h"

namespace {

using namespace gslam;  // NOLINT(google-build-using-namespace): most lines name three types of it

// Offsets of types with constructors are no part of C++11, but of all its compilers.
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Winvalid-offsetof"
#endif

// Those without anything of the standard library are the same on all machines.
static_assert(sizeof(SE3d) == 56 && alignof(SE3d) == 8, "");
static_assert(sizeof(Camera) == 16 + 48 * 8 && alignof(Camera) == 8, "");
static_assert(sizeof(ImuSample) == 56 && offsetof(ImuSample, gyro) == 8, "");
static_assert(offsetof(ImuSample, accel) == 32, "");
static_assert(sizeof(ImuCalibration) == 96 && offsetof(ImuCalibration, rate) == 56, "");
static_assert(sizeof(Geodetic) == 24, "");
static_assert(sizeof(GnssSample) == 136 && offsetof(GnssSample, position) == 8, "");
static_assert(offsetof(GnssSample, covariance) == 32 && offsetof(GnssSample, velocity) == 104, "");
static_assert(offsetof(GnssSample, fix) == 128, "");
static_assert(sizeof(TrackedPose) == 80 && offsetof(TrackedPose, stamp) == 8, "");
static_assert(offsetof(TrackedPose, T_world_body) == 16, "");
static_assert(offsetof(TrackedPose, state) == 72, "");
static_assert(sizeof(SensorNeeds) == 8 && offsetof(SensorNeeds, depth) == 4, "");
static_assert(offsetof(SensorNeeds, imu) == 5 && offsetof(SensorNeeds, gnss) == 6, "");
static_assert(offsetof(SensorNeeds, calibration) == 7, "");
static_assert(sizeof(StampedPose) == 64 && offsetof(StampedPose, pose) == 8, "");
static_assert(sizeof(PoseWithCovariance<SE3d>) == 56 + 36 * 8, "");
static_assert(sizeof(ImageKind) == 1 && sizeof(PixelType) == 1 && sizeof(TrackingState) == 1, "");
static_assert(sizeof(GnssFix) == 1 && std::is_trivially_copyable<SE3d>::value, "");
static_assert(sizeof(BuildFacts) == 104 && offsetof(BuildFacts, pointer_size) == 30, "");
static_assert(offsetof(BuildFacts, standard_library) == 32, "");
static_assert(offsetof(BuildFacts, string_abi) == 52 && offsetof(BuildFacts, layout) == 56, "");
static_assert(offsetof(BuildFacts, compiler) == 60, "");

// Records of maps.
static_assert(sizeof(Feature) == 24 && offsetof(Feature, octave) == 20, "");
static_assert(offsetof(Feature, camera) == 22, "");
static_assert(sizeof(Observation) == 8 && offsetof(Observation, feature) == 4, "");
static_assert(sizeof(MapPoint) == 48 && offsetof(MapPoint, normal) == 24, "");
static_assert(offsetof(MapPoint, color) == 36 && offsetof(MapPoint, label) == 40, "");
static_assert(offsetof(MapPoint, kind) == 44, "");
static_assert(sizeof(Shape) == 56 && offsetof(Shape, size) == 32, "");
static_assert(sizeof(PoseEdge) == 368 && offsetof(PoseEdge, T_from_to) == 8, "");
static_assert(offsetof(PoseEdge, scale) == 64 && offsetof(PoseEdge, information) == 72, "");
static_assert(offsetof(PoseEdge, kind) == 360, "");
static_assert(offsetof(Keyframe, stamp) == 8 && offsetof(Keyframe, T_world_body) == 16, "");
static_assert(detail::kChunkSize == 256 && detail::kPageSize == 256, "");
static_assert(sizeof(detail::MapLayout::Place) == 12, "");

// What holds strings and vectors is made of these.
constexpr std::size_t kText = sizeof(std::string), kList = sizeof(std::vector<int>);
constexpr std::size_t kFunction = sizeof(std::function<void()>);
constexpr std::size_t kPointer = sizeof(void*);

#if defined(__LP64__)
static_assert(sizeof(Image) == 48, "");
static_assert(sizeof(CameraImage) == 48 + sizeof(Camera) + 56 + 24 + kText, "");
static_assert(offsetof(CameraImage, camera) == 48, "");
static_assert(offsetof(CameraImage, T_body_camera) == 448, "");
static_assert(offsetof(CameraImage, exposure) == 504, "");
static_assert(offsetof(CameraImage, depth_scale) == 512, "");
static_assert(offsetof(CameraImage, kind) == 520 && offsetof(CameraImage, name) == 528, "");
static_assert(offsetof(Frame, stamp) == 8 && offsetof(Frame, images) == 16, "");
static_assert(offsetof(Frame, imu) == 16 + kList, "");
static_assert(offsetof(Frame, imu_calibration) == 16 + 2 * kList, "");
static_assert(offsetof(Frame, gnss) == 112 + 2 * kList, "");
static_assert(offsetof(Frame, has_prior) == 112 + 3 * kList, "");
static_assert(offsetof(Frame, prior) == 120 + 3 * kList, "");
static_assert(sizeof(Frame) == 120 + 3 * kList + 344, "");
static_assert(offsetof(CameraSensor, kind) == kText, "");
static_assert(offsetof(CameraSensor, camera) == kText + 8, "");
static_assert(offsetof(CameraSensor, T_body_camera) == kText + 408, "");
static_assert(offsetof(CameraSensor, rate) == kText + 464, "");
static_assert(sizeof(CameraSensor) == kText + 480, "");
static_assert(offsetof(SensorRig, has_imu) == kList && offsetof(SensorRig, imu) == kList + 8, "");
static_assert(offsetof(SensorRig, has_gnss) == kList + 104, "");
static_assert(offsetof(SensorRig, gnss_antenna) == kList + 112, "");
static_assert(sizeof(SensorRig) == kList + 136, "");
static_assert(sizeof(Trajectory) == kList, "");
static_assert(offsetof(Keyframe, content) == 72 && sizeof(Keyframe) == 88, "");
static_assert(offsetof(KeyframeContent, features) == kList, "");
static_assert(sizeof(KeyframeContent) == 2 * kList + sizeof(Image), "");
static_assert(sizeof(detail::CowOwner) == 24 && sizeof(detail::Cow<int>) == 16, "");
static_assert(offsetof(detail::KeyframeRow, points) == 88, "");
static_assert(sizeof(detail::KeyframeRow) == 104, "");
static_assert(sizeof(detail::RecordChunk<MapPoint>) == 512 + kList, "");
static_assert(sizeof(detail::ListChunk<Observation>) == 512 + 2 * kList + 8, "");
static_assert(sizeof(detail::MapLayout::PointPage) == 256 * 16, "");
static_assert(sizeof(detail::MapLayout::PointNode) == 16 + 512 + kList, "");
static_assert(sizeof(detail::MapLayout::PointsSeenNode) == 16 + kList, "");
static_assert(sizeof(detail::RecordTable<MapPoint>) == 24, "");
static_assert(sizeof(detail::ListTable<Observation>) == 16, "");
static_assert(sizeof(Map) == 24 + 16 + 5 * 24 + 2 * 16 + 8 + 16, "");
static_assert(offsetof(DatasetInfo, sensors) == 3 * kText, "");
static_assert(offsetof(DatasetInfo, ground_truth) == 3 * kText + sizeof(SensorRig), "");
static_assert(offsetof(DatasetInfo, frame_count) == 5 * kText + sizeof(SensorRig) + kList, "");
static_assert(offsetof(DatasetInfo, remarks) == 5 * kText + sizeof(SensorRig) + kList + 32, "");
static_assert(sizeof(DatasetInfo) == 5 * kText + sizeof(SensorRig) + 2 * kList + 32, "");
static_assert(sizeof(Svar) == 32 && sizeof(Messenger) == 2 * 16 + kText, "");
static_assert(offsetof(SlamSetup, sensors) == sizeof(Svar), "");
static_assert(offsetof(SlamSetup, messenger) == sizeof(Svar) + sizeof(SensorRig), "");
static_assert(sizeof(SlamSetup) == sizeof(Svar) + sizeof(SensorRig) + sizeof(Messenger), "");
static_assert(offsetof(ApplicationSetup, messenger) == sizeof(Svar), "");
static_assert(offsetof(SlamFactory, parameters) == 2 * kText, "");
static_assert(offsetof(SlamFactory, needs) == 2 * kText + sizeof(Svar), "");
static_assert(offsetof(SlamFactory, make) == 2 * kText + sizeof(Svar) + 8, "");
static_assert(offsetof(SlamFactory, help) == 2 * kText + sizeof(Svar) + 8 + kFunction, "");
static_assert(sizeof(SlamFactory) == 2 * kText + 2 * sizeof(Svar) + 8 + kFunction, "");
static_assert(offsetof(DatasetFactory, recognizes) == 2 * kText + sizeof(Svar), "");
static_assert(sizeof(DatasetFactory) == 2 * kText + 2 * sizeof(Svar) + 2 * kFunction, "");
static_assert(sizeof(ApplicationFactory) == 2 * kText + 2 * sizeof(Svar) + kFunction, "");
static_assert(sizeof(Registry) == 3 * kList, "");
static_assert(offsetof(PluginEntry, version) == 184, "");
static_assert(offsetof(PluginEntry, description) == 216, "");
static_assert(offsetof(PluginEntry, add_factories) == 472, "");
static_assert(sizeof(PluginEntry) == 472 + 2 * kPointer, "");
#endif

// Interfaces are a pointer to their functions.
static_assert(sizeof(Slam) == kPointer && std::has_virtual_destructor<Slam>::value, "");
static_assert(sizeof(Dataset) == kPointer && std::has_virtual_destructor<Dataset>::value, "");
static_assert(sizeof(Application) == kPointer && std::has_virtual_destructor<Application>::value,
              "");

class SlamPair {
 public:
  SlamPair() {
    slams_[0] = plugins_.slam(std::string(GSLAM_TEST_PLUGIN_TOY) + ":toy").make();
    slams_[1] = plugins_.slam(std::string(GSLAM_TEST_PLUGIN_NATIVE) + ":native").make();
  }
  void configure(const Svar& parameters) {
    for (int i = 0; i < 2; ++i) {
      SlamSetup setup;
      setup.parameters = parameters;
      setup.sensors = toyRig();
      subscribers_[i] = setup.messenger.subscribe<TrackedPose>(
          "pose", [this, i](const TrackedPose& pose) { poses[i].push_back(pose); });
      slams_[i]->configure(setup);
    }
  }
  void feed(const std::shared_ptr<const Frame>& frame) {
    for (const auto& slam : slams_) slam->feed(frame);
  }
  Slam& native() { return *slams_[1]; }

  std::vector<TrackedPose> poses[2];

 private:
  Plugins plugins_;
  std::unique_ptr<Slam> slams_[2];
  Subscriber subscribers_[2];
};

TEST(Layout, PluginsCompiledWithOtherFlagsGetEveryBitAndGiveItBack) {
  SlamPair pair;
  pair.configure(Svar::object({{"seed", "something"}, {"keep", 2}, {"has_map", true}}));
  for (std::uint64_t id = 0; id < 10; ++id) pair.feed(toyFrame(id));
  ASSERT_EQ(pair.poses[0].size(), 10u);
  ASSERT_EQ(pair.poses[1].size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    const TrackedPose &a = pair.poses[0][i], &b = pair.poses[1][i];
    EXPECT_EQ(b.frame, i);
    EXPECT_EQ(a.stamp, b.stamp);
    EXPECT_EQ(b.state, TrackingState::tracking);
    for (std::size_t k = 0; k < 3; ++k) {  // a digest of all that it was given
      EXPECT_EQ(a.T_world_body.translation()[k], b.T_world_body.translation()[k]);
    }
    // Where multiplications and additions are fused, the last bits may differ.
    EXPECT_LT((a.T_world_body.rotation().inverse() * b.T_world_body.rotation()).log().norm(),
              1e-15);
  }
  pair.native().finish();
}

// Both sides walk through the same storage, and write to copies of it.
TEST(Layout, MapsOfPluginsCompiledWithOtherFlagsAreReadAndGoOn) {
  SlamPair pair;
  pair.configure(Svar::object({{"has_map", true}}));
  const std::shared_ptr<const Map> map = pair.native().map();
  ASSERT_NE(map, nullptr);
  const Map expected = toyMap();
  EXPECT_EQ(mapToBytes(*map), mapToBytes(expected));
  EXPECT_TRUE(validate(*map).empty());
  Map edited = *map, same = expected;
  for (Map* const one : {&edited, &same}) {
    const PointId stays = (*one->points().begin()).id;
    one->merge(stays, PointId(std::uint32_t(one->nextPointId()) - 1));
    one->setPose((*one->keyframes().begin()).id, SE3d());
    one->remove((*one->edges().begin()).id);
    one->observe(one->add(one->at(stays)), KeyframeId(2), 1);
  }
  EXPECT_EQ(mapToBytes(edited), mapToBytes(same));
  EXPECT_TRUE(validate(edited).empty());
  EXPECT_EQ(mapToBytes(*map), mapToBytes(expected));
}

TEST(Layout, ExceptionsOfPluginsCompiledWithOtherFlagsAreCaughtByType) {
  SlamPair pair;
  pair.configure(Svar::object({{"how", "throw parse"}, {"where", "feed"}, {"at", 3}}));
  try {
    pair.native().feed(toyFrame(3));
    ADD_FAILURE();
  } catch (const ParseError& error) {
    EXPECT_EQ(error.line(), 3u);
    EXPECT_STREQ(error.what(), "toy.yaml:3:4: has no wheels");
  }
  pair.configure(Svar::object({{"how", "throw std"}, {"where", "feed"}, {"at", 4}}));
  EXPECT_THROW(pair.native().feed(toyFrame(4)), std::out_of_range);
}

TEST(Layout, FactoriesOfPluginsCompiledWithOtherFlagsAreRead) {
  Plugins plugins;
  const SlamFactory factory = plugins.slam(std::string(GSLAM_TEST_PLUGIN_NATIVE) + ":native");
  EXPECT_EQ(factory.description, "digests what it is given");
  EXPECT_TRUE(factory.needs.imu && factory.needs.calibration && !factory.needs.depth);
  EXPECT_EQ(factory.parameters.get<int>("keep"), 0);
  const std::unique_ptr<Dataset> dataset = plugins.dataset("native_data").open("x", Svar());
  EXPECT_EQ(dataset->info().frame_count, 0u);
  EXPECT_EQ(plugins.application("native_waiter").make()->run(ApplicationSetup()), 42);
}

}  // namespace
