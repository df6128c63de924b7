// Bags of words and lists of features from outside: whether they are what they should be.
#ifndef GSLAM_VOCABULARY_DETAIL_CHECK_BOW_H
#define GSLAM_VOCABULARY_DETAIL_CHECK_BOW_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/bow_vector.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// The first that is not above the one before; the size where all are.
inline std::size_t firstNotAscending(const std::uint32_t* numbers, std::size_t size) noexcept {
  for (std::size_t i = 1; i < size; ++i) {
    if (numbers[i - 1] >= numbers[i]) return i;
  }
  return size;
}

// Throws ArgumentError.
inline void checkSizes(const char* name, const BowVector& bow) {
  if (bow.words.size() == bow.values.size()) return;
  throw ArgumentError(name, "has " + std::to_string(bow.words.size()) + " words, but " +
                                std::to_string(bow.values.size()) + " values");
}

// What is wrong, as a part of a sentence; empty: nothing.
inline std::string problemOf(const BowVector& bow) {
  if (bow.words.size() != bow.values.size()) {
    return "has " + std::to_string(bow.words.size()) + " words, but " +
           std::to_string(bow.values.size()) + " values";
  }
  const std::size_t place = firstNotAscending(bow.words.data(), bow.size());
  if (place != bow.size()) {
    return "has word " + std::to_string(bow.words[place]) + " behind " +
           std::to_string(bow.words[place - 1]) + ": words must ascend";
  }
  for (std::size_t i = 0; i < bow.size(); ++i) {
    const double value = bow.values[i];
    if (!(value >= 0) || value > std::numeric_limits<double>::max()) {
      return "has the value " + std::to_string(value) + " of word " + std::to_string(bow.words[i]) +
             ", expected 0 or more";
    }
  }
  return std::string();
}

inline std::string problemOf(const FeatureVector& features) {
  const std::size_t size = features.size();
  if (size == 0 && features.begins.empty() && features.features.empty()) return std::string();
  if (features.begins.size() != size + 1) {
    return "has " + std::to_string(size) + " nodes, but " + std::to_string(features.begins.size()) +
           " begins, expected one more than nodes";
  }
  if (features.begins.front() != 0 || features.begins.back() != features.features.size()) {
    return "has features from " + std::to_string(features.begins.front()) + " to " +
           std::to_string(features.begins.back()) + ", expected 0 to " +
           std::to_string(features.features.size());
  }
  const std::size_t place = firstNotAscending(features.nodes.data(), size);
  if (place != size) {
    return "has node " + std::to_string(features.nodes[place]) + " behind " +
           std::to_string(features.nodes[place - 1]) + ": nodes must ascend";
  }
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t begin = features.begins[i];
    const std::size_t end = features.begins[i + 1];
    if (end < begin || end > features.features.size() ||
        firstNotAscending(features.features.data() + begin, end - begin) != end - begin) {
      return "has features of node " + std::to_string(features.nodes[i]) + " that do not ascend";
    }
  }
  return std::string();
}

// Throws ArgumentError.
template <class Bag>
void checkArgument(const char* name, const Bag& bag) {
  const std::string problem = problemOf(bag);
  if (!problem.empty()) throw ArgumentError(name, problem);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_CHECK_BOW_H
