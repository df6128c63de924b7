#ifndef GSLAM_VOCABULARY_DBOW_MAPS_H
#define GSLAM_VOCABULARY_DBOW_MAPS_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/bow_vector.h>
#include <gslam/vocabulary/detail/check_bow.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Bags of words and lists of features to and from the std::map shapes of DBoW2 and DBoW3: for
/// programs that were written for these.
///
/// A map is anything with the interface of std::map, such as the classes of DBoW that are derived
/// from it; no header of DBoW is needed.

namespace gslam {
inline namespace v1 {

namespace detail {

// A key, or the number of a feature.
template <class Number>
std::uint32_t numberOfMap(const char* name, Number number) {
  const bool is_negative = number < Number(0);
  if (is_negative || static_cast<std::uint64_t>(number) > 0xFFFFFFFFu) {
    throw ArgumentError(name, "is " + std::to_string(number) + ", expected 0 to 4294967295");
  }
  return static_cast<std::uint32_t>(number);
}

// Of a map that is not in order, or has a key more than once.
inline void checkKeys(const char* name, const std::vector<std::uint32_t>& keys) {
  if (firstNotAscending(keys.data(), keys.size()) == keys.size()) return;
  throw ArgumentError(name, "has keys that do not ascend");
}

}  // namespace detail

/// A bag as a map.
/// @tparam Map  from words to values: std::map<unsigned, double>, DBoW2::BowVector, ...
/// @throws ArgumentError when it has not one value for each word
template <class Map>
Map toMap(const BowVector& bow) {
  detail::checkSizes("bow", bow);
  Map map;
  for (std::size_t i = 0; i < bow.size(); ++i) {
    map.insert(map.end(),
               typename Map::value_type(static_cast<typename Map::key_type>(bow.words[i]),
                                        static_cast<typename Map::mapped_type>(bow.values[i])));
  }
  return map;
}

/// Features by nodes as a map.
/// @tparam Map  from nodes to lists of features: std::map<unsigned, std::vector<unsigned>>,
///              DBoW2::FeatureVector, ...
/// @throws ArgumentError when nodes do not ascend, or lists do not fit each other
template <class Map>
Map toMap(const FeatureVector& features) {
  detail::checkArgument("features", features);
  Map map;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const typename Map::mapped_type list(features.features.data() + features.begins[i],
                                         features.features.data() + features.begins[i + 1]);
    const auto node = static_cast<typename Map::key_type>(features.nodes[i]);
    map.insert(map.end(), typename Map::value_type(node, list));
  }
  return map;
}

/// A bag from a map, into memory that it may have.
/// @throws ArgumentError when a word does not fit 32 bits, or words do not ascend
template <class Map>
void bowFromMap(const Map& map, BowVector& bow) {
  bow.clear();
  for (const auto& item : map) {
    bow.words.push_back(detail::numberOfMap("word", item.first));
    bow.values.push_back(static_cast<double>(item.second));
  }
  detail::checkKeys("map", bow.words);
}
/// A bag from a map.
/// @throws ArgumentError when a word does not fit 32 bits, or words do not ascend
template <class Map>
BowVector bowFromMap(const Map& map) {
  BowVector bow;
  bowFromMap(map, bow);
  return bow;
}

/// Features by nodes from a map, into memory that they may have.
/// @throws ArgumentError when a node or a feature does not fit 32 bits, or nodes do not ascend
template <class Map>
void featuresFromMap(const Map& map, FeatureVector& features) {
  features.clear();
  for (const auto& item : map) {
    if (features.begins.empty()) features.begins.push_back(0);
    features.nodes.push_back(detail::numberOfMap("node", item.first));
    for (const auto& feature : item.second) {
      features.features.push_back(detail::numberOfMap("feature", feature));
    }
    features.begins.push_back(static_cast<std::uint32_t>(features.features.size()));
  }
  detail::checkKeys("map", features.nodes);
}
/// Features by nodes from a map.
/// @throws ArgumentError when a node or a feature does not fit 32 bits, or nodes do not ascend
template <class Map>
FeatureVector featuresFromMap(const Map& map) {
  FeatureVector features;
  featuresFromMap(map, features);
  return features;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DBOW_MAPS_H
