#ifndef GSLAM_VOCABULARY_DATABASE_H
#define GSLAM_VOCABULARY_DATABASE_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/bow_vector.h>
#include <gslam/vocabulary/detail/bow_search.h>
#include <gslam/vocabulary/detail/bow_store.h>
#include <gslam/vocabulary/detail/check_bow.h>
#include <gslam/vocabulary/detail/database_file.h>
#include <gslam/vocabulary/detail/mapped_file.h>
#include <gslam/vocabulary/detail/score_terms.h>
#include <gslam/vocabulary/weighting.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Images that were seen, by their bags of words: which of them look like this one?

namespace gslam {
inline namespace v1 {

/// What a query of a BowDatabase asks for.
struct QueryOptions {
  std::size_t count = 10;  ///< most results; 0: all
  /// Only entries with a lower id: to leave out the recent ones, which look alike, of course
  std::uint64_t before_id = std::numeric_limits<std::uint64_t>::max();
  /// Only entries whose score is not worse: not lower, for Scoring::kl not higher. NaN: all
  double worst_score = std::numeric_limits<double>::quiet_NaN();
  std::uint32_t min_common_words = 1;  ///< only entries that share as many words with the query
};

/// An entry that a query found.
struct QueryResult {
  std::uint64_t id;            ///< of the entry
  double score;                ///< score() of the query and the entry
  std::uint32_t common_words;  ///< that are in both
};

/// Whether both are of the same entry, and say the same of it.
inline bool operator==(const QueryResult& a, const QueryResult& b) noexcept {
  return a.id == b.id && a.score == b.score && a.common_words == b.common_words;
}
inline bool operator!=(const QueryResult& a, const QueryResult& b) noexcept {  ///< not ==
  return !(a == b);
}

class BowDatabase;

namespace detail {

struct BowDatabaseData {
  Scoring scoring = Scoring::l1;
  BowStore store;
  BowScratches scratches;
};

inline BowDatabase databaseFromBytes(const std::uint8_t* data, std::size_t size,
                                     const std::string& source, std::uint64_t fingerprint);

}  // namespace detail

/// Images by their bags of words, with an inverted index: a query looks only at what has words in
/// common with it (J. Sivic, A. Zisserman, "Video Google: A Text Retrieval Approach to Object
/// Matching in Videos", ICCV 2003).
///
///     gslam::BowDatabase database(vocabulary.scoring());
///     const std::uint64_t id = database.add(bow, features);
///     for (const gslam::QueryResult& result : database.query(bow)) ...
///
/// Entries get ids from 0 on, which are never given twice. Scores are those of score(), for every
/// scoring: there are no approximations.
///
/// Memory: 12 bytes for each word of an entry, and more for its place in the index: about 58 where
/// most words are in one or two of few images, 35 to 46 with some thousand images.
///
/// Thread-safety: all but moving and destroying may be called by any number of threads at once.
/// Queries do not wait for those who add and erase, and see each entry wholly or not at all; what
/// is added or erased during a query may be in its results or not. To erase takes longer once in a
/// while (as long as to add up to 4096 entries), when half of a part of the index is dead. One that
/// was moved from is good for nothing but to be destroyed and assigned to.
class BowDatabase {
 public:
  /// An empty one.
  /// @param scoring  of queries; bags must have the length of normFor() that it needs
  /// @throws ArgumentError when there is no such scoring
  explicit BowDatabase(Scoring scoring = Scoring::l1) : data_(new detail::BowDatabaseData) {
    detail::withTerm(scoring, CheckScoring());
    data_->scoring = scoring;
  }

  Scoring scoring() const noexcept { return data_->scoring; }        ///< of queries
  std::size_t size() const noexcept { return data_->store.size(); }  ///< entries that are there
  bool empty() const noexcept { return size() == 0; }                ///< whether there is none
  /// The id of the next entry.
  std::uint64_t nextId() const noexcept { return data_->store.nextId(); }

  /// Adds an image.
  /// @param bow       its words; values are 0 or more
  /// @param features  its features by nodes, which features() gives back (the direct index)
  /// @returns its id: nextId() as it was
  /// @throws ArgumentError when words or nodes do not ascend, lists do not fit each other, or a
  ///         value is below 0 or not finite
  std::uint64_t add(const BowVector& bow, const FeatureVector& features = FeatureVector()) {
    detail::checkArgument("bow", bow);
    detail::checkArgument("features", features);
    const std::shared_ptr<detail::BowEntry> entry = std::make_shared<detail::BowEntry>();
    entry->bow = bow;
    if (!features.empty()) entry->features = features;
    return data_->store.add(entry);
  }

  /// Forgets an image.
  /// @returns whether it was there
  bool erase(std::uint64_t id) { return data_->store.erase(id); }
  /// Forgets all. Ids go on.
  void clear() { data_->store.clear(); }

  /// Whether there is such an entry.
  bool contains(std::uint64_t id) const { return data_->store.find(id) != nullptr; }
  /// The ids of all entries, ascending.
  std::vector<std::uint64_t> ids() const {
    std::vector<std::uint64_t> all;
    for (const auto& entry : data_->store.entries()) all.push_back(entry.first);
    return all;
  }
  /// The words of an entry.
  /// @throws ArgumentError when there is none
  BowVector bow(std::uint64_t id) const { return entryOf(id)->bow; }
  /// The features of an entry by nodes: none where none were given.
  /// @throws ArgumentError when there is no such entry
  FeatureVector features(std::uint64_t id) const { return entryOf(id)->features; }

  /// The entries that are most like a bag, the best first; where scores are the same, the lower id
  /// first. Those without a common word are not among them, nor those whose score is no number,
  /// because values are so large that it overflows.
  /// @throws ArgumentError when the words do not ascend or a value is below 0 or not finite
  std::vector<QueryResult> query(const BowVector& bow,
                                 const QueryOptions& options = QueryOptions()) const {
    std::vector<QueryResult> results;
    query(bow, options, results);
    return results;
  }
  /// The same into a list that keeps its memory: nothing is allocated once it is large enough.
  void query(const BowVector& bow, const QueryOptions& options,
             std::vector<QueryResult>& results) const {
    detail::checkArgument("bow", bow);
    std::unique_ptr<detail::BowScratch> scratch = data_->scratches.take();
    const detail::BowSearch<QueryOptions, QueryResult> search = {data_->store, *scratch, bow,
                                                                 options, results};
    detail::withTerm(data_->scoring, search);
    data_->scratches.give(std::move(scratch));
  }

  /// Writes all entries, as they are at this moment. The file appears when it is complete, in place
  /// of one that was there. docs/formats/bow_database.md describes it.
  /// @param path         of the file
  /// @param fingerprint  of the vocabulary, such as that of fingerprint.h, for loadDatabase()
  /// @throws FileError when it cannot be written
  void save(const std::string& path, std::uint64_t fingerprint = 0) const {
    detail::DatabaseFacts facts;
    facts.scoring = data_->scoring;
    facts.fingerprint = fingerprint;
    const auto entries = data_->store.entries();
    facts.next_id = nextId();
    facts.entry_count = entries.size();
    detail::writeDatabase(path, facts, entries);
  }

 private:
  friend BowDatabase detail::databaseFromBytes(const std::uint8_t* data, std::size_t size,
                                               const std::string& source,
                                               std::uint64_t fingerprint);
  explicit BowDatabase(std::unique_ptr<detail::BowDatabaseData> data) : data_(std::move(data)) {}

  struct CheckScoring {
    template <class Term>
    void operator()(Term) const noexcept {}
  };

  std::shared_ptr<const detail::BowEntry> entryOf(std::uint64_t id) const {
    std::shared_ptr<const detail::BowEntry> entry = data_->store.find(id);
    if (entry == nullptr) throw ArgumentError("id", "is " + std::to_string(id) + ": no entry");
    return entry;
  }

  std::unique_ptr<detail::BowDatabaseData> data_;
};

namespace detail {

// The bytes of a file.
inline BowDatabase databaseFromBytes(const std::uint8_t* data, std::size_t size,
                                     const std::string& source, std::uint64_t fingerprint) {
  DatabaseReader reader(data, size, source);
  const DatabaseFacts facts = reader.readHeader();
  if (fingerprint != 0 && facts.fingerprint != fingerprint) {
    throw ParseError(source, 0, 0,
                     "is of a vocabulary with the fingerprint " +
                         std::to_string(facts.fingerprint) + ", at byte 16, expected " +
                         std::to_string(fingerprint));
  }
  std::unique_ptr<BowDatabaseData> database(new BowDatabaseData);
  database->scoring = facts.scoring;
  reader.readEntries(facts, database->store);
  return BowDatabase(std::move(database));
}

}  // namespace detail

/// Reads what BowDatabase::save() wrote. All of it is checked.
/// @param path         of the file
/// @param fingerprint  that save() was called with; 0: any
/// @throws FileError when it cannot be read, ParseError when it is damaged, of another version, or
///         of a vocabulary with another fingerprint
inline BowDatabase loadDatabase(const std::string& path, std::uint64_t fingerprint = 0) {
  const detail::MappedFile file(path);
  return detail::databaseFromBytes(static_cast<const std::uint8_t*>(file.data()), file.size(), path,
                                   fingerprint);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DATABASE_H
