#include "loops/place_index.h"

#include <gslam/vocabulary/database.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/score.h>
#include <gslam/vocabulary/train.h>
#include <gslam/vocabulary/transform.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace visual {

using gslam::BowVector;
using gslam::Descriptors;
using gslam::Image;
using gslam::KeyframeId;
using gslam::Vocabulary;

namespace {

// Keyframes of the first training. Each of the next ones has four times as many as the one before,
// so that all of them together cost less than twice the last one.
constexpr std::size_t kFirstTraining = 12;
constexpr std::size_t kGrowth = 4;
constexpr std::size_t kMostTrained = 800;
// Descriptors of a training: more of them make it slow, and the words no better.
constexpr std::size_t kMostRows = 48000;
constexpr std::size_t kLeastRows = 100;
constexpr double kRowsPerWord = 4;
constexpr double kBranching = 10;

// Every `step`th of the rows of an image, from `first` on.
Descriptors viewOf(const Image& image, std::size_t first = 0, std::size_t step = 1) {
  const std::size_t rows = std::size_t(image.height());
  if (first >= rows) return Descriptors();
  const std::size_t count = (rows - first + step - 1) / step;
  const std::size_t stride = image.stride() * step;
  const std::uint8_t* const data = image.bytes(int(first));
  const auto bytes = std::uint32_t(image.rowBytes());
  if (image.type() == gslam::PixelType::u8) {
    return gslam::binaryDescriptors(data, count, bytes, stride);
  }
  if (image.type() == gslam::PixelType::f32) {
    return gslam::floatDescriptors(image.row<float>(int(first)), count, bytes / 4, stride);
  }
  throw gslam::ArgumentError("descriptors", "are " + image.text() + ", expected u8 or f32");
}

BowVector bagOf(const Vocabulary& vocabulary, const Image& descriptors) {
  BowVector bag;
  gslam::TransformMemory memory;
  transform(vocabulary, viewOf(descriptors), bag, memory);
  return bag;
}

// Of all images alike, as many rows as are worth it.
Vocabulary trained(const std::map<KeyframeId, Image>& images, std::uint64_t seed) {
  std::size_t rows = 0;
  for (const auto& image : images) rows += std::size_t(image.second.height());
  if (rows < kLeastRows) return Vocabulary();
  const std::size_t step = (rows + kMostRows - 1) / kMostRows;
  std::vector<Descriptors> views;
  std::size_t used = 0;
  for (const auto& image : images) {
    const Descriptors view = viewOf(image.second, views.size() % step, step);
    if (view.count == 0) continue;
    used += view.count;
    views.push_back(view);
  }
  const double words = double(used) / kRowsPerWord;
  const double depth = std::ceil(std::log(words) / std::log(kBranching));
  gslam::TrainingOptions options;
  options.depth = std::uint32_t(depth);
  options.branching = std::uint32_t(std::max(2.0, std::round(std::pow(words, 1 / depth))));
  options.seed = seed;
  options.most_iterations = 10;
  options.parallel.threads = 1;
  return trainVocabulary(gslam::Span<const Descriptors>(views), options);
}

// Bags of one vocabulary.
struct Bags {
  explicit Bags(const Vocabulary& words) : vocabulary(words), database(words.scoring()) {}

  void add(KeyframeId id, const BowVector& bag) {
    remove(id);
    entries[id] = database.add(bag);
    keyframes.push_back(id);
  }
  void remove(KeyframeId id) {
    const auto found = entries.find(id);
    if (found == entries.end()) return;
    database.erase(found->second);
    entries.erase(found);
  }

  const Vocabulary vocabulary;
  gslam::BowDatabase database;
  std::map<KeyframeId, std::uint64_t> entries;
  std::vector<KeyframeId> keyframes;  // by the number of the entry
};

// Scores from 0 to 1, whatever its file says.
Vocabulary loaded(const std::string& path) {
  const Vocabulary vocabulary = gslam::loadVocabulary(path);
  if (vocabulary.empty()) throw gslam::ParseError(path, 0, 0, "has no words");
  return vocabulary.withScoring(gslam::Scoring::l1);
}

}  // namespace

struct PlaceIndex::Data {
  std::shared_ptr<Bags> bagsOfNow() const;
  void addBag(KeyframeId id, const Image& descriptors);
  void trainWhenDue();
  std::unique_ptr<Bags> makeBags(const std::map<KeyframeId, Image>& images) const;
  void replaceBags(std::unique_ptr<Bags> made, const std::map<KeyframeId, Image>& images);

  std::uint64_t seed = 0;
  mutable std::mutex mutex;           // guards all below; held for moments only
  std::shared_ptr<Bags> bags;         // null: there is no vocabulary yet
  std::map<KeyframeId, Image> kept;   // descriptors that the next training needs
  std::size_t next = kFirstTraining;  // keyframes at which it comes; 0: there is none
  bool is_training = false;
};

