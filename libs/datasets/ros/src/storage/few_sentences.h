// Sentences of which a damaged file may give millions.
#ifndef GSLAM_DATASETS_ROS_SRC_STORAGE_FEW_SENTENCES_H
#define GSLAM_DATASETS_ROS_SRC_STORAGE_FEW_SENTENCES_H

#include <cstddef>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace ros {

/// Keeps the first ones, and counts the rest.
class FewSentences {
 public:
  void add(const std::string& sentence) {
    if (first_.size() < kMost) first_.push_back(sentence);
    ++count_;
  }
  bool empty() const noexcept { return count_ == 0; }

  /// Appends them, each behind the same words.
  void appendTo(std::vector<std::string>& sentences, const std::string& before) const {
    for (const std::string& one : first_) sentences.push_back(before + one);
    if (count_ == first_.size()) return;
    sentences.push_back(before + std::to_string(count_ - first_.size()) + " more of the same kind");
  }

 private:
  static constexpr std::size_t kMost = 10;
  std::vector<std::string> first_;
  std::size_t count_ = 0;
};

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_STORAGE_FEW_SENTENCES_H
