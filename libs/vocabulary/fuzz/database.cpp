// Any bytes are a database that can be asked, changed and saved, or are refused with a ParseError.
// Checksums are made right first: a fuzzer finds none.
#include <gslam/vocabulary/database.h>
#include <gslam/vocabulary/score.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace {

using Bytes = std::vector<std::uint8_t>;
using gslam::detail::loadLittle;

void signPart(Bytes& bytes, std::size_t begin, std::size_t end) {
  gslam::detail::storeLittle(&bytes[end], gslam::detail::Xxh64::of(&bytes[begin], end - begin));
}

// Follows the lengths as far as they lead.
void sign(Bytes& bytes) {
  if (bytes.size() < gslam::detail::kDatabaseHeaderSize) return;
  signPart(bytes, 0, gslam::detail::kDatabaseHeaderSize - 8);
  std::size_t begin = gslam::detail::kDatabaseHeaderSize;
  while (bytes.size() - begin >= gslam::detail::kDatabaseEntrySize + 8) {
    const std::uint64_t words = loadLittle<std::uint32_t>(&bytes[begin + 8]);
    const std::uint64_t nodes = loadLittle<std::uint32_t>(&bytes[begin + 12]);
    const std::uint64_t features = loadLittle<std::uint64_t>(&bytes[begin + 16]);
    if (features > bytes.size()) return;
    const std::uint64_t length = gslam::detail::kDatabaseEntrySize + 12 * words + 4 * features +
                                 (nodes == 0 ? 0 : 8 * nodes + 4);
    if (length > bytes.size() - begin - 8) return;
    const std::size_t end = begin + static_cast<std::size_t>(length);
    signPart(bytes, begin, end);
    begin = end + 8;
  }
}

Bytes bytesOf(const gslam::BowDatabase& database, const std::vector<std::uint64_t>& ids) {
  gslam::detail::DatabaseFacts facts;
  facts.scoring = database.scoring();
  facts.next_id = database.nextId();
  facts.entry_count = ids.size();
  gslam::detail::DatabaseBytes bytes;
  addDatabaseHeader(facts, bytes);
  for (const std::uint64_t id : ids) {
    addDatabaseEntry(id, {database.bow(id), database.features(id)}, bytes);
  }
  return bytes.bytes();
}

// It comes back from a file, finds what score() says, and can be emptied.
void use(gslam::BowDatabase& database) {
  const std::vector<std::uint64_t> ids = database.ids();
  if (ids.size() != database.size()) std::abort();
  const Bytes saved = bytesOf(database, ids);
  const gslam::BowDatabase again =
      gslam::detail::databaseFromBytes(saved.data(), saved.size(), "saved", 0);
  if (bytesOf(again, again.ids()) != saved) std::abort();
  gslam::QueryOptions all;
  all.count = 0;
  for (const std::uint64_t id : ids) {
    const gslam::BowVector bow = database.bow(id);
    for (const gslam::QueryResult& result : database.query(bow, all)) {
      if (result.score != score(database.scoring(), bow, database.bow(result.id))) std::abort();
    }
    if (database.query(bow) != again.query(bow)) std::abort();
  }
  for (const std::uint64_t id : ids) {
    if (!database.erase(id)) std::abort();
  }
  if (!database.empty()) std::abort();
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, data + size);
  sign(bytes);
  try {
    gslam::BowDatabase database =
        gslam::detail::databaseFromBytes(bytes.data(), bytes.size(), "input", 0);
    use(database);
  } catch (const gslam::ParseError&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  return 0;
}
