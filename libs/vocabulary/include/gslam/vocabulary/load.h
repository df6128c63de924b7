#ifndef GSLAM_VOCABULARY_LOAD_H
#define GSLAM_VOCABULARY_LOAD_H

#include <gslam/base/span.h>
#include <gslam/vocabulary/detail/foreign_file.h>
#include <gslam/vocabulary/detail/mapped_file.h>
#include <gslam/vocabulary/detail/storage.h>
#include <gslam/vocabulary/detail/tree_file.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

/// @file
/// Vocabularies of every kind that is out there, told apart by what is in them:
///
/// - GSLAM's own files, as openVocabulary() of gslam/vocabulary/file.h;
/// - the text of ORB-SLAM: ORBvoc.txt;
/// - YAML of DBoW2 (FORB, FBrief, FSurf64) and of DBoW3, old and new;
/// - DBoW3's binary files, but not those compressed by quicklz;
/// - FBoW's .fbow. Its words keep their numbers where these are 0, 1, 2... each once, which is so
///   in what was converted from DBoW2. FBoW's own training gives one number to several words: then
///   all are numbered anew, breadth first;
/// - .gbow of the original GSLAM. Places of its table that are not in the tree are left out, and
///   nodes and words, which were places, numbered anew, breadth first.
///
/// DBoW2's YAML does not say what its descriptors are: where all are integers of 0 to 255, they are
/// bytes of bits.
///
/// Words, weights and the order of children, which decides ties, are those of the file; so are the
/// ids of nodes where the format has some. gslam/vocabulary/gzip.h reads what is compressed by
/// gzip.

namespace gslam {
inline namespace v1 {

/// Loads a vocabulary from a file. GSLAM's own are mapped; others are read, on the threads of the
/// shared pool where that pays.
///
/// All of a foreign file is checked. Memory is never more than a few times the size of the file.
/// @throws FileError when it cannot be read or is no ordinary file, such as a pipe; ParseError,
///         which says where, when it is damaged, or none of these
inline Vocabulary loadVocabulary(const std::string& path) {
  detail::MappedFile file(path);
  const auto* const data = static_cast<const std::uint8_t*>(file.data());
  if (detail::beginsWith(data, file.size(), detail::kTreeMagic)) {
    return detail::TreeOpener(detail::Storage::ofFile(std::move(file)), path).open();
  }
  return detail::loadForeignFile(data, file.size(), path);
}

/// Loads a vocabulary from bytes in memory, which are not needed afterwards.
/// @param bytes  what would be in the file
/// @param name   for messages, in place of a path
/// @throws ParseError as above
inline Vocabulary loadVocabulary(Span<const std::uint8_t> bytes, const std::string& name) {
  if (detail::beginsWith(bytes.data(), bytes.size(), detail::kTreeMagic)) {
    const std::shared_ptr<detail::Storage> storage = detail::Storage::ofSize(bytes.size());
    std::memcpy(storage->data(), bytes.data(), bytes.size());
    return detail::TreeOpener(storage, name).open();
  }
  return detail::loadForeignFile(bytes.data(), bytes.size(), name);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_LOAD_H
