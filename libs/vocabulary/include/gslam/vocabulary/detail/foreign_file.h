// What kind of vocabulary some bytes are.
#ifndef GSLAM_VOCABULARY_DETAIL_FOREIGN_FILE_H
#define GSLAM_VOCABULARY_DETAIL_FOREIGN_FILE_H

#include <gslam/base/detail/little_endian.h>
#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/foreign_bytes.h>
#include <gslam/vocabulary/detail/read_dbow3_binary.h>
#include <gslam/vocabulary/detail/read_dbow_yaml.h>
#include <gslam/vocabulary/detail/read_fbow.h>
#include <gslam/vocabulary/detail/read_gbow.h>
#include <gslam/vocabulary/detail/read_orb_text.h>
#include <gslam/vocabulary/detail/text_cursor.h>
#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

inline bool beginsWith(const std::uint8_t* data, std::size_t size, const char* text) noexcept {
  const std::size_t length = std::strlen(text);
  return size >= length && std::memcmp(data, text, length) == 0;
}

// What is no vocabulary, but well known, is answered with what to do.
[[noreturn]] inline void failNoVocabulary(const std::uint8_t* data, std::size_t size,
                                          const std::string& name) {
  const char* problem =
      "is no vocabulary of GSLAM, DBoW2, DBoW3, FBoW or ORB-SLAM: its first bytes are not those of "
      "any";
  if (size == 0) {
    problem = "is empty";
  } else if (beginsWith(data, size, "\x1F\x8B")) {
    problem =
        "is compressed by gzip: loadGzippedVocabulary() of gslam/vocabulary/gzip.h reads it, or "
        "gunzip first";
  } else if (size > 262 && std::memcmp(data + 257, "ustar", 5) == 0) {
    problem = "is a tar archive: unpack it (tar xf), and load the file that was in it";
  } else if (beginsWith(data, size, "PK\x03\x04")) {
    problem = "is a zip archive: unpack it, and load the file that was in it";
  } else if (beginsWith(data, size, "<?xml")) {
    problem = "is XML, which is not read here: save it as .yml by DBoW2 or DBoW3";
  } else if (data[0] == '{') {
    problem = "is JSON, which is not read here: save it as .yml by DBoW2 or DBoW3";
  }
  throw ParseError(name, 0, 0, problem);
}

inline TreeData readForeignFile(const std::uint8_t* data, std::size_t size,
                                const std::string& name) {
  const std::uint64_t signature = size < 8 ? 0 : loadLittle<std::uint64_t>(data);
  const ForeignBytes bytes(data, size, name);
  if (signature == kDbow3Signature) {
    return looksLikeGbow(bytes) ? GbowReader(bytes).read() : Dbow3BinaryReader(bytes).read();
  }
  if (signature == kFbowSignature) return FbowReader(bytes).read();
  const VocabularyText text(data, size, name);
  if (beginsWith(data, size, "%YAML") || beginsWith(data, size, "\xEF\xBB\xBF") ||
      beginsWith(data, size, "---") || beginsWith(data, size, "vocabulary")) {
    return DbowYamlReader(text).read();
  }
  std::size_t first = 0;
  while (first < size && (data[first] == ' ' || data[first] == '\t')) ++first;
  if (first < size && data[first] >= '0' && data[first] <= '9') return OrbTextReader(text).read();
  failNoVocabulary(data, size, name);
}

inline Vocabulary loadForeignFile(const std::uint8_t* data, std::size_t size,
                                  const std::string& name) {
  return buildVocabulary(readForeignFile(data, size, name), name);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_FOREIGN_FILE_H
