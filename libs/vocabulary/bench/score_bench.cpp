// Scores of two bags of 726 words, as many as an image of 1000 ORB features has in a vocabulary of
// 1e6 words, with 0, 5, 25 and 100 percent in common; beside a walk through two std::map, as DBoW
// has them. 64 pairs by turns, so that the processor cannot learn them by heart.
#include <benchmark/benchmark.h>
#include <gslam/base/simd.h>
#include <gslam/vocabulary/dbow_maps.h>
#include <gslam/vocabulary/score.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "../tests/random_bags.h"

namespace {

using gslam::BowVector;
using gslam::Scoring;
using BowMap = std::map<unsigned, double>;

std::vector<std::pair<BowVector, BowVector>> pairs(Scoring scoring, unsigned percent) {
  std::mt19937 generator(1);
  std::vector<std::pair<BowVector, BowVector>> all;
  for (int i = 0; i < 64; ++i) {
    const BowVector v = random_bags::bag(generator, 726, 1000000);
    const BowVector w = random_bags::bag(generator, 726, 1000000, v, percent);
    all.emplace_back(random_bags::normalized(v, scoring), random_bags::normalized(w, scoring));
  }
  return all;
}

void scoreOfVectors(benchmark::State& state, Scoring scoring, gslam::Simd simd) {
  const auto bags = pairs(scoring, static_cast<unsigned>(state.range(0)));
  const gslam::ScopedSimd forced(simd);
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& pair = bags[i++ % bags.size()];
    benchmark::DoNotOptimize(score(scoring, pair.first, pair.second));
  }
}

// Both walk ahead to where the other is.
double l1OfMaps(const BowMap& v, const BowMap& w) {
  double sum = 0;
  auto a = v.begin();
  auto b = w.begin();
  while (a != v.end() && b != w.end()) {
    if (a->first == b->first) {
      sum += std::fabs(a->second - b->second) - a->second - b->second;
      ++a;
      ++b;
    } else if (a->first < b->first) {
      a = v.lower_bound(b->first);
    } else {
      b = w.lower_bound(a->first);
    }
  }
  return -sum / 2;
}

void l1OfMapsBench(benchmark::State& state) {
  std::vector<std::pair<BowMap, BowMap>> bags;
  for (const auto& pair : pairs(Scoring::l1, static_cast<unsigned>(state.range(0)))) {
    bags.emplace_back(gslam::toMap<BowMap>(pair.first), gslam::toMap<BowMap>(pair.second));
  }
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& pair = bags[i++ % bags.size()];
    benchmark::DoNotOptimize(l1OfMaps(pair.first, pair.second));
  }
}

void add(const std::string& name, Scoring scoring, gslam::Simd simd) {
  benchmark::RegisterBenchmark(name.c_str(), scoreOfVectors, scoring, simd)
      ->ArgName("percent")
      ->Arg(0)
      ->Arg(5)
      ->Arg(25)
      ->Arg(100);
}

const bool kAreRegistered = [] {
  for (const gslam::Simd simd : gslam::detail::findCommonKernel().variants()) {
    add(std::string("score/l1/") + gslam::simdName(simd), Scoring::l1, simd);
  }
  for (const Scoring scoring : random_bags::scorings()) {
    add(std::string("score/") + gslam::scoringName(scoring), scoring, gslam::activeSimd());
  }
  benchmark::RegisterBenchmark("score/l1/std::map", l1OfMapsBench)
      ->ArgName("percent")
      ->Arg(0)
      ->Arg(5)
      ->Arg(25)
      ->Arg(100);
  return true;
}();

}  // namespace
