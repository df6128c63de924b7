#ifndef GSLAM_VOCABULARY_FILE_H
#define GSLAM_VOCABULARY_FILE_H

#include <gslam/base/detail/checksum.h>
#include <gslam/base/detail/new_file.h>
#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/tree_file.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstddef>
#include <cstdint>
#include <string>

/// @file
/// GSLAM's own vocabulary files, which are mapped into the memory: opening one takes microseconds
/// whatever its size, and processes share it. docs/formats/vocabulary.md describes the format.

namespace gslam {
inline namespace v1 {

/// Writes a vocabulary. The file appears when it is complete, in place of one that was there.
/// @throws FileError when it cannot be written, ArgumentError for an empty vocabulary, ParseError
///         for one that comes from such a file and does not fit its checksum
inline void saveVocabulary(const Vocabulary& vocabulary, const std::string& path) {
  if (vocabulary.storage() == nullptr) throw ArgumentError("vocabulary", "is empty");
  detail::checkBody(*vocabulary.storage(), "vocabulary");
  const std::uint8_t* const body = vocabulary.storage()->data() + detail::kTreeHeaderSize;
  const std::size_t body_size = vocabulary.storage()->size() - detail::kTreeHeaderSize;
  detail::TreeHeader header = detail::headerOf(vocabulary.tree());
  header.checksum = detail::Xxh64::of(body, body_size);
  header.header_checksum = detail::checksumOfHeader(header);
  detail::NewFile file(path);
  file.write(&header, sizeof header);
  file.write(body, body_size);
  file.commit();
}

/// Opens a file of saveVocabulary(): it is mapped, not read (but on systems without mmap). The
/// header is checked, and that the file is as long as it says; the rest is not touched. A file that
/// is damaged there gives wrong words, but no crash; verifyVocabulary() tells. A file of a machine
/// with another order of bytes is read, checked and copied.
///
/// Nobody may write into the file while it is open; to replace it, as saveVocabulary() does, is
/// all right. Where somebody makes it shorter, the system ends processes that read what was cut.
/// @throws FileError when it cannot be opened or is no ordinary file, ParseError when it is none of
///         these or of another version
inline Vocabulary openVocabulary(const std::string& path) {
  return detail::TreeOpener(detail::Storage::ofFile(detail::MappedFile(path)), path).open();
}

/// Checks all of a vocabulary: the checksum of its file, and every number in it that is used. Reads
/// all of it.
/// @param vocabulary  of a file of saveVocabulary(), mapped or not; or made in another way, which
///                    has no checksum
/// @param name        for the message, such as the path
/// @throws ParseError that says what is damaged
inline void verifyVocabulary(const Vocabulary& vocabulary, const std::string& name = "vocabulary") {
  if (vocabulary.storage() == nullptr) return;
  detail::checkBody(*vocabulary.storage(), name);
  detail::TreeChecker(vocabulary.tree(), name).check();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_FILE_H
