#ifndef GSLAM_VOCABULARY_FILE_H
#define GSLAM_VOCABULARY_FILE_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/checksum.h>
#include <gslam/vocabulary/detail/file_target.h>
#include <gslam/vocabulary/detail/tree_file.h>
#include <gslam/vocabulary/vocabulary.h>

#include <string>

/// @file
/// GSLAM's own vocabulary files, which are mapped into the memory: opening one takes microseconds
/// whatever its size, and processes share it. docs/formats/vocabulary.md describes the format.

namespace gslam {
inline namespace v1 {

/// Writes a vocabulary. The file appears when it is complete, in place of one that was there.
/// @throws FileError when it cannot be written; ArgumentError for an empty vocabulary
inline void saveVocabulary(const Vocabulary& vocabulary, const std::string& path) {
  if (vocabulary.nodeCount() == 0) throw ArgumentError("vocabulary", "is empty");
  detail::TreeHeader header;
  const std::shared_ptr<const detail::Storage> tree = vocabulary.storage();
  detail::fillHeader(vocabulary.tree(), header);
  const std::uint8_t* const body = tree->data() + detail::kTreeHeaderSize;
  const std::size_t body_size = tree->size() - detail::kTreeHeaderSize;
  header.checksum = detail::checksum64(body, body_size);
  detail::seal(header);
  detail::FileTarget target(path);
  target.write(&header, sizeof header);
  target.write(body, body_size);
  target.finish();
}

/// Opens a file of saveVocabulary(): it is mapped, not read. The header is checked, and that the
/// file is as long as it says. Of the rest nothing is touched: a damaged file gives wrong words,
/// but no crash; verifyVocabulary() tells. The file must not be changed while it is open (replacing
/// it, as saveVocabulary() does, is no change): who shortens it makes the system end the process.
/// @throws FileError when it cannot be opened, ParseError when it is none or of another version
inline Vocabulary openVocabulary(const std::string& path) {
  const std::shared_ptr<const detail::Storage> storage =
      detail::Storage::ofFile(detail::MappedFile(path));
  return detail::treeOfBytes(storage, path);
}

/// Checks all of a vocabulary: the checksum of its file, and every number in it. Reads all of it.
/// @param name  for the message, such as the path
/// @throws ParseError that says what is damaged
inline void verifyVocabulary(const Vocabulary& vocabulary, const std::string& name = "vocabulary") {
  if (vocabulary.nodeCount() == 0) return;
  detail::checkSum(vocabulary, name);
  detail::checkTree(vocabulary.tree(), name);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_FILE_H
