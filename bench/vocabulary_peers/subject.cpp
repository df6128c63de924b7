#include "subject.h"

#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/orb_slam_text.h>
#include <gslam/vocabulary/score.h>
#include <gslam/vocabulary/train.h>
#include <gslam/vocabulary/transform.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstring>
#include <iostream>
#include <stdexcept>

namespace {

constexpr std::uint32_t kTrainingSeed = 1, kImageSeed = 2;

Image imageOf(Feature feature, const Rows& rows) {
  Image image;
  image.count = rows.size() / rowSize(feature);
  if (feature == Feature::orb) {
    image.bytes = rows;
  } else {
    image.floats.assign(rows.begin(), rows.end());
  }
  return image;
}

// All of the same number of descriptors: those of the views in a row, cut anew.
std::vector<Image> imagesOf(Feature feature, std::size_t count) {
  Rows all;
  const std::size_t size = kPerImage * rowSize(feature);
  for (const Rows& view : describeViews(feature, count * 9 / 8, kImageSeed)) {
    all.insert(all.end(), view.begin(), view.end());
  }
  if (all.size() < count * size) throw std::runtime_error("the views have too few features");
  std::vector<Image> images;
  for (std::size_t i = 0; i < count; ++i) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(i * size);
    images.push_back(imageOf(feature, Rows(begin, begin + static_cast<std::ptrdiff_t>(size))));
  }
  return images;
}

gslam::Vocabulary trainOrOpen(const Subject& subject, std::uint32_t depth) {
  const std::string path =
      cacheFolder() + cacheKey(subject.feature, kTrainingSeed) + "_" + subject.name + ".gvoc";
  try {
    const gslam::Vocabulary opened = gslam::openVocabulary(path);
    gslam::verifyVocabulary(opened, path);
    return opened;
  } catch (const gslam::Error&) {
    std::cerr << "training " << subject.name << ", kept in " << path << '\n';
  }
  const std::vector<Image> images = trainingImages(subject);
  std::vector<gslam::Descriptors> views;
  for (const Image& image : images) views.push_back(image.view());
  gslam::TrainingOptions options;
  options.branching = 10;
  options.depth = depth;
  gslam::saveVocabulary(gslam::trainVocabulary(views, options), path);
  return gslam::openVocabulary(path);
}

// Distances by plain loops, exact: of whole numbers of bits, of floats with the digits of a long
// double.
long double distance(const Image& image, std::size_t i, const std::uint8_t* node) {
  if (image.isBinary()) {
    std::size_t bits = 0;
    for (std::size_t k = 0; k < 32; ++k) {
      bits += std::bitset<8>(image.bytes[i * 32 + k] ^ node[k]).count();
    }
    return static_cast<long double>(bits);
  }
  long double sum = 0;
  for (std::size_t k = 0; k < 128; ++k) {
    float value;
    std::memcpy(&value, node + k * sizeof value, sizeof value);
    const long double difference = static_cast<long double>(image.floats[i * 128 + k]) - value;
    sum += difference * difference;
  }
  return sum;
}

// The children of each node, found anew from the list of parents; the root is the last.
class PlainTree {
 public:
  explicit PlainTree(const Subject& subject)
      : subject_(subject), children_(subject.tree.parents.size() + 1) {
    std::map<std::uint32_t, std::size_t> place = {{0, subject.tree.ids.size()}};
    for (std::size_t i = 0; i < subject.tree.ids.size(); ++i) place[subject.tree.ids[i]] = i;
    for (std::size_t i = 0; i < subject.tree.ids.size(); ++i) {
      children_[place[subject.tree.parents[i]]].push_back(i);
    }
  }

  void answer(const Image& image, Bag& bag, Groups& groups) const {
    std::map<std::size_t, std::vector<unsigned>> by_node;
    for (std::size_t i = 0; i < image.count; ++i) {
      std::size_t node = children_.size() - 1, passed = node;
      for (std::uint32_t level = 1; !children_[node].empty(); ++level) {
        node = nearest(image, i, children_[node]);
        if (level <= 2) passed = node;
      }
      const double weight = subject_.tree.weights[node];
      if (!(weight > 0)) continue;
      bag[subject_.tree.words[node]] += weight;
      by_node[passed].push_back(static_cast<unsigned>(i));
    }
    bag = normalized(bag);
    for (const auto& group : by_node) groups.push_back(group.second);
    std::sort(groups.begin(), groups.end());
  }

