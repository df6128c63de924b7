// DBoW2. Its reader of YAML takes the nodes of a sequence by their number, for which OpenCV goes
// through all before: four times the time for twice the nodes. `dbow2_repaired` is the same with
// iterators, the only way to measure the large tree.
#include "dbow2.h"

#include <DBoW2/DBoW2.h>

#include <sstream>

namespace {

// SIFT for DBoW2, which has none: as its class for SURF.
class FSift {
 public:
  using TDescriptor = std::vector<float>;
  using pDescriptor = const TDescriptor*;

  static void meanValue(const std::vector<pDescriptor>& descriptors, TDescriptor& mean) {
    mean.assign(128, 0);
    const float count = static_cast<float>(descriptors.size());
    for (const pDescriptor descriptor : descriptors) {
      for (std::size_t i = 0; i < 128; ++i) mean[i] += (*descriptor)[i] / count;
    }
  }
  static double distance(const TDescriptor& a, const TDescriptor& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 128; i += 4) {
      sum += (a[i] - b[i]) * (a[i] - b[i]);
      sum += (a[i + 1] - b[i + 1]) * (a[i + 1] - b[i + 1]);
      sum += (a[i + 2] - b[i + 2]) * (a[i + 2] - b[i + 2]);
      sum += (a[i + 3] - b[i + 3]) * (a[i + 3] - b[i + 3]);
    }
    return sum;
  }
  static std::string toString(const TDescriptor& descriptor) {
    std::stringstream text;
    text.precision(9);
    for (const float value : descriptor) text << value << " ";
    return text.str();
  }
  static void fromString(TDescriptor& descriptor, const std::string& text) {
    std::stringstream numbers(text);
    descriptor.resize(128);
    for (float& value : descriptor) numbers >> value;
  }
};

struct SiftAdapter {
  using Descriptor = std::vector<float>;
  static Descriptor at(const gslam::DescriptorFormat& format, const std::uint8_t* bytes) {
    Descriptor descriptor(format.size);
    std::memcpy(descriptor.data(), bytes, bytesOf(format));
    return descriptor;
  }
  static std::vector<Descriptor> of(const Image& image) {
    std::vector<Descriptor> all;
    for (auto row = image.floats.begin(); row != image.floats.end(); row += 128) {
      all.emplace_back(row, row + 128);
    }
    return all;
  }
  static std::vector<Descriptor> copyOf(const Image& image) { return of(image); }
};

template <class F, class Adapter, bool kIsRepaired>
class Tree
    : public DBow2Tree<DBoW2::TemplatedVocabulary<typename Adapter::Descriptor, F>, Adapter> {
 public:
  using Base = DBow2Tree<DBoW2::TemplatedVocabulary<typename Adapter::Descriptor, F>, Adapter>;
  using Base::Base;
  using Base::load;

  void load(const cv::FileStorage& file, const std::string& name) override {
    if (!kIsRepaired) return Base::load(file, name);
    const cv::FileNode root = file[name], nodes = root["nodes"], words = root["words"];
    this->m_k = root["k"];
    this->m_L = root["L"];
    this->m_scoring = static_cast<DBoW2::ScoringType>(int(root["scoringType"]));
    this->m_weighting = static_cast<DBoW2::WeightingType>(int(root["weightingType"]));
    this->createScoringObject();
    this->m_nodes.resize(nodes.size() + 1);
    for (const cv::FileNode& item : nodes) {
      const DBoW2::NodeId id = DBoW2::NodeId(int(item["nodeId"]));
      auto& node = this->m_nodes[id];
      node.id = id;
      node.parent = DBoW2::NodeId(int(item["parentId"]));
      node.weight = double(item["weight"]);
      this->m_nodes[node.parent].children.push_back(id);
      F::fromString(node.descriptor, std::string(item["descriptor"]));
    }
    this->m_words.resize(words.size());
    for (const cv::FileNode& item : words) {
      const DBoW2::WordId word = DBoW2::WordId(int(item["wordId"]));
      this->m_words[word] = &this->m_nodes[std::size_t(int(item["nodeId"]))];
      this->m_words[word]->word_id = word;
    }
  }
};

template <class F, class Adapter, bool kIsRepaired = false>
class Peer : public DBow2Peer<Tree<F, Adapter, kIsRepaired>, DBoW2::BowVector, DBoW2::FeatureVector,
                              Adapter> {
 public:
  using Base =
      DBow2Peer<Tree<F, Adapter, kIsRepaired>, DBoW2::BowVector, DBoW2::FeatureVector, Adapter>;
  static constexpr const char* kEnding = ".yml";
  using Base::Base;

  void save(const std::string& path) const { this->vocabulary_->save(path); }
  static std::unique_ptr<Peer> load(const std::string& path) {
    auto loaded = std::make_unique<Peer>();
    loaded->vocabulary_->load(path);
    return loaded;
  }

  class Database {
   public:
    explicit Database(const Peer& peer) : database_(*peer.vocabulary_, false, 0) {}
    void add(const DBoW2::BowVector& words) { database_.add(words); }
    void query(const DBoW2::BowVector& words) { database_.query(words, results_, 10); }
    Found found() const {
      Found found;
      for (const DBoW2::Result& result : results_) found.emplace_back(result.Score, result.Id);
      return found;
    }

   private:
    DBoW2::TemplatedDatabase<typename Adapter::Descriptor, F> database_;
    DBoW2::QueryResults results_;
  };

  // It overwrites the descriptors, so it gets its own.
  static double train(const std::vector<Image>& images, std::uint32_t depth, unsigned /*threads*/) {
    std::vector<typename Base::Input> all;
    for (const Image& image : images) all.push_back(Adapter::copyOf(image));
    DBoW2::TemplatedVocabulary<typename Adapter::Descriptor, F> vocabulary(10, int(depth));
    vocabulary.create(all);
    return vocabulary.size();
  }
};

using Orb = Peer<DBoW2::FORB, OrbAdapter>;
using RepairedOrb = Peer<DBoW2::FORB, OrbAdapter, true>;
using Sift = Peer<FSift, SiftAdapter>;
using RepairedSift = Peer<FSift, SiftAdapter, true>;

const auto kOrb4 = Cases<Orb>("dbow2", "orb4", orb4).save().transform().score().query().train(1);
const auto kOrb6 = Cases<Orb>("dbow2", "orb6", orb6).transform().score().query().train(1);
const auto kSift4 = Cases<Sift>("dbow2", "sift4", sift4).save().transform().train(1);
const auto kRepairedOrb4 = Cases<RepairedOrb>("dbow2_repaired", "orb4", orb4).load();
const auto kRepairedSift4 = Cases<RepairedSift>("dbow2_repaired", "sift4", sift4).load();

const int kSlow = [] {
  if (!isPatient()) return 0;
  Cases<Orb>("dbow2", "orb4", orb4).load();
  Cases<Orb>("dbow2", "orb6", orb6).save();
  Cases<RepairedOrb>("dbow2_repaired", "orb6", orb6).load();
  return 0;
}();

}  // namespace
