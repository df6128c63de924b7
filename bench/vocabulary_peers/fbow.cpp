// FBoW (github.com/rmsalinas/fbow). It has no database.
#include <fbow/fbow.h>
#include <fbow/vocabulary_creator.h>

#include <cstring>
#include <fstream>

#include "measure.h"
#include "opencv_image.h"

namespace {

// A tree as the file that it writes: the members are private.
//
// A block holds the children of a node: how many they are (2 bytes), whether all are leaves (2),
// the number of the block in a list of its own (4), then the descriptors from an aligned place on,
// and for each child 4 bytes, a word with the highest bit set or the block of its children, and the
// weight as a float.
class BlockFile {
 public:
  explicit BlockFile(const gslam::detail::TreeData& tree)
      : tree_(tree),
        is_binary_(tree.format.type == gslam::DescriptorType::binary),
        row_(bytesOf(tree.format)) {
    facts_.alignment = is_binary_ ? 8 : 32;
    facts_.descriptor_stride = padded(row_);
    facts_.descriptors_at = padded(8);
    facts_.children_at = facts_.descriptors_at + kBranching * facts_.descriptor_stride;
    facts_.block_size = padded(facts_.children_at + kBranching * 8);
    facts_.type = is_binary_ ? CV_8UC1 : CV_32FC1;
    facts_.descriptor_size = static_cast<std::int32_t>(row_);
    facts_.branching = kBranching;
    addBlocks();
  }

  void write(const std::string& path) {
    facts_.block_count = static_cast<std::uint32_t>(blocks_.size() / facts_.block_size);
    facts_.total_size = blocks_.size();
    std::ofstream file(path, std::ios::binary);
    const std::uint64_t signature = 55824124;
    file.write(reinterpret_cast<const char*>(&signature), sizeof signature);
    file.write(reinterpret_cast<const char*>(&facts_), sizeof facts_);
    file.write(blocks_.data(), static_cast<std::streamsize>(blocks_.size()));
  }

 private:
  static constexpr std::uint32_t kBranching = 10;
  struct Facts {
    char name[50] = {};
    std::uint32_t alignment = 0, block_count = 0;
    std::uint64_t descriptor_stride = 0, block_size = 0, descriptors_at = 0, children_at = 0;
    std::uint64_t total_size = 0;
    std::int32_t type = 0, descriptor_size = 0;
    std::uint32_t branching = 0;
  };
  static_assert(sizeof(Facts) == 120, "as in the file");

  std::uint64_t padded(std::uint64_t size) const {
    return (size + facts_.alignment - 1) / facts_.alignment * facts_.alignment;
  }

  // The list is breadth first, so children stand behind their parents, and side by side.
  void addBlocks() {
    std::map<std::uint32_t, std::uint32_t> block_of = {{0, 0}};
    addBlock();
    for (std::size_t i = 0; i < tree_.ids.size(); ++i) {
      char* const block = &blocks_[block_of.at(tree_.parents[i]) * facts_.block_size];
      std::uint16_t count;
      std::memcpy(&count, block, sizeof count);
      std::uint32_t child = tree_.words[i] | 0x80000000U;
      if (tree_.words[i] == gslam::detail::kNone) {
        child = static_cast<std::uint32_t>(block_of.size());
        block_of[tree_.ids[i]] = child;
      }
      const float weight = static_cast<float>(tree_.weights[i]);
      std::memcpy(block + facts_.descriptors_at + count * facts_.descriptor_stride,
                  &tree_.descriptors[i * row_], row_);
      std::memcpy(block + facts_.children_at + count * 8U, &child, sizeof child);
      std::memcpy(block + facts_.children_at + count * 8U + 4, &weight, sizeof weight);
      ++count;
      std::memcpy(block, &count, sizeof count);
      while (blocks_.size() < block_of.size() * facts_.block_size) addBlock();
    }
  }
  void addBlock() { blocks_.resize(blocks_.size() + facts_.block_size); }

  const gslam::detail::TreeData& tree_;
  bool is_binary_;
  std::size_t row_;
  Facts facts_;
  std::vector<char> blocks_;
};

class Peer {
 public:
  using Input = cv::Mat;
  using Words = fbow::fBow;
  static constexpr const char* kEnding = ".fbow";
  static constexpr double kTolerance = 1e-5;
  static constexpr gslam::Scoring kScoring = gslam::Scoring::l2;

  explicit Peer(const Subject& subject) {
    const TemporaryFile file(subject.name + "_made.fbow");
    BlockFile(subject.tree).write(file.path());
    vocabulary_.readFromFile(file.path());
  }
  explicit Peer(const std::string& path) { vocabulary_.readFromFile(path); }

  void save(const std::string& path) { vocabulary_.saveToFile(path); }
  static std::unique_ptr<Peer> load(const std::string& path) {
    return std::make_unique<Peer>(path);
  }

  static Input prepare(const Image& image) { return matOf(image); }
  void transform(const Input& rows, int level) {
    vocabulary_.transform(rows, level, bow_, features_);
  }
  Bag bag() const {
    Bag bag;
    for (const auto& word : bow_) bag[word.first] = double(word.second.var);
    return bag;
  }
  // Words without weight are in it, too.
  Groups groups() const {
    Groups groups;
    for (const auto& node : features_) groups.push_back(node.second);
    return groups;
  }

  Words words(const Input& rows) { return vocabulary_.transform(rows); }
  double score(const Words& a, const Words& b) const { return fbow::fBow::score(a, b); }

  static double train(const std::vector<Image>& images, std::uint32_t depth, unsigned threads) {
    std::vector<cv::Mat> all;
    for (const Image& image : images) all.push_back(matOf(image));
    fbow::Vocabulary vocabulary;
    fbow::VocabularyCreator creator;
    creator.create(vocabulary, all, "", fbow::VocabularyCreator::Params(10, int(depth), threads));
    return static_cast<double>(vocabulary.size());
  }

 private:
  fbow::Vocabulary vocabulary_;
  fbow::fBow bow_;
  fbow::fBow2 features_;
};

const auto kOrb4 = Cases<Peer>("fbow", "orb4", orb4)
                       .load()
                       .addLoad("load_verified", Peer::load)
                       .save()
                       .transform()
                       .score()
                       .train(1)
                       .train(2);
const auto kOrb6 = Cases<Peer>("fbow", "orb6", orb6)
                       .load()
                       .addLoad("load_verified", Peer::load)
                       .save()
                       .transform()
                       .score()
                       .train(1)
                       .train(2);
const auto kSift4 = Cases<Peer>("fbow", "sift4", sift4)
                        .load()
                        .addLoad("load_verified", Peer::load)
                        .save()
                        .transform()
                        .train(1);

}  // namespace
