#include <gslam/svar/json.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/encode.h>
#include <gslam/vocabulary/detail/l2.h>
#include <gslam/vocabulary/detail/training_rows.h>
#include <gslam/vocabulary/detail/word_counts.h>
#include <gslam/vocabulary/file.h>

#include <algorithm>
#include <iostream>

#include "command.h"
#include "options.h"
#include "vocabulary.h"
#include "vocabulary_file.h"
#include "vocabulary_report.h"

namespace app {
namespace {

using gslam::DescriptorFormat;
using gslam::Vocabulary;
using gslam::detail::TreeData;

// The same tree, whose floats are kept in another way.
void changeStorage(gslam::DescriptorType storage, TreeData& data) {
  const DescriptorFormat from = data.format;
  if (from.type == gslam::DescriptorType::binary) {
    throw gslam::ConfigError("--storage", "is for floats, but the descriptors are binary");
  }
  const std::size_t row = bytesOf(from), size = from.size, count = data.parents.size();
  std::vector<float> numbers(count * size);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::uint8_t* const bytes = &data.descriptors[i / size * row];
    numbers[i] = gslam::detail::elementOf(from, bytes, i % size);
  }
  gslam::detail::FloatRange range;
  range.add(numbers.data(), numbers.size());
  DescriptorFormat rows;
  rows.type = gslam::DescriptorType::float32;
  rows.size = from.size;
  data.format = gslam::detail::storageFormat(rows, storage, range);
  data.descriptors.resize(count * bytesOf(data.format));
  for (std::size_t i = 0; i < count; ++i) {
    gslam::detail::encodeFloats(data.format, &numbers[i * size],
                                &data.descriptors[i * bytesOf(data.format)]);
  }
}

// Weights by rareness cannot come from nowhere; those that have none are 1, as in DBoW2.
void changeWeighting(gslam::Weighting weighting, const Vocabulary& vocabulary, TreeData& data) {
  const bool had_them = gslam::detail::needsFrequency(data.weighting);
  data.weighting = weighting;
  if (!gslam::detail::needsFrequency(weighting)) {
    std::fill(data.weights.begin(), data.weights.end(), 1.0);
    return;
  }
  if (had_them) return;
  for (std::uint32_t word = 1; word < vocabulary.wordCount(); ++word) {
    if (vocabulary.weight(word) != vocabulary.weight(0))
      return;  // it has them in spite of its name
  }
  throw gslam::ConfigError(
      "--weighting", "is '" + std::string(gslam::weightingName(weighting)) +
                         "', which needs to know how rare words are, but in this file all words "
                         "weigh the same: train it with this weighting, on images");
}

Vocabulary changed(const Options& options, const Vocabulary& vocabulary, const std::string& path) {
  const auto weighting = options.get<std::string>("weighting");
  const auto scoring = options.get<std::string>("scoring");
  const auto storage = options.get<std::string>("storage");
  Vocabulary result = vocabulary;
  const bool has_weighting =
      weighting != "keep" && weighting != gslam::weightingName(vocabulary.weighting());
  const bool has_storage =
      storage != "keep" && storage != gslam::descriptorTypeName(vocabulary.format().type);
  if (has_weighting || has_storage) {
    TreeData data = gslam::detail::treeDataOf(vocabulary);
    if (has_weighting) changeWeighting(weightingOf(weighting), vocabulary, data);
    if (has_storage) changeStorage(storageOf(storage), data);
    result = gslam::detail::buildVocabulary(data, path);
  }
  return scoring == "keep" ? result : result.withScoring(scoringOf(scoring));
}

std::vector<std::string> orKeep(std::vector<std::string> names) {
  names.insert(names.begin(), "keep");
  return names;
}

}  // namespace

int vocabularyConvert(const std::vector<std::string>& arguments) {
  Options options(
      "gslam vocabulary convert [options] FILE OUT",
      "Writes a vocabulary of any kind (see `gslam vocabulary info --help`) as OUT: .gvoc is "
      "GSLAM's own, which opens at once, .txt is ORB-SLAM's text. All of FILE is checked.");
  options.arg<std::string>("weighting", "keep", "how much words count")
      .choices(orKeep(weightingNames()));
  options.arg<std::string>("scoring", "keep", "how bags are compared")
      .choices(orKeep(scoringNames()));
  options.arg<std::string>("storage", "keep", "how floats are kept")
      .choices(orKeep(storageNames()));
  if (!options.read(arguments)) return kSuccess;
  const std::vector<std::string>& words = options.words();
  if (words.size() != 2) throw gslam::ConfigError("arguments", "expected FILE OUT");
  const std::string &from = words[0], &to = words[1];
  isOrbSlamText(to, "OUT");  // is known before FILE is read
  const VocabularyFile file = openVocabularyFile(from);
  if (file.is_own) gslam::verifyVocabulary(file.vocabulary, from);
  const Vocabulary result = changed(options, file.vocabulary, from);
  writeVocabulary(result, to);
  if (options.isJson()) {
    gslam::Svar facts = describe(result, to);
    facts.set("file", to);
    std::cout << gslam::printJson(facts) << '\n';
  } else {
    std::cout << from << " (" << file.kind << "): " << result.wordCount() << " words written to "
              << to << '\n';
  }
  return kSuccess;
}

}  // namespace app
