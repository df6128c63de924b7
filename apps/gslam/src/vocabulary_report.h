// What is said of vocabularies, for people and for machines.
#ifndef GSLAM_APPS_VOCABULARY_REPORT_H
#define GSLAM_APPS_VOCABULARY_REPORT_H

#include <gslam/svar/svar.h>
#include <gslam/vocabulary/quality.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstdint>
#include <string>

namespace app {

/// "1.2 MB", "830 bytes".
std::string sizeText(std::uint64_t bytes);
/// "32 bytes of bits", "128 float16".
std::string descriptorText(const gslam::DescriptorFormat& format);

/// Shape, descriptors, weighting and weights.
/// @throws ParseError when a weight is no number: the file is damaged
gslam::Svar describe(const gslam::Vocabulary& vocabulary, const std::string& path);
/// The same as lines to stdout.
void print(const gslam::Vocabulary& vocabulary, const std::string& path);

/// What a vocabulary is like on images.
gslam::Svar describe(const gslam::VocabularyQuality& quality);
/// The same as lines to stdout.
void print(const gslam::VocabularyQuality& quality, bool is_binary);

}  // namespace app

#endif  // GSLAM_APPS_VOCABULARY_REPORT_H
