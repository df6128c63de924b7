// The copy of DBoW2 in ORB-SLAM2 (github.com/raulmur/ORB_SLAM2), for its reader of text. Its
// namespace has another name here, beside the real DBoW2 in the same program.
#define DBoW2 OrbSlamDBoW2
#include <DBoW2/FORB.h>
#include <DBoW2/TemplatedVocabulary.h>

#include "dbow2.h"

namespace {

using Tree = DBow2Tree<DBoW2::TemplatedVocabulary<cv::Mat, DBoW2::FORB>, OrbAdapter>;

class Text : public DBow2Peer<Tree, DBoW2::BowVector, DBoW2::FeatureVector, OrbAdapter> {
 public:
  static constexpr const char* kEnding = ".txt";
  Text() = default;
  explicit Text(const Subject& subject) : DBow2Peer(subject), subject_(&subject) {}

  void save(const std::string& path) const { writeOrbSlamText(*subject_, path); }
  static std::unique_ptr<Text> load(const std::string& path) {
    auto loaded = std::make_unique<Text>();
    loaded->vocabulary_->loadFromTextFile(path);
    return loaded;
  }

 private:
  const Subject* subject_ = nullptr;
};

const auto kOrb6 =
    Cases<Text>("orb_slam2", "orb6", orb6).addLoad("load_orb_slam_text", Text::load).transform();

}  // namespace
