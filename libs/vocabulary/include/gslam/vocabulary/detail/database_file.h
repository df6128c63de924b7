// The bytes of a file of a database; docs/formats/bow_database.md describes them.
#ifndef GSLAM_VOCABULARY_DETAIL_DATABASE_FILE_H
#define GSLAM_VOCABULARY_DETAIL_DATABASE_FILE_H

#include <gslam/base/detail/checksum.h>
#include <gslam/base/detail/little_endian.h>
#include <gslam/base/detail/new_file.h>
#include <gslam/base/error.h>
#include <gslam/vocabulary/bow_vector.h>
#include <gslam/vocabulary/detail/bow_store.h>
#include <gslam/vocabulary/detail/check_bow.h>
#include <gslam/vocabulary/weighting.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr char kDatabaseMagic[9] = "GSLAMBOW";
constexpr std::uint32_t kDatabaseVersion = 1;
constexpr std::size_t kDatabaseHeaderSize = 56;  // its last 8 bytes are the checksum of the others
constexpr std::size_t kDatabaseEntrySize = 24;   // of an entry, before its lists

// What the header says.
struct DatabaseFacts {
  Scoring scoring = Scoring::l1;
  std::uint64_t fingerprint = 0;
  std::uint64_t next_id = 0;
  std::uint64_t entry_count = 0;
};

// Numbers of any type as bytes, behind those that are there.
class DatabaseBytes {
 public:
  void add(std::uint32_t value) { addInteger(value); }
  void add(std::uint64_t value) { addInteger(value); }
  void add(const std::vector<std::uint32_t>& values) { addAll<std::uint32_t>(values); }
  void add(const std::vector<double>& values) { addAll<std::uint64_t>(values); }
  void addChecksumSince(std::size_t begin) {
    add(Xxh64::of(bytes_.data() + begin, bytes_.size() - begin));
  }
  std::vector<std::uint8_t>& bytes() noexcept { return bytes_; }

 private:
  template <class Unsigned>
  void addInteger(Unsigned value) {
    bytes_.resize(bytes_.size() + sizeof value);
    storeLittle(&bytes_[bytes_.size() - sizeof value], value);
  }
  template <class Bits, class Number>
  void addAll(const std::vector<Number>& values) {
    if (values.empty()) return;
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + values.size() * sizeof(Bits));
    for (std::size_t i = 0; i < values.size(); ++i) {
      Bits bits;
      std::memcpy(&bits, &values[i], sizeof bits);
      storeLittle(&bytes_[begin + i * sizeof bits], bits);
    }
  }

  std::vector<std::uint8_t> bytes_;
};

inline void addDatabaseHeader(const DatabaseFacts& facts, DatabaseBytes& to) {
  to.bytes().insert(to.bytes().end(), kDatabaseMagic, kDatabaseMagic + 8);
  to.add(kDatabaseVersion);
  to.add(static_cast<std::uint32_t>(facts.scoring));
  to.add(facts.fingerprint);
  to.add(facts.next_id);
  to.add(facts.entry_count);
  to.add(std::uint64_t(0));
  to.addChecksumSince(0);
}

inline void addDatabaseEntry(std::uint64_t id, const BowEntry& entry, DatabaseBytes& to) {
  const std::size_t begin = to.bytes().size();
  to.add(id);
  to.add(static_cast<std::uint32_t>(entry.bow.size()));
  to.add(static_cast<std::uint32_t>(entry.features.nodes.size()));
  to.add(static_cast<std::uint64_t>(entry.features.features.size()));
  to.add(entry.bow.values);
  to.add(entry.bow.words);
  to.add(entry.features.nodes);
  if (!entry.features.empty()) to.add(entry.features.begins);
  to.add(entry.features.features);
  to.addChecksumSince(begin);
}

using DatabaseEntries = std::vector<std::pair<std::uint64_t, std::shared_ptr<const BowEntry>>>;

inline void writeDatabase(const std::string& path, const DatabaseFacts& facts,
                          const DatabaseEntries& entries) {
  constexpr std::size_t kPiece = std::size_t(1) << 20;
  NewFile file(path);
  DatabaseBytes piece;
  addDatabaseHeader(facts, piece);
  for (const auto& entry : entries) {
    addDatabaseEntry(entry.first, *entry.second, piece);
    if (piece.bytes().size() < kPiece) continue;
    file.write(piece.bytes().data(), piece.bytes().size());
    piece.bytes().clear();
  }
  file.write(piece.bytes().data(), piece.bytes().size());
  file.commit();
}

// Reads all of a file that lies in memory, of which no word is believed.
class DatabaseReader {
 public:
  DatabaseReader(const std::uint8_t* data, std::size_t size, const std::string& source)
      : data_(data), size_(size), source_(source) {}

