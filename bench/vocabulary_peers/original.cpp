// The vocabulary of the GSLAM of 2019 (github.com/zdzhaoyong/GSLAM). It has no database.
// Its vocabulary does not include all that it uses.
// clang-format off
#include <immintrin.h>
#include <GSLAM/core/Glog.h>
#include <GSLAM/core/Vocabulary.h>
// clang-format on

#include <cstring>

#include "measure.h"

namespace {

using Mat = GSLAM::TinyMat;

template <class Number>
Mat matOf(std::size_t rows, std::size_t columns, const Number* data) {
  return Mat(static_cast<int>(rows), static_cast<int>(columns), GSLAM::GImageType<Number>::Type,
             reinterpret_cast<unsigned char*>(const_cast<Number*>(data)));
}
Mat matOf(const Image& image) {
  return image.isBinary() ? matOf(image.count, 32, image.bytes.data())
                          : matOf(image.count, 128, image.floats.data());
}

class Peer {
 public:
  using Input = Mat;
  using Words = GSLAM::BowVector;
  static constexpr const char* kEnding = ".gbow";
  static constexpr double kTolerance = 1e-5;
  static constexpr gslam::Scoring kScoring = gslam::Scoring::l1;

  // Which distance is to be taken is set where a file is read, and nowhere else.
  explicit Peer(const Subject& subject) {
    const TemporaryFile file(subject.name + "_made.gbow");
    fill(subject);
    vocabulary_.save(file.path());
    vocabulary_.load(file.path());
  }
  explicit Peer(const std::string& path) { vocabulary_.load(path); }

  void save(const std::string& path) const { vocabulary_.save(path); }
  static std::unique_ptr<Peer> load(const std::string& path) {
    return std::make_unique<Peer>(path);
  }

  static Input prepare(const Image& image) { return matOf(image); }
  void transform(const Input& rows, int level) {
    vocabulary_.transform(rows, bow_, features_, vocabulary_.getDepthLevels() - level);
  }
  // Its words are places; after a file was read it is told which word of the subject is where.
  Bag bag() const {
    Bag bag;
    for (const auto& word : bow_) bag[words_.at(word.first)] = double(word.second);
    return bag;
  }
  Groups groups() const {
    Groups groups;
    for (const auto& node : features_) groups.push_back(node.second);
    return groups;
  }

  Words words(const Input& rows) const {
    Words bow;
    GSLAM::FeatureVector unread;
    vocabulary_.transform(rows, bow, unread, 0);
    return bow;
  }
  // Its score() is declared, but not defined.
  double score(const Words& a, const Words& b) const {
    return vocabulary_.m_scoring_object->score(a, b);
  }

  static double train(const std::vector<Image>& images, std::uint32_t depth, unsigned /*threads*/) {
    std::vector<Mat> all;
    for (const Image& image : images) all.push_back(matOf(image));
    return GSLAM::Vocabulary::create(all, 10, int(depth))->size();
  }

 private:
  // A node's children stand at K times its place, from 1 on: full, whether they are there or not.
  void fill(const Subject& subject) {
    const gslam::detail::TreeData& tree = subject.tree;
    const std::size_t row = bytesOf(tree.format);
    std::size_t count = 1, level = 1;
    for (std::uint32_t i = 0; i < tree.depth; ++i) count += level *= 10;
    words_.clear();
    vocabulary_.m_k = 10;
    vocabulary_.m_L = static_cast<int>(tree.depth);
    vocabulary_.m_nodes.resize(count);
    const int type = subject.feature == Feature::orb ? int(GSLAM::GImageType<unsigned char>::Type)
                                                     : int(GSLAM::GImageType<float>::Type);
    vocabulary_.m_nodeDescriptors =
        Mat(static_cast<int>(count), static_cast<int>(tree.format.size), type, nullptr, false, 32);
    std::map<std::uint32_t, std::size_t> place = {{0, 0}};
    for (std::size_t i = 0; i < tree.ids.size(); ++i) {
      const std::size_t parent = place.at(tree.parents[i]);
      const std::size_t at = parent * 10 + 1 + vocabulary_.m_nodes[parent].childNum++;
      place[tree.ids[i]] = at;
      vocabulary_.m_nodes[at].weight = static_cast<float>(tree.weights[i]);
      std::memcpy(vocabulary_.m_nodeDescriptors.data + at * row, &tree.descriptors[i * row], row);
      if (tree.words[i] != gslam::detail::kNone) words_[at] = tree.words[i];
    }
  }

  GSLAM::Vocabulary vocabulary_;
  static std::map<std::size_t, std::uint32_t> words_;
  GSLAM::BowVector bow_;
  GSLAM::FeatureVector features_;
};

std::map<std::size_t, std::uint32_t> Peer::words_;

const auto kOrb4 = Cases<Peer>("original", "orb4", orb4)
                       .load()
                       .addLoad("load_verified", Peer::load)
                       .save()
                       .transform()
                       .score()
                       .train(1);
const auto kOrb6 = Cases<Peer>("original", "orb6", orb6)
                       .load()
                       .addLoad("load_verified", Peer::load)
                       .save()
                       .transform()
                       .score()
                       .train(1);
const auto kSift4 = Cases<Peer>("original", "sift4", sift4)
                        .load()
                        .addLoad("load_verified", Peer::load)
                        .save()
                        .transform()
                        .train(1);

}  // namespace
