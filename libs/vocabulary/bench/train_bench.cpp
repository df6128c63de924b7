// Training: ORB-4 and ORB-6 are binary descriptors of 32 bytes with K = 10, L = 4 and 6, SIFT-4 are
// 128 floats. Made ones: centres that are like others, with bits that flip or noise. The argument
// is the number of threads.
#include <benchmark/benchmark.h>
#include <gslam/vocabulary/train.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../tests/training_images.h"

namespace {

using gslam::Descriptors;

void train(benchmark::State& state, const std::vector<Descriptors>& images, std::uint32_t depth) {
  gslam::TrainingOptions options;
  options.depth = depth;
  options.parallel.threads = static_cast<unsigned>(state.range(0));
  gslam::TrainingReport report;
  std::uint32_t words = 0;
  for (auto _ : state) words = gslam::trainVocabulary(images, options, &report).wordCount();
  state.counters["words"] = words;
  state.counters["iterations"] = static_cast<double>(report.iterations);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(report.descriptors));
}

void trainOrb4(benchmark::State& state) {
  static const auto images = training_images::binaryImages(400, 1000, 32, 20000, 1);
  train(state, images.views(), 4);
}

void trainOrb6(benchmark::State& state) {
  static const auto images = training_images::binaryImages(2000, 1000, 32, 100000, 1);
  train(state, images.views(), 6);
}

void trainSift4(benchmark::State& state) {
  static const auto images = training_images::floatImages(400, 1000, 128, 20000, 1);
  train(state, images.views(), 4);
}

// With memory for a tenth of the descriptors.
void trainOrb4Streamed(benchmark::State& state) {
  static const auto images = training_images::binaryImages(400, 1000, 32, 20000, 1);
  const std::vector<Descriptors> views = images.views();
  gslam::TrainingOptions options;
  options.depth = 4;
  options.parallel.threads = static_cast<unsigned>(state.range(0));
  options.memory = 40000 * std::size_t(32 + 17);
  gslam::TrainingReport report;
  const auto source = [&](std::size_t i) { return views[i]; };
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        gslam::trainVocabulary(views.size(), source, options, &report).wordCount());
  }
  state.counters["passes"] = report.passes;
}

BENCHMARK(trainOrb4)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(trainOrb4Streamed)
    ->Arg(2)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(trainSift4)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(trainOrb6)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
