#include <gslam/base/simd.h>
#include <gslam/vocabulary/database.h>
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/orb_slam_text.h>
#include <gslam/vocabulary/train.h>
#include <gslam/vocabulary/transform.h>

#include "measure.h"

namespace {

class Ours {
 public:
  using Input = gslam::Descriptors;
  using Words = gslam::BowVector;
  static constexpr const char* kEnding = ".gvoc";
  static constexpr double kTolerance = 1e-12;
  static constexpr gslam::Scoring kScoring = gslam::Scoring::l1;

  explicit Ours(const Subject& subject) : Ours(subject.vocabulary) {}
  explicit Ours(const gslam::Vocabulary& vocabulary) : vocabulary_(vocabulary) {}

  void save(const std::string& path) const { saveVocabulary(vocabulary_, path); }
  static std::unique_ptr<Ours> load(const std::string& path) {
    return std::make_unique<Ours>(gslam::openVocabulary(path));
  }
  static std::unique_ptr<Ours> loadVerified(const std::string& path) {
    auto opened = load(path);
    gslam::verifyVocabulary(opened->vocabulary_, path);
    return opened;
  }

  static Input prepare(const Image& image) { return image.view(); }
  void transform(const Input& descriptors, std::uint32_t level) {
    gslam::transform(vocabulary_, descriptors, vocabulary_.depth() - level, bow_, features_,
                     memory_);
  }
  Bag bag() const {
    Bag bag;
    for (std::size_t i = 0; i < bow_.size(); ++i) bag[bow_.words[i]] = bow_.values[i];
    return bag;
  }
  Groups groups() const {
    Groups groups;
    for (std::size_t i = 0; i < features_.size(); ++i) {
      groups.emplace_back(features_.features.begin() + features_.begins[i],
                          features_.features.begin() + features_.begins[i + 1]);
    }
    return groups;
  }

  Words words(const Input& descriptors) const {
    Words bow;
    gslam::transform(vocabulary_, descriptors, bow);
    return bow;
  }
  double score(const Words& a, const Words& b) const { return gslam::score(kScoring, a, b); }

  class Database {
   public:
    explicit Database(const Ours& ours) : database_(ours.vocabulary_.scoring()) {}
    void add(const Words& words) { database_.add(words); }
    void query(const Words& words) { database_.query(words, options_, results_); }
    Found found() const {
      Found found;
      for (const gslam::QueryResult& result : results_) found.emplace_back(result.score, result.id);
      return found;
    }

   private:
    gslam::BowDatabase database_;
    gslam::QueryOptions options_;
    std::vector<gslam::QueryResult> results_;
  };

  static double train(const std::vector<Image>& images, std::uint32_t depth, unsigned threads) {
    std::vector<gslam::Descriptors> views;
    for (const Image& image : images) views.push_back(image.view());
    gslam::TrainingOptions options;
    options.depth = depth;
    options.parallel.threads = threads;
    return gslam::trainVocabulary(views, options).wordCount();
  }

 protected:
  gslam::Vocabulary vocabulary_;

 private:
  gslam::BowVector bow_;
  gslam::FeatureVector features_;
  gslam::TransformMemory memory_;
};

/// As the text that ORB-SLAM reads.
class Text : public Ours {
 public:
  static constexpr const char* kEnding = ".txt";
  using Ours::Ours;
  void save(const std::string& path) const { saveOrbSlamText(vocabulary_, path); }
  static std::unique_ptr<Text> load(const std::string& path) {
    return std::make_unique<Text>(gslam::loadVocabulary(path));
  }
};

const auto kOrb4 = Cases<Ours>("gslam", "orb4", orb4)
                       .load()
                       .addLoad("load_verified", Ours::loadVerified)
                       .save()
                       .transform()
                       .score()
                       .query()
                       .train(1)
                       .train(2);
const auto kOrb6 = Cases<Ours>("gslam", "orb6", orb6)
                       .load()
                       .addLoad("load_verified", Ours::loadVerified)
                       .save()
                       .transform()
                       .score()
                       .query()
                       .train(1)
                       .train(2);
const auto kSift4 = Cases<Ours>("gslam", "sift4", sift4)
                        .load()
                        .addLoad("load_verified", Ours::loadVerified)
                        .save()
                        .transform()
                        .train(1);
const auto kText = Cases<Text>("gslam", "orb6", orb6).addLoad("load_orb_slam_text", Text::load);

// The rest has no peer.

/// Ours as on processors that can do less: columns beside that of the best variant.
void transformWith(benchmark::State& state, gslam::Simd simd, const Subject& (*subject)()) {
  const gslam::ScopedSimd scope(simd);
  Ours ours(subject());
  std::size_t at = 0;
  for (auto _ : state) {
    ours.transform(subject().images[at].view(), 2);
    at = (at + 1) % kQueries;
  }
}

/// All images in one call, on some threads: the time of one.
void transformAllOf(benchmark::State& state, const Subject& (*subject)()) {
  std::vector<gslam::Descriptors> images;
  for (std::size_t i = 0; i < kQueries; ++i) images.push_back(subject().images[i].view());
  std::vector<gslam::BowVector> bows(kQueries);
  std::vector<gslam::FeatureVector> features(kQueries);
  gslam::ParallelOptions options;
  options.threads = static_cast<unsigned>(state.range(0));
  options.grain = 4;
  const gslam::Vocabulary& vocabulary = subject().vocabulary;
  for (auto _ : state) {
    transformAll(vocabulary, images, vocabulary.depth() - 2, bows, features, options);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kQueries));
}

const int kAlone = [] {
  const std::pair<const char*, const Subject& (*)()> subjects[] = {
      {"orb4", orb4}, {"orb6", orb6}, {"sift4", sift4}};
  for (const auto& subject : subjects) {
    for (const gslam::Simd simd : gslam::availableSimd()) {
      const std::string name =
          std::string("transform_") + subject.first + "/gslam_" + gslam::simdName(simd);
      benchmark::RegisterBenchmark(name.c_str(), transformWith, simd, subject.second)
          ->Unit(benchmark::kMicrosecond);
    }
    const std::string name = std::string("transform_all_") + subject.first + "/gslam";
    benchmark::RegisterBenchmark(name.c_str(), transformAllOf, subject.second)
        ->ArgName("n")
        ->Arg(1)
        ->Arg(2)
        ->UseRealTime()
        ->Unit(benchmark::kMicrosecond);
  }
  return 0;
}();

}  // namespace
