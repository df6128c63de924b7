// How fast sequences are opened, decoded and delivered, beside OpenCV's imread() on the same files.
#include <benchmark/benchmark.h>
#include <gslam/core/parameters.h>
#include <gslam/datasets.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kImages = 40;
constexpr std::size_t kLongSequence = 50000;

// A folder of images that a synthetic world shows; made once, gone at the end.
class Images {
 public:
  static const Images& get(const std::string& ending) {
    static const Images png("png"), jpg("jpg");
    return ending == "png" ? png : jpg;
  }
  ~Images() { fs::remove_all(folder_); }
  Images(const Images&) = delete;
  Images& operator=(const Images&) = delete;

  const std::string& folder() const { return folder_; }
  const std::vector<std::string>& files() const { return files_; }

 private:
  explicit Images(const std::string& ending) {
    folder_ = (fs::temp_directory_path() / "gslam_reading_bench_XXXXXX").string();
    if (mkdtemp(folder_.data()) == nullptr) std::abort();
    const auto world = gslam::openSynthetic(gslam::syntheticOptions(
        "synthetic://street?sensors=mono&width=1226&height=370&frames=" + std::to_string(kImages)));
    while (const auto frame = world->next()) {
      const gslam::Image& image = frame->images[0].image;
      char name[32];
      std::snprintf(name, sizeof(name), "/%06d.%s", int(frame->id), ending.c_str());
      files_.push_back(folder_ + name);
      const cv::Mat pixels(image.height(), image.width(), CV_8UC(image.channels()),
                           const_cast<std::uint8_t*>(image.bytes()), image.stride());
      if (!cv::imwrite(files_.back(), pixels)) std::abort();
    }
  }

  std::string folder_;
  std::vector<std::string> files_;
};

void readByOpenCv(benchmark::State& state, const std::string& ending) {
  const Images& images = Images::get(ending);
  for (auto _ : state) {
    for (const std::string& file : images.files()) {
      benchmark::DoNotOptimize(cv::imread(file, cv::IMREAD_UNCHANGED).data);
    }
  }
  state.SetItemsProcessed(std::int64_t(state.iterations() * images.files().size()));
}

void readByGslam(benchmark::State& state, const std::string& ending, int threads) {
  const Images& images = Images::get(ending);
  const gslam::DatasetFactory factory = gslam::cvMonoFactory();
  const gslam::Svar parameters = gslam::completeParameters(
      factory.parameters, gslam::Svar::object({{"threads", threads}, {"rate", 10.0}}));
  const auto dataset = factory.open(images.folder(), parameters);
  for (auto _ : state) {
    dataset->seek(0);
    while (const auto frame = dataset->next()) benchmark::DoNotOptimize(frame->images.data());
  }
  state.SetItemsProcessed(std::int64_t(state.iterations() * images.files().size()));
}

// KITTI's layout with one image under many names.
class LongSequence {
 public:
  static const LongSequence& get() {
    static const LongSequence one;
    return one;
  }
  ~LongSequence() { fs::remove_all(folder_); }
  LongSequence(const LongSequence&) = delete;
  LongSequence& operator=(const LongSequence&) = delete;
  const std::string& folder() const { return folder_; }

 private:
  LongSequence() {
    folder_ = (fs::temp_directory_path() / "gslam_long_bench_XXXXXX").string();
    if (mkdtemp(folder_.data()) == nullptr) std::abort();
    std::ofstream calibration(folder_ + "/calib.txt"), times(folder_ + "/times.txt");
    for (const char* camera : {"P0", "P1"}) {
      calibration << camera << ": 300 0 160 0 0 300 120 0 0 0 1 0\n";
      fs::create_directory(folder_ + (camera[1] == '0' ? "/image_0" : "/image_1"));
    }
    for (const std::string camera : {"/image_0/", "/image_1/"}) fill(folder_ + camera);
    for (std::size_t i = 0; i < kLongSequence; ++i) times << double(i) * 0.1 << '\n';
  }

  // A file may have 65000 names in some file systems.
  static void fill(const std::string& folder) {
    const std::string first = folder + "000000.png";
    if (!cv::imwrite(first, cv::Mat(240, 320, CV_8UC1, cv::Scalar(100)))) std::abort();
    for (std::size_t i = 1; i < kLongSequence; ++i) {
      char name[32];
      std::snprintf(name, sizeof(name), "%06zu.png", i);
      fs::create_hard_link(first, folder + name);
    }
  }

  std::string folder_;
};

void openLong(benchmark::State& state) {
  const std::string& folder = LongSequence::get().folder();
  const gslam::DatasetFactory factory = gslam::kittiFactory();
  for (auto _ : state) benchmark::DoNotOptimize(factory.open(folder, factory.parameters));
}

// Megabytes that reading adds to the peak of the process, for as many frames.
void memoryOf(benchmark::State& state, std::size_t frames) {
  const auto peak = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
  };
  const gslam::DatasetFactory factory = gslam::kittiFactory();
  const auto dataset = factory.open(LongSequence::get().folder(), factory.parameters);
  const double before = peak();
  for (auto _ : state) {
    dataset->seek(0);
    for (std::size_t i = 0; i < frames; ++i) benchmark::DoNotOptimize(dataset->next());
  }
  state.counters["added_MB"] = peak() - before;
}

const bool kRegistered = [] {
  for (const std::string ending : {"png", "jpg"}) {
    const auto add = [&](const std::string& who, auto read) {
      benchmark::RegisterBenchmark(("read/" + who + "/" + ending).c_str(), read)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    };
    add("opencv", [=](benchmark::State& state) { readByOpenCv(state, ending); });
    for (const int threads : {0, 1, 2}) {
      add("gslam_" + std::to_string(threads),
          [=](benchmark::State& state) { readByGslam(state, ending, threads); });
    }
  }
  benchmark::RegisterBenchmark("open/gslam/50000_stereo", openLong)->Unit(benchmark::kMillisecond);
  for (const std::size_t frames : {100, 3000}) {
    benchmark::RegisterBenchmark(("memory/gslam/" + std::to_string(frames) + "_frames").c_str(),
                                 [=](benchmark::State& state) { memoryOf(state, frames); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
  return true;
}();

}  // namespace
