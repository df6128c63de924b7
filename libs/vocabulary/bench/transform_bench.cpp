// Descriptors to bags of words: 1000 a call, as an image has.
#include <benchmark/benchmark.h>
#include <gslam/base/simd.h>
#include <gslam/vocabulary/transform.h>

#include <cstdint>
#include <string>
#include <vector>

#include "../tests/random_tree.h"

namespace {

const gslam::Vocabulary& orb(std::uint32_t depth) {
  static const gslam::Vocabulary small =
      random_tree::treeOf(random_tree::formatOf(gslam::DescriptorType::binary, 32), 10, 4);
  static const gslam::Vocabulary large =
      random_tree::treeOf(random_tree::formatOf(gslam::DescriptorType::binary, 32), 10, 6);
  return depth == 4 ? small : large;
}

const gslam::Vocabulary& sift() {
  static const gslam::Vocabulary tree =
      random_tree::treeOf(random_tree::formatOf(gslam::DescriptorType::float32, 128), 10, 4);
  return tree;
}

void run(benchmark::State& state, const gslam::Vocabulary& vocabulary,
         const std::vector<gslam::Descriptors>& images) {
  gslam::TransformMemory memory;
  gslam::BowVector bow;
  gslam::FeatureVector features;
  std::size_t at = 0;
  for (auto _ : state) {
    transform(vocabulary, images[at], 2, bow, features, memory);
    benchmark::DoNotOptimize(bow.words.data());
    at = at + 1 == images.size() ? 0 : at + 1;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * 1000);
}

// 64 images, so that the tree is met where it is cold.
void transformOrb(benchmark::State& state, gslam::Simd simd, std::uint32_t depth) {
  const gslam::ScopedSimd scope(simd);
  const gslam::Vocabulary& vocabulary = orb(depth);
  const std::vector<std::uint8_t> queries = random_tree::queriesLike(vocabulary, 64000);
  std::vector<gslam::Descriptors> images;
  for (std::size_t i = 0; i < 64; ++i) {
    images.push_back(gslam::binaryDescriptors(&queries[i * 32000], 1000, 32));
  }
  run(state, vocabulary, images);
}

void transformSift(benchmark::State& state, gslam::Simd simd) {
  const gslam::ScopedSimd scope(simd);
  const std::vector<float> queries = random_tree::floats(8 * 128000);
  std::vector<gslam::Descriptors> images;
  for (std::size_t i = 0; i < 8; ++i) {
    images.push_back(gslam::floatDescriptors(&queries[i * 128000], 1000, 128));
  }
  run(state, sift(), images);
}

const int kRegistered = [] {
  for (const gslam::Simd simd : gslam::availableSimd()) {
    const std::string name = gslam::simdName(simd);
    benchmark::RegisterBenchmark(("transform/orb4/" + name).c_str(), transformOrb, simd, 4u)
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("transform/orb6/" + name).c_str(), transformOrb, simd, 6u)
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("transform/sift4/" + name).c_str(), transformSift, simd)
        ->Unit(benchmark::kMicrosecond);
  }
  return 0;
}();

}  // namespace
