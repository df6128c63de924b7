// Queries of a database of 200 images of 726 words in a vocabulary of 1e6, as ORB-6 of the issue
// has them, of which each shares a quarter of its words with the one before, and a few frequent
// words with all; beside a straightforward one with std::map and a list for each word. Items are
// queries or entries.
#include <benchmark/benchmark.h>
#include <gslam/vocabulary/database.h>

#include <algorithm>
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

using gslam::BowDatabase;
using gslam::BowVector;
using gslam::Scoring;

constexpr std::uint32_t kWordCount = 1000000;

// Words are as uneven as in images: the n-th is in an image about as often as 1 / n.
BowVector image(std::mt19937& generator, const BowVector& like, Scoring scoring) {
  std::uniform_real_distribution<double> exponent(0, std::log(double(kWordCount)));
  BowVector words = random_bags::bag(generator, 600, kWordCount, like, 30);
  std::map<std::uint32_t, double> bag;
  for (std::size_t i = 0; i < words.size(); ++i) bag[words.words[i]] = words.values[i];
  while (bag.size() < 726) {
    const auto rank = static_cast<std::uint32_t>(std::exp(exponent(generator)));
    bag[rank * 7919u % kWordCount] = 1;
  }
  BowVector bow;
  for (const auto& word : bag) {
    bow.words.push_back(word.first);
    bow.values.push_back(word.second);
  }
  normalize(bow, scoring);
  return bow;
}

const std::vector<BowVector>& images(Scoring scoring, std::size_t count) {
  static std::map<std::pair<Scoring, std::size_t>, std::vector<BowVector>> made;
  std::vector<BowVector>& bags = made[{scoring, count}];
  std::mt19937 generator(1);
  while (bags.size() < count) {
    bags.push_back(image(generator, bags.empty() ? BowVector() : bags.back(), scoring));
  }
  return bags;
}

void query(benchmark::State& state, Scoring scoring) {
  const auto& bags = images(scoring, static_cast<std::size_t>(state.range(0)));
  BowDatabase database(scoring);
  for (const BowVector& bow : bags) database.add(bow);
  std::vector<gslam::QueryResult> results;
  gslam::QueryOptions options;
  std::size_t i = 0;
  std::uint64_t common = 0;
  for (auto _ : state) {
    database.query(bags[i++ * 7 % bags.size()], options, results);
    benchmark::DoNotOptimize(results.data());
  }
  options.count = 0;
  for (const auto& result : database.query(bags[bags.size() / 2], options)) {
    common += result.common_words;
  }
  state.counters["common_words"] = static_cast<double>(common);
  state.SetItemsProcessed(state.iterations());
}

void add(benchmark::State& state) {
  const auto& bags = images(Scoring::l1, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    BowDatabase database(Scoring::l1);
    for (const BowVector& bow : bags) database.add(bow);
    benchmark::DoNotOptimize(database.size());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

// What one would write first: a list of entries for each word, sums in a std::map.
class MapDatabase {
 public:
  MapDatabase() : lists_(kWordCount) {}
  void add(const BowVector& bow) {
    for (std::size_t i = 0; i < bow.size(); ++i) {
      lists_[bow.words[i]].emplace_back(size_, bow.values[i]);
    }
    ++size_;
  }
  std::vector<std::pair<double, std::uint32_t>> query(const BowVector& bow) const {
    std::map<std::uint32_t, double> sums;
    for (std::size_t i = 0; i < bow.size(); ++i) {
      for (const auto& item : lists_[bow.words[i]]) {
        sums[item.first] += std::fabs(bow.values[i] - item.second) - bow.values[i] - item.second;
      }
    }
    std::vector<std::pair<double, std::uint32_t>> results;
    for (const auto& sum : sums) results.emplace_back(sum.second, sum.first);
    std::sort(results.begin(), results.end());
    if (results.size() > 10) results.resize(10);
    return results;
  }

 private:
  std::vector<std::vector<std::pair<std::uint32_t, double>>> lists_;
  std::uint32_t size_ = 0;
};

void queryOfMaps(benchmark::State& state) {
  const auto& bags = images(Scoring::l1, static_cast<std::size_t>(state.range(0)));
  MapDatabase database;
  for (const BowVector& bow : bags) database.add(bow);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(database.query(bags[i++ * 7 % bags.size()]));
  state.SetItemsProcessed(state.iterations());
}

const bool kAreRegistered = [] {
  for (const Scoring scoring : random_bags::scorings()) {
    const std::string name = std::string("database/query/") + gslam::scoringName(scoring);
    auto* const bench = benchmark::RegisterBenchmark(name.c_str(), query, scoring);
    bench->ArgName("entries")->Arg(200);
    if (scoring == Scoring::l1) bench->Arg(2000)->Arg(20000)->Unit(benchmark::kMicrosecond);
  }
  benchmark::RegisterBenchmark("database/query/l1/std::map", queryOfMaps)
      ->ArgName("entries")
      ->Arg(200)
      ->Arg(2000);
  benchmark::RegisterBenchmark("database/add", add)->ArgName("entries")->Arg(200)->Arg(2000);
  return true;
}();

}  // namespace
