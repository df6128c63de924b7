// Collects what there is to say of a dataset.
#ifndef GSLAM_DATASETS_SRC_READING_REMARKS_H
#define GSLAM_DATASETS_SRC_READING_REMARKS_H

#include <gslam/datasets/export.h>

#include <cstddef>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace reading {

/// Sentences for DatasetInfo::remarks. What is skipped is counted by its reason, and listed:
///
///     remarks.skip("images that do not exist", "cam1/data/1403.png (cam1/data.csv:12)");
///
/// becomes "skipped 3 images that do not exist: a, b, c"; of many the first and last are
/// named.
class GSLAM_DATASETS_EXPORT Remarks {  // for packages inside of this library's folder
 public:
  /// Adds a sentence, without a full stop at its end; one that is there already is not repeated.
  void say(const std::string& sentence);
  /// Counts a thing that is skipped.
  /// @param things  what it is and why, in the plural
  /// @param which   this one: file, line or stamp
  void skip(const std::string& things, const std::string& which);
  /// How many of these were skipped so far.
  std::size_t skipped(const std::string& things) const noexcept;
  /// All sentences, in the order of the first of each.
  std::vector<std::string> sentences() const;
  /// The same as lines to put behind an error whose reason they may be; each begins with "\n  ".
  std::string asReason() const;

 private:
  struct Entry {
    std::string text;
    std::size_t count = 0;  // 0: a sentence
    std::vector<std::string> first;
    std::string last;
  };
  std::vector<Entry> entries_;
};

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_REMARKS_H
