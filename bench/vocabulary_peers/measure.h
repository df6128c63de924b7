// One measurement for all: the same trees, the same images. What an implementation finds is
// compared with what plain loops find before any time is taken.
//
// Peers are compiled with flags that we are not. So nothing of ours that is measured may be
// included here: of an inline function the linker takes any copy.
#ifndef GSLAM_BENCH_VOCABULARY_PEERS_MEASURE_H
#define GSLAM_BENCH_VOCABULARY_PEERS_MEASURE_H

#include <benchmark/benchmark.h>
#include <gslam/vocabulary/weighting.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "subject.h"

/// Whether to measure also what takes many seconds: training, and DBoW2's YAML of the large tree.
inline bool isPatient() {
  return std::getenv("GSLAM_PEERS_SLOW") != nullptr;
}

/// Bytes that malloc() has given out and not got back, in all threads.
inline std::size_t heapBytes() {
  const auto now = mallinfo2();
  return now.uordblks + now.hblkhd;
}

/// A file for one row, gone at the end.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name) : path_(cacheFolder() + "now_" + name) {}
  ~TemporaryFile() { std::remove(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A score, and the number of the entry.
using Found = std::vector<std::pair<double, std::size_t>>;

/// Registers the rows of one implementation on one subject, `load_orb4/dbow3` and so on. Only the
/// members for those rows that are asked for need be there.
///
///     const auto kOrb4 = Cases<Orb>("dbow3", "orb4", orb4).load().save().transform();
///
/// @tparam Peer  a vocabulary of the implementation:
///   - `explicit Peer(const Subject&)` is the tree of the subject
///   - `void save(path)`; `static std::unique_ptr<Peer> load(path)`
///   - `Input prepare(const Image&)`: descriptors as it wants them
///   - `void transform(const Input&, level)` makes the bag and the features by nodes of that level
///     (the root is 0) and keeps them; `Bag bag()` and `Groups groups()` tell
///   - `Words words(const Input&)`: a bag of its own kind, to `score(a, b)`
///   - `Database` with `add(words)` and `query(words)`, made of a Peer; `Found found()` tells
///   - `static double train(const std::vector<Image>&, L, threads)`; the result is what it calls
///   the
///     size of a vocabulary: its words, but for FBoW, which counts blocks
///   - `kTolerance` of values, relative; `kScoring` of words
template <class Peer>
class Cases {
 public:
  using State = benchmark::State;
  using Row = benchmark::internal::Benchmark;

  Cases(const char* name, const char* subject_name, const Subject& (*subject)())
      : name_(name), subject_name_(subject_name), subject_(subject) {}

  /// From a file of its own format, until it can be used. Destroying it is not counted.
  Cases load() const { return addLoad("load", Peer::load); }

  /// The same, by another function.
  Cases addLoad(const char* row, std::unique_ptr<Peer> (*function)(const std::string&)) const {
    const auto subject = subject_;
    add(row, [subject, function](State& state) { measureLoad(state, subject(), function); });
    return *this;
  }

  /// Into a file that is there already.
  Cases save() const {
    const auto subject = subject_;
    add("save", [subject](State& state) {
      const TemporaryFile file(subject().name);
      Peer peer(subject());
      for (auto _ : state) peer.save(file.path());
    });
    return *this;
  }

  /// An image of 1000 descriptors to its bag of words and its features by nodes.
  Cases transform() const {
    const auto subject = subject_;
    add("transform", [subject](State& state) { measureTransform(state, subject()); });
    return *this;
  }

  /// Two bags of words.
  Cases score() const {
    const auto subject = subject_;
    add("score", [subject](State& state) { measureScore(state, subject()); });
    return *this;
  }

  /// The ten most like entries of 200.
  Cases query() const {
    const auto subject = subject_;
    add("query", [subject](State& state) { measureQuery(state, subject()); });
    return *this;
  }

  /// The same tree from the descriptors, on some threads; all of their time counts.
  Cases train(unsigned threads) const {
    if (!isPatient()) return *this;
    const auto subject = subject_;
    const std::string name = "train_" + std::to_string(threads) + "_threads";
    add(name.c_str(),
        [subject, threads](State& state) {
          const std::vector<Image> images = trainingImages(subject());
          for (auto _ : state) {
            state.counters["size"] = Peer::train(images, subject().vocabulary.depth(), threads);
          }
        })
        ->MeasureProcessCPUTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
    return *this;
  }

 private:
  template <class Function>
  Row* add(const char* row, const Function& function) const {
    const std::string name = std::string(row) + "_" + subject_name_ + "/" + name_;
    return benchmark::RegisterBenchmark(name.c_str(), function)->Unit(benchmark::kMicrosecond);
  }

  static void measureLoad(State& state, const Subject& subject,
                          std::unique_ptr<Peer> (*function)(const std::string&)) {
    const TemporaryFile file(subject.name + Peer::kEnding);
    Peer(subject).save(file.path());
    const std::size_t heap_before = heapBytes();
    std::unique_ptr<Peer> loaded = function(file.path());
    state.counters["heap_MB"] = static_cast<double>(heapBytes() - heap_before) / 1e6;
    if (!isRight(state, subject, *loaded)) return;
    for (auto _ : state) {
      state.PauseTiming();
      loaded.reset();
      state.ResumeTiming();
      loaded = function(file.path());
    }
  }

  // Says what is wrong.
  static bool isRight(State& state, const Subject& subject, Peer& peer) {
    // Floats that a peer rounds may make another child seem nearer: few do, and change the sum of
    // all values a little.
    const bool is_exact = subject.feature == Feature::orb;
    const std::size_t most_differences = is_exact ? 0 : 10;
    const double tolerance = is_exact ? Peer::kTolerance : 0.01;
    std::size_t differences = 0;
    for (std::size_t i = 0; i < kQueries; ++i) {
      peer.transform(peer.prepare(subject.images[i]), 2);
      const std::size_t found =
          countDifferences(normalized(peer.bag()), subject.bags[i], tolerance);
      const bool has_groups = !is_exact || groupsOf(peer) == subject.groups[i];
      differences += found;
      if (found <= most_differences && has_groups) continue;
      state.SkipWithError(("image " + std::to_string(i) + ": " + std::to_string(found) +
                           " words differ" + (has_groups ? "" : ", and features by nodes"))
                              .c_str());
      return false;
    }
    state.counters["differences"] = static_cast<double>(differences) / double(kQueries);
    return true;
  }
  static Groups groupsOf(const Peer& peer) {
    Groups groups = peer.groups();
    std::sort(groups.begin(), groups.end());
    return groups;
  }

  static void measureTransform(State& state, const Subject& subject) {
    Peer peer(subject);
    if (!isRight(state, subject, peer)) return;
    std::vector<typename Peer::Input> inputs;
    for (std::size_t i = 0; i < kQueries; ++i) inputs.push_back(peer.prepare(subject.images[i]));
    std::size_t at = 0;
    for (auto _ : state) {
      peer.transform(inputs[at], 2);
      at = (at + 1) % kQueries;
    }
  }

  static bool isNear(double score, double right) { return std::fabs(score - right) < 1e-5; }

  static void measureScore(State& state, const Subject& subject) {
    Peer peer(subject);
    std::vector<typename Peer::Words> bags;
    std::size_t words = 0;
    for (std::size_t i = 0; i < kQueries; ++i) {
      bags.push_back(peer.words(peer.prepare(subject.images[i])));
      words += bags.back().size();
    }
    for (std::size_t i = 1; i < kQueries; ++i) {
      const double right = rightScore(subject, Peer::kScoring, i - 1, i);
      if (isNear(peer.score(bags[i - 1], bags[i]), right)) continue;
      return state.SkipWithError(("the score of image " + std::to_string(i) + " is wrong").c_str());
    }
    std::size_t at = 1;
    for (auto _ : state) {
      benchmark::DoNotOptimize(peer.score(bags[at - 1], bags[at]));
      at = at + 1 == kQueries ? 1 : at + 1;
    }
    state.counters["words"] = static_cast<double>(words) / double(kQueries);
  }

  static void measureQuery(State& state, const Subject& subject) {
    Peer peer(subject);
    typename Peer::Database database(peer);
    for (std::size_t i = kQueries; i < kQueries + kEntries; ++i) {
      database.add(peer.words(peer.prepare(subject.images[i])));
    }
    std::vector<typename Peer::Words> queries;
    for (std::size_t i = 0; i < kQueries; ++i) {
      queries.push_back(peer.words(peer.prepare(subject.images[i])));
      database.query(queries[i]);
      const Found found = database.found();
      const std::vector<double> right = rightResults(subject, Peer::kScoring, i);
      const bool is_right =
          found.size() == right.size() &&
          std::equal(found.begin(), found.end(), right.begin(),
                     [](const auto& one, double score) { return isNear(one.first, score); });
      if (is_right) continue;
      return state.SkipWithError(("query " + std::to_string(i) + " finds others").c_str());
    }
    std::size_t at = 0;
    for (auto _ : state) {
      database.query(queries[at]);
      at = (at + 1) % kQueries;
    }
  }

  const char* name_;
  const char* subject_name_;
  const Subject& (*subject_)();
};

#endif  // GSLAM_BENCH_VOCABULARY_PEERS_MEASURE_H
