#include <gslam/vocabulary/database.h>
#include <gslam/vocabulary/fingerprint.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <unordered_map>

#include "command.h"
#include "image_bags.h"
#include "json_list.h"
#include "vocabulary.h"
#include "vocabulary_file.h"

namespace app {
namespace {

void declareQuery(Options& options) {
  options
      .arg<std::string>("database", "",
                        "file of --save to look the images up in; else in those before each")
      .group("Database");
  options
      .arg<std::string>(
          "save", "", "file to write the database to, with these images behind those of --database")
      .group("Database");
  options.arg<std::size_t>("top", 5, "most places of an image; 0: all that have a word in common")
      .range(0, 1000000000)
      .group("Places");
  options
      .arg<std::uint64_t>("recent", 0,
                          "do not look among so many images before each, which look alike")
      .range(0, 1000000000)
      .group("Places");
  declareBags(options);
}

// Fails before the work what would fail behind it.
void checkOptions(const Options& options) {
  const auto save = options.get<std::string>("save"), from = options.get<std::string>("database");
  if (!from.empty() && save.empty() && options.get<std::uint64_t>("recent") != 0) {
    throw gslam::ConfigError("--recent",
                             "is for images that are added: with --database alone, none "
                             "are");
  }
  if (save.empty()) return;
  const std::filesystem::path folder = std::filesystem::path(save).parent_path();
  std::error_code problem;
  if (!folder.empty() && !std::filesystem::is_directory(folder, problem)) {
    throw gslam::FileError(save, "cannot be written: there is no folder " + folder.string());
  }
}

// A program may have saved it without saying of which vocabulary it is; then the number is 0.
gslam::BowDatabase openDatabase(const std::string& path, std::uint64_t fingerprint) {
  const gslam::detail::MappedFile file(path);
  const std::uint64_t made_with =
      gslam::detail::DatabaseReader(static_cast<const std::uint8_t*>(file.data()), file.size(),
                                    path)
          .readHeader()
          .fingerprint;
  if (made_with != 0 && made_with != fingerprint) {
    throw gslam::FileError(path, "was made with another vocabulary: its fingerprint is " +
                                     std::to_string(made_with) + ", that of this one is " +
                                     std::to_string(fingerprint));
  }
  return gslam::loadDatabase(path);
}

class Query {
 public:
  Query(const Options& options, const gslam::Vocabulary& vocabulary)
      : options_(options),
        save_(options.get<std::string>("save")),
        recent_(options.get<std::uint64_t>("recent")),
        fingerprint_(gslam::fingerprint(vocabulary)),
        database_(vocabulary.scoring()) {
    const auto from = options.get<std::string>("database");
    if (!from.empty()) database_ = openDatabase(from, fingerprint_);
    adds_ = from.empty() || !save_.empty();
    // Bags have the length that the scores of the database need.
    vocabulary_ = vocabulary.withScoring(database_.scoring());
    how_.count = options.get<std::size_t>("top");
  }

  int run() {
    const std::vector<std::string>& words = options_.words();
    const bool is_complete = forEachBag(options_, vocabulary_, {words.begin() + 1, words.end()}, 0,
                                        [this](const ImageBag& image) { look(image); });
    if (options_.isJson()) list_.end();
    if (!save_.empty()) database_.save(save_, fingerprint_);
    return is_complete ? kSuccess : kInterrupted;
  }

 private:
  void look(const ImageBag& image) {
    const std::uint64_t id = database_.nextId();
    if (adds_) how_.before_id = id - std::min(id, recent_);
    database_.query(image.bow, how_, places_);
    if (options_.isJson()) {
      list_.add(describe(image, id));
    } else {
      print(image, id);
    }
    if (!adds_) return;
    database_.add(image.bow);
    names_[id] = image.name;
  }

  gslam::Svar describe(const ImageBag& image, std::uint64_t id) const {
    gslam::Svar places = gslam::Svar::array();
    for (const gslam::QueryResult& place : places_) {
      gslam::Svar one = gslam::Svar::object(
          {{"id", place.id}, {"score", place.score}, {"common_words", place.common_words}});
      const auto name = names_.find(place.id);
      if (name != names_.end()) one.set("image", name->second);
      places.push_back(one);
    }
    gslam::Svar result = gslam::Svar::object({{"image", image.name},
                                              {"features", image.features},
                                              {"words", image.bow.size()},
                                              {"places", places}});
    if (adds_) result.set("id", id);
    return result;
  }

  void print(const ImageBag& image, std::uint64_t id) const {
    if (adds_) std::cout << id << "  ";
    std::cout << image.name << ": " << image.features << " features, " << image.bow.size()
              << " words\n";
    for (const gslam::QueryResult& place : places_) {
      char text[96];
      std::snprintf(text, sizeof text, "    %-10.5g %5lu words in common with %llu", place.score,
                    static_cast<unsigned long>(place.common_words),
                    static_cast<unsigned long long>(place.id));
      const auto name = names_.find(place.id);
      std::cout << text << (name != names_.end() ? "  " + name->second : "") << '\n';
    }
  }

  const Options& options_;
  const std::string save_;
  const std::uint64_t recent_;
  const std::uint64_t fingerprint_;
  gslam::Vocabulary vocabulary_;
  gslam::BowDatabase database_;
  bool adds_ = true;  // whether images go to the database
  gslam::QueryOptions how_;
  std::vector<gslam::QueryResult> places_;
  std::unordered_map<std::uint64_t, std::string> names_;  // of images that were added here
  JsonList list_;
};

}  // namespace

int vocabularyQuery(const std::vector<std::string>& arguments) {
  Options options(
      "gslam vocabulary query [options] VOCABULARY IMAGES...",
      "Finds places that are seen again: looks each image (files, folders of images, datasets) up "
      "among those before it, or in a database that was saved, and prints those that are most like "
      "it, the best first, with their scores. Images have numbers from 0 on.");
  declareQuery(options);
  if (!options.read(arguments)) return kSuccess;
  if (options.words().empty()) throw gslam::ConfigError("VOCABULARY", "must be given");
  checkOptions(options);
  const VocabularyFile file = openVocabularyFile(options.words()[0]);
  return Query(options, file.vocabulary).run();
}

}  // namespace app
