// Reading foreign files of 1 111 110 nodes, K = 10 and L = 6, with 32 bytes each, as ORBvoc.txt has
// them: bytes a second, and how much memory that takes at most.
#include <benchmark/benchmark.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/orb_slam_text.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

using gslam::Vocabulary;
using gslam::detail::TreeData;

constexpr std::uint32_t kBranching = 10;
constexpr std::uint32_t kDepth = 6;

// Breadth first, with one of 2000 weights for each word, as 2000 images make them.
TreeData makeTree() {
  std::mt19937 random;
  TreeData data;
  data.branching = kBranching;
  data.depth = kDepth;
  std::uint32_t begin = 0;
  std::uint32_t end = 1;
  for (std::uint32_t level = 0; level < kDepth; ++level) {
    for (std::uint32_t parent = begin; parent != end; ++parent) {
      data.parents.insert(data.parents.end(), kBranching, parent);
    }
    begin = end;
    end = static_cast<std::uint32_t>(data.parents.size() + 1);
  }
  for (std::size_t i = 0; i < data.parents.size(); ++i) {
    const bool is_leaf = i + 1 >= begin;
    data.weights.push_back(is_leaf ? static_cast<double>(1 + random() % 2000) / 300 : 0);
  }
  data.descriptors.resize(data.parents.size() * 32);
  for (std::uint8_t& byte : data.descriptors) byte = static_cast<std::uint8_t>(random() >> 16);
  return data;
}

// As DBoW2 prints them; `digits` of the weights.
std::string orbText(const TreeData& data, int digits) {
  std::string text = "10 6  0 0\n";
  char number[40];
  for (std::size_t i = 0; i < data.parents.size(); ++i) {
    text += std::to_string(data.parents[i]) + (data.weights[i] != 0 ? " 1 " : " 0 ");
    for (std::size_t at = 0; at < 32; ++at) {
      text += std::to_string(unsigned(data.descriptors[i * 32 + at])) + " ";
    }
    std::snprintf(number, sizeof number, " %.*g\n", digits, data.weights[i]);
    text += number;
  }
  return text;
}

std::string yaml(const TreeData& data) {
  std::string text =
      "%YAML:1.0\n---\nvocabulary:\n   k: 10\n   L: 6\n   scoringType: 0\n   weightingType: 0\n"
      "   nodes:\n";
  std::string words = "   words:\n";
  char number[40];
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < data.parents.size(); ++i) {
    std::snprintf(number, sizeof number, "%.16e", data.weights[i]);
    const std::string id = std::to_string(i + 1);
    text += "      - { nodeId:" + id + ", parentId:" + std::to_string(data.parents[i]) +
            ", weight:" + (data.weights[i] == 0 ? "0." : number) + ",\n          descriptor:\"";
    for (std::size_t at = 0; at < 32; ++at) {
      text += std::to_string(unsigned(data.descriptors[i * 32 + at])) + " ";
    }
    text += "\" }\n";
    if (data.weights[i] == 0) continue;
    words += "      - { wordId:" + std::to_string(word++) + ", nodeId:" + id + " }\n";
  }
  return text + words;
}

// The most memory that the process had since the last call, as Linux counts it; 0 elsewhere.
double peakMegabytes() {
#ifdef __GLIBC__
  malloc_trim(0);  // what was freed is not there to be used again
#endif
  std::ifstream status("/proc/self/status");
  std::string line;
  double kilobytes = 0;
  while (std::getline(status, line)) {
    if (line.compare(0, 6, "VmHWM:") == 0) std::istringstream(line.substr(6)) >> kilobytes;
  }
  std::ofstream("/proc/self/clear_refs") << 5;
  return kilobytes / 1024;
}

void load(benchmark::State& state, const std::string& text) {
  peakMegabytes();
  const double before = peakMegabytes();
  std::uint32_t words = 0;
  for (auto _ : state) {
    const Vocabulary vocabulary = gslam::loadVocabulary(
        {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "bench");
    words = vocabulary.wordCount();
  }
  const double peak = peakMegabytes() - before;
  if (words != 1000000) state.SkipWithError("words are missing");
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
  state.counters["file_MB"] = static_cast<double>(text.size()) / 1e6;
  state.counters["more_memory_MB"] = peak;
}

void loadOrbText(benchmark::State& state) {
  load(state, orbText(makeTree(), static_cast<int>(state.range(0))));
}
BENCHMARK(loadOrbText)
    ->ArgName("digits")
    ->Arg(6)
    ->Arg(17)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void loadYaml(benchmark::State& state) {
  load(state, yaml(makeTree()));
}
BENCHMARK(loadYaml)->Unit(benchmark::kMillisecond)->UseRealTime();

void writeOrbText(benchmark::State& state) {
  const TreeData data =
      gslam::detail::treeDataOf(gslam::detail::buildVocabulary(makeTree(), "tree"));
  std::size_t size = 0;
  for (auto _ : state) {
    size = 0;
    gslam::detail::OrbTextWriter(data).write(
        [&size](const char* text, std::size_t more) { size += more + (text[0] == 0 ? 1 : 0); });
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(size));
}
BENCHMARK(writeOrbText)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
