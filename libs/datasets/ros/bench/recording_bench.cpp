// How fast recordings are opened and their messages read, beside reading the file as it is.
#include <benchmark/benchmark.h>
#include <gslam/datasets_ros.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "../tests/encoder.h"
#include "../tests/mcap_writer.h"

namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 640, kHeight = 480, kImages = 100;
constexpr int kImuMessages = 20;  // between two images

// A recording of images, whose rows are alike, and of inertial samples; gone at the end.
class File {
 public:
  static const File& get(const std::string& compression) {
    static const std::map<std::string, File> files = [] {
      std::map<std::string, File> all;
      for (const char* const name : {"", "lz4", "zstd"}) all.emplace(name, name);
      return all;
    }();
    return files.at(compression);
  }
  explicit File(const std::string& compression)
      : path_((fs::temp_directory_path() /
               ("gslam_recording_bench_" + std::to_string(getpid()) + compression + ".mcap"))
                  .string()) {
    std::vector<Recorded> messages;
    for (int i = 0; i < kImages; ++i) {
      const std::int64_t stamp = 1000000000 + std::int64_t(i) * 50000000;
      for (int k = 0; k < kImuMessages; ++k) {
        const std::int64_t at = stamp + k * 2500000;
        messages.push_back({"/imu", "sensor_msgs/Imu", at, imuBytes(Coding::little_cdr, at, 1)});
      }
      messages.push_back({"/camera/image_raw", "sensor_msgs/Image", stamp, image(stamp, i)});
    }
    mcap_writer::Shape shape;
    shape.compression = compression;
    writeFile(path_, mcap_writer::write(messages, shape));
  }
  ~File() { fs::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const std::string& path() const { return path_; }
  std::int64_t size() const { return std::int64_t(fs::file_size(path_)); }

 private:
  static std::vector<std::uint8_t> image(std::int64_t stamp, int seed) {
    std::vector<std::uint8_t> pixels(std::size_t(kWidth) * kHeight);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      pixels[i] = std::uint8_t(i % kWidth / 4 + i / kWidth / 8 + std::size_t(seed));
    }
    return imageBytes(Coding::little_cdr, stamp, "camera", kWidth, kHeight, "mono8", kWidth, false,
                      pixels);
  }

  std::string path_;
};

void readPlainly(benchmark::State& state, const std::string& compression) {
  const File& file = File::get(compression);
  for (auto _ : state) {
    std::ifstream in(file.path(), std::ios::binary);
    std::vector<char> bytes(static_cast<std::size_t>(file.size()));
    in.read(bytes.data(), file.size());
    benchmark::DoNotOptimize(bytes.data());
  }
  state.SetBytesProcessed(std::int64_t(state.iterations()) * file.size());
}

void openRecording(benchmark::State& state, const std::string& compression) {
  const File& file = File::get(compression);
  for (auto _ : state) benchmark::DoNotOptimize(gslam::Recording::open(file.path()));
}

void readMessages(benchmark::State& state, const std::string& compression) {
  const File& file = File::get(compression);
  const auto recording = gslam::Recording::open(file.path());
  const std::vector<gslam::MessageRef> messages = recording->messages();
  std::int64_t bytes = 0;
  for (auto _ : state) {
    for (const gslam::MessageRef& message : messages) {
      const std::vector<std::uint8_t> read = recording->read(message);
      benchmark::DoNotOptimize(read.data());
      bytes += std::int64_t(read.size());
    }
  }
  state.SetBytesProcessed(bytes);
}

void playDataset(benchmark::State& state, const std::string& compression) {
  const gslam::DatasetFactory factory = gslam::rosFactory();
  const auto dataset = factory.open(File::get(compression).path(), factory.parameters);
  for (auto _ : state) {
    dataset->seek(0);
    while (const auto frame = dataset->next()) benchmark::DoNotOptimize(frame->images.data());
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * kImages);
}

const bool kRegistered = [] {
  for (const std::string name : {"", "lz4", "zstd"}) {
    const std::string label = name.empty() ? "plain" : name;
    const auto add = [&](const std::string& what, auto run) {
      benchmark::RegisterBenchmark(what.c_str(), [=](benchmark::State& state) { run(state, name); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    };
    add("read/file/" + label, readPlainly);
    add("read/gslam/" + label, readMessages);
    add("open/gslam/" + label, openRecording);
    add("play/gslam/" + label, playDataset);
  }
  return true;
}();

}  // namespace
