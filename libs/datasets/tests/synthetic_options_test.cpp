// Names with queries, parameters, and what is refused.
#include <gmock/gmock.h>
#include <gslam/base/error.h>
#include <gslam/svar/error.h>

#include <limits>

#include "synthetic_frames.h"
#include "thrown.h"

namespace {

using namespace synthetic_frames;
using gslam::FrameRanges;
using testing::HasSubstr;

TEST(SyntheticOptions, AreReadFromTheName) {
  const SyntheticOptions o = gslam::syntheticOptions(
      "synthetic://street?seed=7&frames=300&noise=0.5&colour=yes&lens=1,2.5,3,4&rate=10&"
      "dropped=3-5,9&model=pinhole");
  EXPECT_EQ(o.world, "street");
  EXPECT_EQ(o.seed, 7U);
  EXPECT_EQ(o.frames, 300);
  EXPECT_EQ(o.noise, 0.5);
  EXPECT_TRUE(o.colour);
  EXPECT_EQ(o.lens, (std::vector<double>{1, 2.5, 3, 4}));
  EXPECT_EQ(o.rate, 10);
  EXPECT_EQ(o.dropped.text(), "3-5,9");
  EXPECT_EQ(gslam::syntheticOptions("synthetic").world, "room");
  EXPECT_EQ(gslam::syntheticOptions("synthetic://").world, "room");
  EXPECT_EQ(gslam::syntheticOptions("synthetic://aerial").world, "aerial");
}

TEST(SyntheticOptions, OfTheNameGoBeforeParameters) {
  const gslam::Svar given = gslam::Svar::object({{"seed", 5}, {"rate", 30}, {"world", "aerial"}});
  const SyntheticOptions o = gslam::syntheticOptions("synthetic://room?rate=12.5", given);
  EXPECT_EQ(o.world, "room");
  EXPECT_EQ(o.seed, 5U);
  EXPECT_EQ(o.rate, 12.5);
  EXPECT_EQ(gslam::syntheticOptions("synthetic", given).world, "aerial");
}

TEST(SyntheticOptions, AreCheckedWhenTheyAreRead) {
  const auto message = [](const std::string& name) {
    return thrownBy([&] { gslam::syntheticOptions(name); });
  };
  EXPECT_THAT(message("synthetic://room?fraems=3"), HasSubstr("did you mean frames?"));
  EXPECT_THAT(message("synthetic://room?seed"), HasSubstr("name=value"));
  EXPECT_THAT(message("synthetic://room?seed=x"), HasSubstr("seed"));
  EXPECT_THAT(message("synthetic://room?frames=1.5"), HasSubstr("frames"));
  EXPECT_THAT(message("synthetic://room?frames=99999999999"), HasSubstr("frames"));
  EXPECT_THAT(message("synthetic://room?blur=maybe"), HasSubstr("true or false"));
  EXPECT_THAT(message("synthetic://room?dropped=9-3"), HasSubstr("end before"));
  EXPECT_THAT(message("synthetic://room?dropped=a"), HasSubstr("100-119"));
  EXPECT_THAT(message("synthetic://room?lens=1,a"), HasSubstr("lens"));
  EXPECT_THAT(message("/data/room"), HasSubstr("synthetic://WORLD"));
  EXPECT_THAT(thrownBy([] {
                gslam::syntheticOptions("synthetic", gslam::Svar::object({{"sede", 1}}));
              }),
              HasSubstr("did you mean seed?"));
}

template <class Value>
std::string refused(Value SyntheticOptions::*option, Value value) {
  SyntheticOptions options;
  options.*option = value;
  return thrownBy([&] { gslam::openSynthetic(options); });
}

TEST(SyntheticOptions, OutOfRangeAreRefusedByName) {
  using O = SyntheticOptions;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refused<std::string>(&O::world, "rom"), HasSubstr("did you mean room?"));
  EXPECT_THAT(refused<std::string>(&O::sensors, "lidar"), HasSubstr("sensors"));
  EXPECT_THAT(refused<std::string>(&O::model, "pinhoel"), HasSubstr("pinhoel"));
  EXPECT_THAT(refused(&O::frames, 0), HasSubstr("frames is 0"));
  EXPECT_THAT(refused(&O::frames, 100000000), HasSubstr("frames"));
  EXPECT_THAT(refused(&O::rate, nan), HasSubstr("rate"));
  EXPECT_THAT(refused(&O::rate, -1.0), HasSubstr("rate"));
  EXPECT_THAT(refused(&O::speed, nan), HasSubstr("speed"));
  EXPECT_THAT(refused(&O::width, 1 << 30), HasSubstr("width"));
  EXPECT_THAT(refused(&O::noise, -1.0), HasSubstr("noise"));
  EXPECT_THAT(refused(&O::exposure, 1.0), HasSubstr("exposure"));
  EXPECT_THAT(refused(&O::imu_rate, 1e9), HasSubstr("imu_rate"));
  EXPECT_THAT(refused(&O::movers, -1), HasSubstr("movers"));
  EXPECT_THAT(refused(&O::lens, {1, 2}), HasSubstr("pinhole"));
  FrameRanges all;
  all.ranges = {{0, 100000}};
  EXPECT_THAT(refused(&O::dropped, all), HasSubstr("dropped"));
  all.ranges = {{5, 3}};
  EXPECT_THAT(refused(&O::occlusion, all), HasSubstr("occlusion"));
  all.ranges = {{10, 30}, {20, 40}};
  EXPECT_THAT(refused(&O::pure_rotation, all), HasSubstr("overlap"));
  std::vector<CameraSensor> cameras(1);
  EXPECT_THAT(refused(&O::cameras, cameras), HasSubstr("model"));
  cameras[0].camera = Camera::fromParameters("pinhole", 4, 4, {4, 4, 2, 2});
  cameras[0].kind = ImageKind::label;
  EXPECT_THAT(refused(&O::cameras, cameras), HasSubstr("label"));
}

