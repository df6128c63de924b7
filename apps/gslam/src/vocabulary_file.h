// Vocabulary files of all kinds, as commands read and write them.
#ifndef GSLAM_APPS_VOCABULARY_FILE_H
#define GSLAM_APPS_VOCABULARY_FILE_H

#include <gslam/vocabulary/vocabulary.h>

#include <cstdint>
#include <string>
#include <vector>

namespace app {

/// A vocabulary, and what it came from.
struct VocabularyFile {
  gslam::Vocabulary vocabulary;
  std::string kind;         ///< such as "ORB-SLAM text"
  bool is_own = false;      ///< whether it is GSLAM's own, of which only the header was checked
  bool is_gzipped = false;  ///< whether it was compressed
  std::uint64_t bytes = 0;  ///< of the file
};

/// Reads a vocabulary of any kind, also compressed by gzip.
/// @throws FileError and ParseError when it cannot be read, or has no words
VocabularyFile openVocabularyFile(const std::string& path);

/// Whether a file will be ORB-SLAM's text, by its name; else it is GSLAM's own.
/// @param option  that the name was given by
/// @throws ConfigError when it ends in neither .txt nor .gvoc
bool isOrbSlamText(const std::string& path, const std::string& option);
/// Writes a vocabulary as that.
void writeVocabulary(const gslam::Vocabulary& vocabulary, const std::string& path);

/// @{
/// The names of all choices, in their order, and the choice of a name.
std::vector<std::string> weightingNames();
std::vector<std::string> scoringNames();
std::vector<std::string> storageNames();
gslam::Weighting weightingOf(const std::string& name);
gslam::Scoring scoringOf(const std::string& name);
gslam::DescriptorType storageOf(const std::string& name);
/// @}

}  // namespace app

#endif  // GSLAM_APPS_VOCABULARY_FILE_H
