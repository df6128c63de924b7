// A plugin for the tests: a SLAM system whose poses depend on every bit that it is given, and that
// fails in whatever way it is told to.
#include <gslam/base/log.h>
#include <gslam/core/plugin.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "../toy_map.h"

namespace {

using gslam::Frame;
using gslam::Svar;

// FNV-1a of all that was put in.
class Digest {
 public:
  void bytes(const void* data, std::size_t size) {
    const unsigned char* const begin = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) sum_ = (sum_ ^ begin[i]) * 1099511628211u;
  }
  void number(double value) { bytes(&value, sizeof(value)); }
  void number(std::int64_t value) { bytes(&value, sizeof(value)); }
  void text(const std::string& value) { bytes(value.data(), value.size()); }
  void pose(const gslam::SE3d& pose) { bytes(pose.data(), 7 * sizeof(double)); }
  void camera(const gslam::Camera& camera) {
    text(camera.modelName());
    number(std::int64_t(camera.width()));
    number(std::int64_t(camera.height()));
    for (const double value : camera.parameters()) number(value);
  }
  void image(const gslam::Image& image) {
    text(image.text());
    for (int y = 0; y < image.height(); ++y) bytes(image.bytes(y), image.rowBytes());
  }
  void imu(const gslam::ImuCalibration& imu) {
    pose(imu.T_body_imu);
    for (const double value :
         {imu.rate, imu.gyro_noise, imu.accel_noise, imu.gyro_bias_walk, imu.accel_bias_walk}) {
      number(value);
    }
  }
  void sensors(const gslam::SensorRig& rig) {
    for (const gslam::CameraSensor& one : rig.cameras) {
      text(one.name + gslam::imageKindName(one.kind));
      camera(one.camera);
      pose(one.T_body_camera);
      number(one.rate);
      number(one.depth_scale);
    }
    imu(rig.imu);
    number(std::int64_t(rig.has_imu) + 2 * std::int64_t(rig.has_gnss));
    bytes(rig.gnss_antenna.data(), 24);
  }
  void frame(const Frame& frame) {
    number(std::int64_t(frame.id));
    number(frame.stamp);
    for (const gslam::CameraImage& one : frame.images) {
      image(one.image);
      camera(one.camera);
      pose(one.T_body_camera);
      number(one.exposure);
      number(one.depth_scale);
      text(one.name + gslam::imageKindName(one.kind));
    }
    for (const gslam::ImuSample& one : frame.imu) bytes(&one, sizeof(one));
    imu(frame.imu_calibration);
    for (const gslam::GnssSample& one : frame.gnss) {
      number(one.stamp);
      number(one.position.latitude);
      bytes(one.covariance.data(), 72);
      bytes(one.velocity.data(), 24);
      number(std::int64_t(one.fix));
    }
    number(std::int64_t(frame.has_prior));
    pose(frame.prior.pose());
    bytes(frame.prior.covariance().data(), 36 * sizeof(double));
  }
  std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 14695981039346656037u;
};

__attribute__((noinline, no_sanitize("undefined", "thread"))) void crash() {
  volatile int* volatile nowhere = nullptr;
  *nowhere = 1;
}

__attribute__((noinline)) void useAllMemory() {
  std::vector<std::unique_ptr<char[]>> blocks;
  for (;;) {
    blocks.emplace_back(new char[std::size_t(64) << 20]);
    std::memset(blocks.back().get(), 1, 4096);
  }
}

