#include "vocabulary_report.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>

namespace app {
namespace {

using gslam::Svar;

struct Weights {
  std::uint32_t zeros = 0;
  double least = std::numeric_limits<double>::infinity();  // of those that are not 0
  double most = 0;
};

Weights weightsOf(const gslam::Vocabulary& vocabulary, const std::string& path) {
  Weights weights;
  for (std::uint32_t word = 0; word < vocabulary.wordCount(); ++word) {
    const double weight = vocabulary.weight(word);
    if (!(weight >= 0) || !std::isfinite(weight)) {
      throw gslam::ParseError(
          path, 0, 0,
          "is damaged: word " + std::to_string(word) + " has a weight that is not 0 or more");
    }
    weights.zeros += weight == 0 ? 1 : 0;
    if (weight > 0) weights.least = std::min(weights.least, weight);
    weights.most = std::max(weights.most, weight);
  }
  if (weights.most == 0) weights.least = 0;
  return weights;
}

gslam::VocabularyQuality shapeOf(const gslam::Vocabulary& vocabulary) {
  return gslam::qualityOf(vocabulary, gslam::Span<const gslam::Descriptors>());
}

}  // namespace

std::string sizeText(std::uint64_t bytes) {
  const double count = static_cast<double>(bytes);
  char text[32];
  if (bytes < 10000) {
    std::snprintf(text, sizeof text, "%.0f bytes", count);
  } else if (count < 1e6) {
    std::snprintf(text, sizeof text, "%.1f kB", count * 1e-3);
  } else {
    std::snprintf(text, sizeof text, "%.1f MB", count * 1e-6);
  }
  return text;
}

std::string descriptorText(const gslam::DescriptorFormat& format) {
  if (format.type == gslam::DescriptorType::binary) {
    return std::to_string(format.size) + " bytes of bits";
  }
  return std::to_string(format.size) + " " + gslam::descriptorTypeName(format.type);
}

Svar describe(const gslam::Vocabulary& vocabulary, const std::string& path) {
  const gslam::DescriptorFormat& format = vocabulary.format();
  const Weights weights = weightsOf(vocabulary, path);
  const gslam::VocabularyQuality shape = shapeOf(vocabulary);
  Svar descriptor =
      Svar::object({{"type", gslam::descriptorTypeName(format.type)}, {"size", format.size}});
  if (format.type == gslam::DescriptorType::int8) {
    descriptor.set("scale", format.scale);
    descriptor.set("offset", format.offset);
  }
  return Svar::object({{"branching", vocabulary.branching()},
                       {"depth", vocabulary.depth()},
                       {"words", vocabulary.wordCount()},
                       {"nodes", vocabulary.nodeCount()},
                       {"descriptor", descriptor},
                       {"weighting", gslam::weightingName(vocabulary.weighting())},
                       {"scoring", gslam::scoringName(vocabulary.scoring())},
                       {"weights", Svar::object({{"zero", weights.zeros},
                                                 {"least_above_zero", weights.least},
                                                 {"most", weights.most}})},
                       {"leaves", Svar::object({{"least_depth", shape.least_depth},
                                                {"most_depth", shape.most_depth},
                                                {"mean_depth", shape.mean_depth},
                                                {"mean_children", shape.mean_children}})},
                       {"bytes", vocabulary.bytes()},
                       {"mapped", vocabulary.isMapped()}});
}

void print(const gslam::Vocabulary& vocabulary, const std::string& path) {
  const Weights weights = weightsOf(vocabulary, path);
  const gslam::VocabularyQuality shape = shapeOf(vocabulary);
  std::cout << "tree         K " << vocabulary.branching() << ", L " << vocabulary.depth() << ", "
            << vocabulary.nodeCount() << " nodes, " << shape.mean_children
            << " children each on average\nwords        " << vocabulary.wordCount() << ", "
            << shape.least_depth << " to " << shape.most_depth << " levels down, "
            << shape.mean_depth << " on average\ndescriptors  "
            << descriptorText(vocabulary.format()) << "\nweighting    "
            << gslam::weightingName(vocabulary.weighting()) << "\nscoring      "
            << gslam::scoringName(vocabulary.scoring()) << "\nweights      " << weights.least
            << " to " << weights.most << ", " << weights.zeros
            << " words of weight 0\nmemory       " << sizeText(vocabulary.bytes())
            << (vocabulary.isMapped() ? ", mapped from the file and shared\n" : "\n");
}

Svar describe(const gslam::VocabularyQuality& quality) {
  return Svar::object({{"unseen_words", quality.unseen_words},
                       {"largest_word", quality.largest_word},
                       {"balance", quality.balance},
                       {"mean_error", quality.mean_error},
                       {"rms_error", quality.rms_error}});
}

void print(const gslam::VocabularyQuality& quality, bool is_binary) {
  std::cout << "balance      " << quality.balance << " (1: all words are equally frequent), "
            << quality.largest_word << " descriptors in the largest word\ndistance     "
            << quality.mean_error << (is_binary ? " bits" : "")
            << " from descriptors to their words on average, " << quality.rms_error << " rms\n";
}

}  // namespace app