  DatabaseFacts readHeader() {
    if (size_ < 8 || std::memcmp(data_, kDatabaseMagic, 8) != 0) {
      fail(0, "is no database: it does not begin with GSLAMBOW");
    }
    if (size_ < kDatabaseHeaderSize) fail(size_, "ends inside its header of 56 bytes");
    const std::uint32_t version = loadLittle<std::uint32_t>(data_ + 8);
    if (version != kDatabaseVersion) {
      fail(8, "has version " + std::to_string(version) + ", expected 1: it needs another GSLAM");
    }
    checkSum(0, kDatabaseHeaderSize - 8);
    DatabaseFacts facts;
    const std::uint32_t scoring = loadLittle<std::uint32_t>(data_ + 12);
    if (scoring > 5) fail(12, "has scoring " + std::to_string(scoring) + ", expected 0 to 5");
    facts.scoring = static_cast<Scoring>(scoring);
    facts.fingerprint = loadLittle<std::uint64_t>(data_ + 16);
    facts.next_id = loadLittle<std::uint64_t>(data_ + 24);
    facts.entry_count = loadLittle<std::uint64_t>(data_ + 32);
    if (loadLittle<std::uint64_t>(data_ + 40) != 0) fail(40, "has something where zeros must be");
    place_ = kDatabaseHeaderSize;
    return facts;
  }

  void readEntries(const DatabaseFacts& facts, BowStore& store) {
    for (std::uint64_t i = 0; i < facts.entry_count; ++i) readEntry(facts, store);
    if (place_ != size_) fail(place_, "goes on behind its last entry");
    store.setNextId(facts.next_id);
  }

 private:
  [[noreturn]] void fail(std::size_t place, const std::string& problem) const {
    throw ParseError(source_, 0, 0, problem + ", at byte " + std::to_string(place));
  }

  void checkSum(std::size_t begin, std::size_t end) const {
    if (loadLittle<std::uint64_t>(data_ + end) == Xxh64::of(data_ + begin, end - begin)) return;
    fail(begin,
         "is damaged: bytes up to " + std::to_string(end) + " do not fit the checksum there");
  }

  void readEntry(const DatabaseFacts& facts, BowStore& store) {
    const std::size_t begin = place_;
    if (size_ - begin < kDatabaseEntrySize + 8) fail(size_, "ends inside an entry");
    const std::uint8_t* const head = data_ + begin;
    const std::uint64_t id = loadLittle<std::uint64_t>(head);
    const std::size_t words = loadLittle<std::uint32_t>(head + 8);
    const std::size_t nodes = loadLittle<std::uint32_t>(head + 12);
    const std::uint64_t features = loadLittle<std::uint64_t>(head + 16);
    place_ += kDatabaseEntrySize;
    left_ = size_ - place_ - 8;
    reserve(words, 12);
    reserve(nodes, 4);
    if (nodes != 0) reserve(nodes + 1, 4);
    reserve(features, 4);
    checkSum(begin, size_ - 8 - left_);
    if (id < store.nextId() || id >= facts.next_id) {
      fail(begin, "has an entry with the id " + std::to_string(id) + ", expected " +
                      std::to_string(store.nextId()) + " to below " +
                      std::to_string(facts.next_id));
    }
    const auto entry = std::make_shared<BowEntry>();
    readList<std::uint64_t>(words, entry->bow.values);
    readList<std::uint32_t>(words, entry->bow.words);
    readList<std::uint32_t>(nodes, entry->features.nodes);
    if (nodes != 0) readList<std::uint32_t>(nodes + 1, entry->features.begins);
    readList<std::uint32_t>(static_cast<std::size_t>(features), entry->features.features);
    place_ += 8;
    std::string problem = problemOf(entry->bow);
    if (problem.empty()) problem = problemOf(entry->features);
    if (!problem.empty()) fail(begin, "has an entry whose bag " + problem);
    store.addWithId(id, entry);
  }

  // Whether there is as much as a list needs.
  void reserve(std::uint64_t count, std::size_t size) {
    if (count > left_ / size) fail(size_, "ends inside an entry");
    left_ -= static_cast<std::size_t>(count) * size;
  }

  template <class Bits, class Number>
  void readList(std::size_t count, std::vector<Number>& list) {
    static_assert(sizeof(Bits) == sizeof(Number), "bits of a number");
    list.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Bits bits = loadLittle<Bits>(data_ + place_ + i * sizeof(Bits));
      std::memcpy(&list[i], &bits, sizeof bits);
    }
    place_ += count * sizeof(Bits);
  }

  const std::uint8_t* data_;
  std::size_t size_;
  const std::string& source_;
  std::size_t place_ = 0;
  std::size_t left_ = 0;  // bytes that no list of the entry has taken, without its checksum
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_DATABASE_FILE_H
