#ifndef GSLAM_VOCABULARY_ORB_SLAM_TEXT_H
#define GSLAM_VOCABULARY_ORB_SLAM_TEXT_H

#include <gslam/base/detail/new_file.h>
#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/write_orb_text.h>
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstddef>
#include <string>

/// @file
/// Vocabularies as text, as ORB-SLAM has them: ORBvoc.txt. loadVocabulary() reads them.

namespace gslam {
inline namespace v1 {

/// Writes a vocabulary for ORB-SLAM, ORB-SLAM2, ORB-SLAM3 and DBoW3. Words, weights (to the bit),
/// the order of children, which decides ties, and K, L, weighting and scoring stay as they are. So
/// do ids of nodes where they ascend as words do, which is so for what DBoW2, DBoW3 and this
/// library train; else nodes are numbered anew.
///
/// ORB-SLAM itself reads descriptors of 32 bytes alone. The file appears when it is complete, in
/// place of one that was there.
/// @throws FileError when it cannot be written; ArgumentError when the format cannot hold the
///         vocabulary: it is empty, has no binary descriptors, K over 20 or L over 10, or children
///         whose words are not in their order; ParseError when it is damaged
inline void saveOrbSlamText(const Vocabulary& vocabulary, const std::string& path) {
  const auto refuse = [](const std::string& reason) {
    throw ArgumentError("vocabulary", "cannot be written as ORB-SLAM's text: " + reason);
  };
  if (vocabulary.empty()) refuse("it is empty");
  const DescriptorType type = vocabulary.format().type;
  if (type != DescriptorType::binary) {
    refuse("its descriptors are " + std::string(descriptorTypeName(type)) + ", expected binary");
  }
  if (vocabulary.branching() > 20 || vocabulary.depth() > 10) {
    refuse("K is " + std::to_string(vocabulary.branching()) + " and L is " +
           std::to_string(vocabulary.depth()) + ", but ORB-SLAM reads up to 20 and 10");
  }
  verifyVocabulary(vocabulary);
  const detail::TreeData data = detail::treeDataOf(vocabulary);
  detail::OrbTextWriter writer(data);
  detail::NewFile file(path);
  writer.write([&file](const char* text, std::size_t size) { file.write(text, size); });
  file.commit();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_ORB_SLAM_TEXT_H