void misbehave(const std::string& how) {
  if (how == "segfault") crash();
  if (how == "abort") std::abort();
  if (how == "exit") std::exit(7);
  if (how == "exit0") std::exit(0);
  if (how == "kill") std::raise(SIGKILL);
  if (how == "hang") {
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  if (how == "memory") useAllMemory();
  if (how == "throw") throw gslam::Error("the toy broke");
  if (how == "throw argument") throw gslam::ArgumentError("toy", "is broken");
  if (how == "throw file") throw gslam::FileError("/toy/box", "is empty");
  if (how == "throw parse") throw gslam::ParseError("toy.yaml", 3, 4, "has no wheels");
  if (how == "throw std") throw std::out_of_range("beyond the box");
  if (how == "throw int") throw 3;
  if (how == "garbage") {
    const std::string text = "this is not what was agreed upon, but sixteen bytes and more";
    if (::write(3, text.data(), text.size()) < 0) std::abort();
  }
  if (how == "huge") {  // a head that promises a terabyte
    const std::uint64_t head[2] = {0x4D534947u + (std::uint64_t(101) << 32), std::uint64_t(1)
                                                                                 << 39};
    if (::write(3, head, sizeof(head)) < 0) std::abort();
  }
  if (how == "close") ::close(3);
  if (how == "helper") {  // a process of its own that holds all files open, and then the end
    if (::fork() == 0) {
      ::sleep(30);
      ::_exit(0);
    }
    std::raise(SIGKILL);
  }
}

class Toy : public gslam::Slam {
 public:
  void configure(const gslam::SlamSetup& setup) override {
    parameters_ = setup.parameters;
    start_.sensors(setup.sensors);
    start_.text(parameters_.get<std::string>("seed", ""));
    pose_ = setup.messenger.advertise<gslam::TrackedPose>("pose");
    GSLAM_LOG(info) << "the toy is configured";
    act("configure", 0);
  }

  void feed(const std::shared_ptr<const Frame>& frame) override {
    Digest digest = start_;
    if (!parameters_.get<bool>("idle", false)) digest.frame(*frame);
    if (parameters_.get<int>("keep", 0) > 0) keep(frame, digest);
    act("feed", std::int64_t(frame->id));
    const std::uint64_t sum = digest.sum();
    const gslam::Vec3d t = {double(sum & 0xFFFF), double(sum >> 16 & 0xFFFF), double(sum >> 32)};
    gslam::TrackedPose pose;
    pose.frame = frame->id;
    pose.stamp = frame->stamp;
    pose.state = gslam::TrackingState::tracking;
    pose.T_world_body = gslam::SE3d(gslam::SO3d::fromQuaternion(0, 0, double(sum & 7), 1), t);
    pose_.publish(pose);
  }

  std::shared_ptr<const gslam::Map> map() override {
    act("map", 0);
    if (!parameters_.get<bool>("has_map", false)) return nullptr;
    return std::make_shared<gslam::Map>(toyMap());
  }

  void finish() override {
    for (const auto& kept : kept_) {
      Digest digest = start_;
      digest.frame(*kept.first);
      if (digest.sum() != kept.second) {
        throw gslam::Error("frame " + std::to_string(kept.first->id) + " changed");
      }
    }
    act("finish", 0);
  }

  ~Toy() override {
    if (parameters_.get<std::string>("where", "") == "destructor") {
      misbehave(parameters_.get<std::string>("how", ""));
    }
  }

 private:
  void act(const std::string& where, std::int64_t frame) const {
    if (parameters_.get<std::string>("where", "") == where &&
        parameters_.get<std::int64_t>("at", 0) == frame) {
      misbehave(parameters_.get<std::string>("how", ""));
    }
  }

  void keep(const std::shared_ptr<const Frame>& frame, const Digest& digest) {
    const std::size_t most = parameters_.get<std::size_t>("keep", 0);
    if (kept_.size() >= most) kept_.erase(kept_.begin());
    kept_.emplace_back(frame, digest.sum());
  }

  Svar parameters_;
  Digest start_;
  gslam::Publisher<gslam::TrackedPose> pose_;
  std::vector<std::pair<std::shared_ptr<const Frame>, std::uint64_t>> kept_;
};

class Nothing : public gslam::Dataset {
 public:
  const gslam::DatasetInfo& info() const override { return info_; }
  std::shared_ptr<const Frame> next() override { return nullptr; }
  void seek(std::size_t) override {}

 private:
  gslam::DatasetInfo info_;
};

class Waiter : public gslam::Application {
 public:
  int run(const gslam::ApplicationSetup&) override { return 42; }
  void stop() override {}
};

std::unique_ptr<gslam::Slam> make() {
  return std::unique_ptr<gslam::Slam>(new Toy);
}

void addSlam(gslam::Registry& registry, const char* name, std::unique_ptr<gslam::Slam> (*maker)()) {
  gslam::SlamFactory slam;
  slam.name = name;
  slam.description = "digests what it is given";
  slam.parameters = Svar::object({{"keep", 0}, {"seed", ""}});
  slam.help = Svar::object({{"keep", "frames that are kept"}});
  slam.needs.imu = true;
  slam.make = maker;
  registry.add(slam);
}

}  // namespace

// Whether any code of this library ran is seen from the outside.
struct Trace {
  Trace() { setenv("GSLAM_TEST_TOY_RAN", "1", 1); }
};
static const Trace trace;

#ifndef TOY
#define TOY toy
#endif
#define TOY_PLUGIN(name) GSLAM_PLUGIN(name, "2.3.4", "A toy for tests")

TOY_PLUGIN(TOY) {
#ifdef TOY_THROWS
  addSlam(registry, "half", make);
  throw std::runtime_error("no batteries");
#else
  const std::string name = GSLAM_DETAIL_TEXT(TOY);
  addSlam(registry, name.c_str(), make);
  addSlam(registry, (name + "_throws").c_str(), [] {
    misbehave("throw argument");
    return make();
  });
  addSlam(registry, (name + "_crashes").c_str(), [] {
    misbehave("segfault");
    return make();
  });
  gslam::DatasetFactory dataset;
  dataset.name = name + "_data";
  dataset.recognizes = [](const std::string& path) {
    return path.find("toy_data") != std::string::npos;
  };
  dataset.open = [](const std::string&, const Svar&) {
    return std::unique_ptr<gslam::Dataset>(new Nothing);
  };
  registry.add(dataset);
  gslam::ApplicationFactory application;
  application.name = name + "_waiter";
  application.make = [] { return std::unique_ptr<gslam::Application>(new Waiter); };
  registry.add(application);
#endif
}
