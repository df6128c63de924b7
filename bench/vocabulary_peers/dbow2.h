// DBoW2 (github.com/dorian3d/DBoW2) and the copy of it in ORB-SLAM2, which reads text: they differ
// in little, but have the same names.
#ifndef GSLAM_BENCH_VOCABULARY_PEERS_DBOW2_H
#define GSLAM_BENCH_VOCABULARY_PEERS_DBOW2_H

#include <memory>
#include <string>
#include <vector>

#include "measure.h"
#include "opencv_image.h"

/// What DBoW2 makes of a tree, which its members are filled with.
template <class Vocabulary, class Adapter>
class DBow2Tree : public Vocabulary {
 public:
  DBow2Tree() = default;
  explicit DBow2Tree(const gslam::detail::TreeData& data) : Vocabulary(10, int(data.depth)) {
    const auto descriptor = [&](const std::uint8_t* at) { return Adapter::at(data.format, at); };
    fillDBow(data, descriptor, this->m_nodes, this->m_words);
  }
};

/// @tparam Tree     a DBow2Tree
/// @tparam Bow      its BowVector
/// @tparam Features its FeatureVector
/// @tparam Adapter  its descriptors: `Descriptor`, `at(format, bytes)`, `of(image)`
template <class Tree, class Bow, class Features, class Adapter>
class DBow2Peer {
 public:
  using Input = std::vector<typename Adapter::Descriptor>;
  using Words = Bow;
  static constexpr double kTolerance = 1e-12;
  static constexpr gslam::Scoring kScoring = gslam::Scoring::l1;

  DBow2Peer() : vocabulary_(new Tree) {}
  explicit DBow2Peer(const Subject& subject) : vocabulary_(new Tree(subject.tree)) {}

  static Input prepare(const Image& image) { return Adapter::of(image); }
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

 protected:
  std::unique_ptr<Tree> vocabulary_;

 private:
  Bow bow_;
  Features features_;
};

/// Descriptors of ORB.
struct OrbAdapter {
  using Descriptor = cv::Mat;
  static cv::Mat at(const gslam::DescriptorFormat& format, const std::uint8_t* bytes) {
    return descriptorAt(format, bytes);
  }
  static std::vector<cv::Mat> of(const Image& image) { return rowsOf(matOf(image)); }
  /// That may be overwritten.
  static std::vector<cv::Mat> copyOf(const Image& image) { return rowsOf(matOf(image).clone()); }
};

#endif  // GSLAM_BENCH_VOCABULARY_PEERS_DBOW2_H
