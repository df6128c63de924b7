// What sentences have in them.
#ifndef GSLAM_DATASETS_TESTS_WORDS_H
#define GSLAM_DATASETS_TESTS_WORDS_H

#include <algorithm>
#include <string>
#include <vector>

inline bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

/// Whether a sentence of the list has the words.
inline bool says(const std::vector<std::string>& list, const std::string& words) {
  return std::any_of(list.begin(), list.end(),
                     [&](const std::string& sentence) { return has(sentence, words); });
}

#endif  // GSLAM_DATASETS_TESTS_WORDS_H
