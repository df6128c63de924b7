// DBoW3 (github.com/rmsalinas/DBow3).
#include <DBoW3/DBoW3.h>

#include <iostream>

#include "measure.h"
#include "opencv_image.h"

namespace {

// What it makes of a tree, which its members are filled with.
class Tree : public DBoW3::Vocabulary {
 public:
  using DBoW3::Vocabulary::Vocabulary;
  explicit Tree(const gslam::detail::TreeData& data) : Vocabulary(10, int(data.depth)) {
    const auto descriptor = [&](const std::uint8_t* at) { return descriptorAt(data.format, at); };
    fillDBow(data, descriptor, m_nodes, m_words);
  }
};

class Peer {
 public:
  using Input = std::vector<cv::Mat>;
  using Words = DBoW3::BowVector;
  static constexpr const char* kEnding = ".dbow3";
  static constexpr double kTolerance = 1e-12;
  static constexpr gslam::Scoring kScoring = gslam::Scoring::l1;

  explicit Peer(const Subject& subject) : vocabulary_(new Tree(subject.tree)) {}
  explicit Peer(const std::string& path) : vocabulary_(new Tree) { vocabulary_->load(path); }

  void save(const std::string& path) const { vocabulary_->save(path, false); }
  static std::unique_ptr<Peer> load(const std::string& path) {
    return std::make_unique<Peer>(path);
  }

  static Input prepare(const Image& image) { return rowsOf(matOf(image)); }
  void transform(const Input& rows, int level) {
    vocabulary_->transform(rows, bow_, features_, vocabulary_->getDepthLevels() - level);
  }
  Bag bag() const { return Bag(bow_.begin(), bow_.end()); }
  Groups groups() const {
    Groups groups;
    for (const auto& node : features_) groups.push_back(node.second);
    return groups;
  }

  Words words(const Input& rows) const {
    Words bow;
    vocabulary_->transform(rows, bow);
    return bow;
  }
  double score(const Words& a, const Words& b) const { return vocabulary_->score(a, b); }

  class Database {
   public:
    explicit Database(const Peer& peer) : database_(*peer.vocabulary_, false, 0) {}
    void add(const Words& words) { database_.add(words); }
    void query(const Words& words) { database_.query(words, results_, 10); }
    Found found() const {
      Found found;
      for (const DBoW3::Result& result : results_) found.emplace_back(result.Score, result.Id);
      return found;
    }

   private:
    DBoW3::Database database_;
    DBoW3::QueryResults results_;
  };

  // It overwrites the descriptors, so it gets its own.
  static double train(const std::vector<Image>& images, std::uint32_t depth, unsigned /*threads*/) {
    std::vector<cv::Mat> all;
    for (const Image& image : images) all.push_back(matOf(image).clone());
    DBoW3::Vocabulary vocabulary(10, int(depth));
    vocabulary.create(all);
    return vocabulary.size();
  }

 protected:
  std::unique_ptr<Tree> vocabulary_;

 private:
  DBoW3::BowVector bow_;
  DBoW3::FeatureVector features_;
};

/// From the text of ORB-SLAM, with weights as floats. The progress that it prints is left out.
class Text : public Peer {
 public:
  static constexpr double kTolerance = 1e-6;
  static constexpr const char* kEnding = ".txt";
  using Peer::Peer;
  explicit Text(const Subject& subject) : Peer(subject), subject_(&subject) {}
  void save(const std::string& path) const { writeOrbSlamText(*subject_, path); }
  static std::unique_ptr<Text> load(const std::string& path) {
    std::streambuf* const output = std::cerr.rdbuf(nullptr);
    auto loaded = std::make_unique<Text>(path);
    std::cerr.rdbuf(output);
    return loaded;
  }

 private:
  const Subject* subject_ = nullptr;
};

const auto kOrb4 = Cases<Peer>("dbow3", "orb4", orb4)
                       .load()
                       .addLoad("load_verified", Peer::load)
                       .save()
                       .transform()
                       .score()
                       .query()
                       .train(1);
const auto kOrb6 = Cases<Peer>("dbow3", "orb6", orb6)
                       .load()
                       .addLoad("load_verified", Peer::load)
                       .save()
                       .transform()
                       .score()
                       .query()
                       .train(1);
const auto kSift4 = Cases<Peer>("dbow3", "sift4", sift4)
                        .load()
                        .addLoad("load_verified", Peer::load)
                        .save()
                        .transform()
                        .train(1);
const auto kText = Cases<Text>("dbow3", "orb6", orb6).addLoad("load_orb_slam_text", Text::load);

}  // namespace