TEST(SyntheticOptions, AllKindsOfRigs) {
  const auto namesOf = [](const std::string& sensors) {
    SyntheticOptions options;
    options.sensors = sensors;
    options.width = 32;
    options.height = 24;
    std::string names;
    const auto dataset = gslam::openSynthetic(options);
    const auto frame = dataset->next();
    EXPECT_EQ(frame->images.size(), dataset->info().sensors.cameras.size());
    for (const CameraImage& image : frame->images) {
      EXPECT_EQ(image.image.width(), 32);
      names += image.name + " ";
    }
    return names;
  };
  EXPECT_EQ(namesOf("mono"), "camera ");
  EXPECT_EQ(namesOf("rgbd"), "camera depth ");
  EXPECT_EQ(namesOf("stereo"), "left right ");
  EXPECT_EQ(namesOf("multi"), "front left back right ");
}

TEST(SyntheticOptions, OneFrameAndTheEnd) {
  SyntheticOptions options = clean();
  options.frames = 1;
  options.width = options.height = 8;
  const auto dataset = gslam::openSynthetic(options);
  EXPECT_EQ(dataset->info().frame_count, 1U);
  EXPECT_NE(dataset->next(), nullptr);
  EXPECT_EQ(dataset->next(), nullptr);
  dataset->seek(1);
  EXPECT_EQ(dataset->next(), nullptr);
  EXPECT_THROW(dataset->seek(2), gslam::ArgumentError);
}

TEST(SyntheticOptions, TheFactoryTakesDefaults) {
  const gslam::DatasetFactory factory = gslam::syntheticFactory();
  EXPECT_EQ(factory.name, "synthetic");
  EXPECT_FALSE(factory.recognizes("/"));
  EXPECT_EQ(factory.parameters.get<int>("frames"), 600);
  const auto dataset = factory.open("synthetic://corridor?width=16&height=12", factory.parameters);
  EXPECT_EQ(dataset->info().name, "corridor-1");
  EXPECT_EQ(dataset->info().format, "synthetic");
}

}  // namespace
