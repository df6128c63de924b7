// What all are measured on: three vocabularies that are trained here, and images to ask for.
#ifndef GSLAM_BENCH_VOCABULARY_PEERS_SUBJECT_H
#define GSLAM_BENCH_VOCABULARY_PEERS_SUBJECT_H

#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "views.h"

/// The descriptors of an image, in the form that OpenCV gives.
struct Image {
  Rows bytes;                 ///< of ORB
  std::vector<float> floats;  ///< of SIFT
  std::size_t count = 0;

  bool isBinary() const { return floats.empty(); }
  gslam::Descriptors view() const {
    return isBinary() ? gslam::binaryDescriptors(bytes.data(), count, 32)
                      : gslam::floatDescriptors(floats.data(), count, 128);
  }
};

constexpr std::size_t kQueries = 64;     ///< images that are transformed, and that ask the database
constexpr std::size_t kEntries = 200;    ///< images in the database, behind those
constexpr std::size_t kPerImage = 1000;  ///< descriptors of each of them

/// A bag of words with values that add up to 1, and the features that share a node, for
/// comparisons.
using Bag = std::map<std::uint32_t, double>;
using Groups = std::vector<std::vector<unsigned>>;

/// A vocabulary, and what it is asked.
struct Subject {
  std::string name;
  Feature feature = Feature::orb;
  std::size_t trained_views = 0;  ///< how many it was trained on
  gslam::Vocabulary vocabulary;
  gslam::detail::TreeData tree;  ///< the same, breadth first
  std::vector<Image> images;     ///< of views that it was not trained on
  /// What is right for each of the images that are transformed, found by plain loops
  std::vector<Bag> bags;
  std::vector<Groups> groups;

  /// Of nodes for features: they are of the second level from the root.
  std::uint32_t levelsUp() const { return vocabulary.depth() - 2; }
};

/// The trees, all with K = 10; the number is L. They are trained when they are first asked for, or
/// taken from the cache.
const Subject& orb4();   ///< of 400 views
const Subject& orb6();   ///< of 2000 views
const Subject& sift4();  ///< of 400 views; it has no entries for a database

/// The descriptors that a subject was trained on.
std::vector<Image> trainingImages(const Subject& subject);

/// Writes the tree as text for ORB-SLAM.
void writeOrbSlamText(const Subject& subject, const std::string& path);

/// The score of two images, the numbers of which are given.
double rightScore(const Subject& subject, gslam::Scoring scoring, std::size_t a, std::size_t b);

/// The scores of an image and the ten entries that are most like it, found one after the other.
std::vector<double> rightResults(const Subject& subject, gslam::Scoring scoring, std::size_t query);

/// The values of a bag divided by their sum, without those that are 0.
Bag normalized(Bag bag);

/// How many words are in one bag but not in the other, or have a value that differs by more than
/// `tolerance` times the larger one.
std::size_t countDifferences(const Bag& a, const Bag& b, double tolerance);

#endif  // GSLAM_BENCH_VOCABULARY_PEERS_SUBJECT_H
