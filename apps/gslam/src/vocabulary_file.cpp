#include "vocabulary_file.h"

#include <gslam/svar/error.h>
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/gzip.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/orb_slam_text.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace app {
namespace {

using Bytes = gslam::Span<const std::uint8_t>;

// What kind of vocabulary some bytes are that could be read as one.
std::string kindOf(Bytes bytes, const std::string& path) {
  const gslam::detail::ForeignBytes foreign(bytes.data(), bytes.size(), path);
  if (gslam::detail::beginsWith(bytes.data(), bytes.size(), gslam::detail::kTreeMagic)) {
    return "GSLAM";
  }
  const std::uint64_t signature = bytes.size() < 8 ? 0 : foreign.u64(0);
  if (signature == gslam::detail::kDbow3Signature) {
    return gslam::detail::looksLikeGbow(foreign) ? "GSLAM before 1.0 (.gbow)" : "DBoW3 binary";
  }
  if (signature == gslam::detail::kFbowSignature) return "FBoW";
  const std::uint8_t first = bytes.empty() ? 0 : bytes[0];
  const bool is_text = first == ' ' || first == '\t' || (first >= '0' && first <= '9');
  return is_text ? "ORB-SLAM text" : "YAML of DBoW2 or DBoW3";
}

// The choices of an enumeration whose numbers begin at 0.
template <class Choice>
std::vector<std::string> namesOf(const char* (*name)(Choice), int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.emplace_back(name(static_cast<Choice>(i)));
  return names;
}

template <class Choice>
Choice choiceOf(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw gslam::ConfigError("'" + name + "'", "is not known");
  return static_cast<Choice>(found - names.begin());
}

}  // namespace

VocabularyFile openVocabularyFile(const std::string& path) {
  VocabularyFile opened;
  const gslam::detail::MappedFile file(path);
  const Bytes all(static_cast<const std::uint8_t*>(file.data()), file.size());
  opened.bytes = file.size();
  opened.is_gzipped = gslam::detail::beginsWith(all.data(), all.size(), "\x1F\x8B");
  if (opened.is_gzipped) {
    const std::size_t most = std::size_t(1) << 31;
    const std::vector<std::uint8_t> bytes =
        gslam::detail::GzipReader(all.data(), all.size(), most, path).read();
    opened.vocabulary = gslam::loadVocabulary(Bytes(bytes), path);
    opened.kind = kindOf(bytes, path);
  } else {
    opened.vocabulary = gslam::loadVocabulary(path);
    opened.kind = kindOf(all, path);
  }
  opened.is_own = opened.kind == "GSLAM";
  if (opened.vocabulary.empty()) throw gslam::ParseError(path, 0, 0, "has no words");
  return opened;
}

bool isOrbSlamText(const std::string& path, const std::string& option) {
  const auto extension = std::filesystem::path(path).extension();
  if (extension == ".txt") return true;
  if (extension == ".gvoc") return false;
  throw gslam::ConfigError(option, "is '" + path +
                                       "', expected a name that ends in .gvoc (GSLAM's own, opens "
                                       "at once) or .txt (ORB-SLAM's text)");
}

void writeVocabulary(const gslam::Vocabulary& vocabulary, const std::string& path) {
  if (isOrbSlamText(path, "OUT")) {
    gslam::saveOrbSlamText(vocabulary, path);
  } else {
    gslam::saveVocabulary(vocabulary, path);
  }
}

std::vector<std::string> weightingNames() {
  return namesOf<gslam::Weighting>([](gslam::Weighting w) { return gslam::weightingName(w); }, 4);
}
std::vector<std::string> scoringNames() {
  return namesOf<gslam::Scoring>([](gslam::Scoring s) { return gslam::scoringName(s); }, 6);
}
std::vector<std::string> storageNames() {
  return {"float32", "float16", "int8"};
}
gslam::Weighting weightingOf(const std::string& name) {
  return choiceOf<gslam::Weighting>(weightingNames(), name);
}
gslam::Scoring scoringOf(const std::string& name) {
  return choiceOf<gslam::Scoring>(scoringNames(), name);
}
gslam::DescriptorType storageOf(const std::string& name) {
  if (name == "float16") return gslam::DescriptorType::float16;
  return name == "int8" ? gslam::DescriptorType::int8 : gslam::DescriptorType::float32;
}

}  // namespace app