 private:
  std::size_t nearest(const Image& image, std::size_t i,
                      const std::vector<std::size_t>& nodes) const {
    const std::size_t row = gslam::bytesOf(subject_.tree.format);
    std::size_t best = nodes[0];
    long double best_distance = distance(image, i, &subject_.tree.descriptors[best * row]);
    for (const std::size_t node : nodes) {
      const long double found = distance(image, i, &subject_.tree.descriptors[node * row]);
      if (!(found < best_distance)) continue;
      best = node;
      best_distance = found;
    }
    return best;
  }

  const Subject& subject_;
  std::vector<std::vector<std::size_t>> children_;
};

Subject make(const char* name, Feature feature, std::size_t trained_views, std::uint32_t depth) {
  Subject subject;
  subject.name = name;
  subject.feature = feature;
  subject.trained_views = trained_views;
  subject.images = imagesOf(feature, feature == Feature::orb ? kQueries + kEntries : kQueries);
  subject.vocabulary = trainOrOpen(subject, depth);
  subject.tree = gslam::detail::treeDataOf(subject.vocabulary);
  const PlainTree plain(subject);
  subject.bags.resize(kQueries);
  subject.groups.resize(kQueries);
  for (std::size_t i = 0; i < kQueries; ++i) {
    plain.answer(subject.images[i], subject.bags[i], subject.groups[i]);
  }
  std::cerr << name << ": " << subject.vocabulary.nodeCount() << " nodes, "
            << subject.vocabulary.wordCount() << " words\n";
  return subject;
}

}  // namespace

const Subject& orb4() {
  static const Subject subject = make("orb4", Feature::orb, 400, 4);
  return subject;
}
const Subject& orb6() {
  static const Subject subject = make("orb6", Feature::orb, 2000, 6);
  return subject;
}
const Subject& sift4() {
  static const Subject subject = make("sift4", Feature::sift, 400, 4);
  return subject;
}

std::vector<Image> trainingImages(const Subject& subject) {
  std::vector<Image> images;
  for (const Rows& rows : describeViews(subject.feature, subject.trained_views, kTrainingSeed)) {
    images.push_back(imageOf(subject.feature, rows));
  }
  return images;
}

void writeOrbSlamText(const Subject& subject, const std::string& path) {
  saveOrbSlamText(subject.vocabulary, path);
}

double rightScore(const Subject& subject, gslam::Scoring scoring, std::size_t a, std::size_t b) {
  const gslam::Vocabulary vocabulary = subject.vocabulary.withScoring(scoring);
  gslam::BowVector first, second;
  transform(vocabulary, subject.images[a].view(), first);
  transform(vocabulary, subject.images[b].view(), second);
  return score(scoring, first, second);
}

std::vector<double> rightResults(const Subject& subject, gslam::Scoring scoring,
                                 std::size_t query) {
  const gslam::Vocabulary vocabulary = subject.vocabulary.withScoring(scoring);
  gslam::BowVector asked, entry;
  transform(vocabulary, subject.images[query].view(), asked);
  std::vector<double> scores;
  for (std::size_t i = kQueries; i < kQueries + kEntries; ++i) {
    transform(vocabulary, subject.images[i].view(), entry);
    scores.push_back(score(scoring, asked, entry));
  }
  std::sort(scores.rbegin(), scores.rend());
  scores.resize(10);
  return scores;
}

Bag normalized(Bag bag) {
  double sum = 0;
  for (const auto& word : bag) sum += word.second;
  for (auto word = bag.begin(); word != bag.end();) {
    if (word->second == 0) {
      word = bag.erase(word);
    } else {
      word++->second /= sum;
    }
  }
  return bag;
}

std::size_t countDifferences(const Bag& a, const Bag& b, double tolerance) {
  std::size_t count = 0;
  for (const auto& word : a) {
    const auto other = b.find(word.first);
    if (other == b.end() ||
        std::fabs(word.second - other->second) > tolerance * std::max(word.second, other->second)) {
      ++count;
    }
  }
  for (const auto& word : b) count += a.count(word.first) == 0 ? 1 : 0;
  return count;
}