PlaceIndex::PlaceIndex(const LoopOptions& options, std::uint64_t seed) : data_(new Data) {
  data_->seed = seed;
  if (options.vocabulary.empty()) return;
  data_->bags = std::make_shared<Bags>(loaded(options.vocabulary));
  data_->next = 0;
}

PlaceIndex::~PlaceIndex() = default;

void PlaceIndex::add(KeyframeId id, const std::shared_ptr<const View>& view) {
  const Image& descriptors = view->descriptors();
  {
    const std::lock_guard<std::mutex> lock(data_->mutex);
    // Nothing can be learnt from a view without features, which is like no other either.
    if (data_->next != 0 && !descriptors.empty()) data_->kept[id] = descriptors;
  }
  data_->addBag(id, descriptors);
  data_->trainWhenDue();
}

// What takes time is done outside of the lock, and again where the vocabulary is another one then.
void PlaceIndex::Data::addBag(KeyframeId id, const Image& descriptors) {
  for (;;) {
    const std::shared_ptr<Bags> before = bagsOfNow();
    if (before == nullptr) return;
    const BowVector bag = bagOf(before->vocabulary, descriptors);
    const std::lock_guard<std::mutex> lock(mutex);
    if (bags != before) continue;
    bags->add(id, bag);
    return;
  }
}

void PlaceIndex::Data::trainWhenDue() {
  std::map<KeyframeId, Image> images;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (next == 0 || kept.size() < next || is_training) return;
    is_training = true;
    images = kept;
  }
  std::unique_ptr<Bags> made;
  try {
    made = makeBags(images);
  } catch (...) {
    const std::lock_guard<std::mutex> lock(mutex);
    is_training = false;
    throw;
  }
  const std::lock_guard<std::mutex> lock(mutex);
  is_training = false;
  // Without features there is nothing to learn: once more with the next keyframe.
  if (made != nullptr) replaceBags(std::move(made), images);
}

std::unique_ptr<Bags> PlaceIndex::Data::makeBags(const std::map<KeyframeId, Image>& images) const {
  const Vocabulary vocabulary = trained(images, seed);
  if (vocabulary.empty()) return nullptr;
  std::unique_ptr<Bags> made = std::make_unique<Bags>(vocabulary);
  for (const auto& image : images) made->add(image.first, bagOf(vocabulary, image.second));
  return made;
}

// Keyframes came and went meanwhile.
void PlaceIndex::Data::replaceBags(std::unique_ptr<Bags> made,
                                   const std::map<KeyframeId, Image>& images) {
  for (const auto& image : images) {
    if (kept.count(image.first) == 0) made->remove(image.first);
  }
  for (const auto& image : kept) {
    if (images.count(image.first) != 0) continue;
    made->add(image.first, bagOf(made->vocabulary, image.second));
  }
  bags = std::move(made);
  while (next <= kept.size()) next *= kGrowth;
  if (next <= kMostTrained) return;
  next = 0;
  kept.clear();
}

void PlaceIndex::remove(KeyframeId id) {
  const std::lock_guard<std::mutex> lock(data_->mutex);
  data_->kept.erase(id);
  if (data_->bags != nullptr) data_->bags->remove(id);
}

std::shared_ptr<Bags> PlaceIndex::Data::bagsOfNow() const {
  const std::lock_guard<std::mutex> lock(mutex);
  return bags;
}

std::vector<SimilarPlace> PlaceIndex::similar(const View& view, std::size_t count) const {
  std::vector<SimilarPlace> places;
  const std::shared_ptr<const Bags> bags = data_->bagsOfNow();
  if (bags == nullptr) {
    const std::lock_guard<std::mutex> lock(data_->mutex);
    for (const auto& image : data_->kept) places.push_back({image.first, 0});
    std::reverse(places.begin(), places.end());
    return places;
  }
  if (count == 0) return places;
  const BowVector bag = bagOf(bags->vocabulary, view.descriptors());
  const std::lock_guard<std::mutex> lock(data_->mutex);
  gslam::QueryOptions options;
  options.count = std::min(count, bags->entries.size());  // 0: there are none
  for (const gslam::QueryResult& found : bags->database.query(bag, options)) {
    places.push_back({bags->keyframes[found.id], found.score});
  }
  return places;
}

double PlaceIndex::score(KeyframeId id, const View& view) const {
  const std::shared_ptr<const Bags> bags = data_->bagsOfNow();
  if (bags == nullptr) return 0;
  const BowVector bag = bagOf(bags->vocabulary, view.descriptors());
  const std::lock_guard<std::mutex> lock(data_->mutex);
  const auto found = bags->entries.find(id);
  if (found == bags->entries.end()) return 0;
  return gslam::score(gslam::Scoring::l1, bag, bags->database.bow(found->second));
}

bool PlaceIndex::hasVocabulary() const {
  return data_->bagsOfNow() != nullptr;
}

}  // namespace visual
