// Recordings of ROS 2 in SQLite databases.
// Source of the tables: rosbag2_storage_sqlite3/src/.../sqlite_storage.cpp, schema versions 1 to 4.
#include <gslam/base/error.h>
#include <sqlite3.h>

#include <algorithm>
#include <limits>
#include <map>
#include <mutex>
#include <utility>

#include "storage.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

struct CloseDatabase {
  void operator()(sqlite3* database) const noexcept { sqlite3_close_v2(database); }
};
struct EndStatement {
  void operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }
};
struct CloseBlob {
  void operator()(sqlite3_blob* blob) const noexcept { sqlite3_blob_close(blob); }
};

// The name of a file that SQLite is to open without a lock, and without looking for what another
// process is writing: nothing is made beside it.
std::string addressOf(const std::string& path) {
  std::string address = path[0] == '/' ? "file://" : "file:";
  for (const char c : path) {
    if (c == '%') address += "%25";
    if (c == '?') address += "%3f";
    if (c == '#') address += "%23";
    if (c != '%' && c != '?' && c != '#') address += c;
  }
  return address + "?immutable=1";
}

class Db3Storage : public Storage {
 public:
  explicit Db3Storage(const std::string& path) : path_(path) {
    openDatabase();
    readTopics();
    readMessages();
    sqlite3_progress_handler(database_.get(), 0, nullptr, nullptr);
    sayUnfinished();
  }

  std::vector<std::uint8_t> read(const MessageRef& message) const override {
    return readBlob(message, std::numeric_limits<int>::max());
  }
  std::vector<std::uint8_t> readHead(const MessageRef& message, std::size_t size) const override {
    return readBlob(message, static_cast<int>(std::min<std::size_t>(size, 1 << 30)));
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(path_, what + ": " + sqlite3_errmsg(database_.get()));
  }

  void openDatabase() {
    const std::uint64_t size = openFile(path_)->size();
    if (size == 0) throw FileError(path_, "is empty, expected a database of ROS 2");
    checkJournal();
    sqlite3* raw = nullptr;
    const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX;
    const int result = sqlite3_open_v2(addressOf(path_).c_str(), &raw, flags, nullptr);
    database_.reset(raw);
    if (result != SQLITE_OK) fail("cannot be opened");
    // What a strange file could use: SQL in it, and sizes beyond the file.
    sqlite3_db_config(raw, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    limitWork(size);
    sqlite3_exec(raw, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
    constexpr std::uint64_t kMost = 1U << 30;
    sqlite3_limit(raw, SQLITE_LIMIT_LENGTH,
                  static_cast<int>(std::min(std::max<std::uint64_t>(size, 1U << 16), kMost)));
  }

  // What was being written when the process died: without it the database is neither the old one
  // nor the new one. Its first byte is zero where it was done with.
  void checkJournal() const {
    const std::string path = path_ + "-journal";
    std::uint8_t first = 0;
    try {
      const auto journal = openFile(path);
      if (journal->size() == 0) return;
      journal->read(0, &first, 1);
    } catch (const FileError&) {
      return;  // there is none, as it should be
    }
    if (first == 0) return;
    throw FileError(path_, "was not closed: what it held before is in " + path +
                               "; open a copy of both once with sqlite3, which puts it right");
  }

  // Pages that are linked in circles would be read for ever. A row takes some bytes of the file,
  // and some steps.
  void limitWork(std::uint64_t file_size) {
    constexpr int kSteps = 1000;
    steps_left_ = 1000 + file_size * 4 / kSteps;
    const auto count = [](void* self) {
      return static_cast<Db3Storage*>(self)->steps_left_-- == 0 ? 1 : 0;
    };
    sqlite3_progress_handler(database_.get(), kSteps, count, this);
  }

  using Statement = std::unique_ptr<sqlite3_stmt, EndStatement>;

  Statement prepare(const char* sql) const {
    sqlite3_stmt* raw = nullptr;
    if (sqlite3_prepare_v2(database_.get(), sql, -1, &raw, nullptr) != SQLITE_OK) {
      fail("is no database of ROS 2, or damaged");
    }
    return Statement(raw);
  }

  // Whether there is another row.
  bool step(const Statement& statement) const {
    const int result = sqlite3_step(statement.get());
    if (result != SQLITE_ROW && result != SQLITE_DONE) fail("is damaged");
    return result == SQLITE_ROW;
  }

  static std::string textAt(const Statement& statement, int column) {
    const unsigned char* const text = sqlite3_column_text(statement.get(), column);
    const int size = sqlite3_column_bytes(statement.get(), column);
    if (text == nullptr || size <= 0) return "";
    return std::string(reinterpret_cast<const char*>(text), static_cast<std::size_t>(size));
  }

  // Views and virtual tables could be anything.
  void checkTable(const char* name) const {
    const Statement statement =
        prepare("SELECT type FROM sqlite_master WHERE name = ?1 AND rootpage > 0");
    sqlite3_bind_text(statement.get(), 1, name, -1, SQLITE_STATIC);
    if (step(statement) && textAt(statement, 0) == "table") return;
    throw FileError(path_, std::string("is no database of ROS 2: it has no table '") + name + "'");
  }

  // The rows of a table, whose first column is the row's number.
  template <class Take>
  void forEachRow(const char* sql, const Take& take) const {
    const Statement statement = prepare(sql);
    bool is_first = true;
    for (std::int64_t last = 0; step(statement); is_first = false) {
      const std::int64_t row = sqlite3_column_int64(statement.get(), 0);
      // Pages that are linked twice would be read again and again.
      if (!is_first && row <= last) throw FileError(path_, "is damaged: rows are out of order");
      last = row;
      take(statement, row);
    }
  }

  // Text or nothing would count as 0.
  std::int64_t numberAt(const Statement& statement, int column, std::int64_t row) const {
    if (sqlite3_column_type(statement.get(), column) != SQLITE_INTEGER) {
      throw FileError(path_, "row " + std::to_string(row) + ": " +
                                 sqlite3_column_name(statement.get(), column) +
                                 " is no whole number");
    }
    return sqlite3_column_int64(statement.get(), column);
  }

  void readTopics() {
    checkTable("topics");
    forEachRow("SELECT rowid, id, name, type, serialization_format FROM topics NOT INDEXED",
               [this](const Statement& statement, std::int64_t row) {
                 topics_[numberAt(statement, 1, row)] = list.add(
                     textAt(statement, 2), textAt(statement, 3), textAt(statement, 4), path_);
               });
  }

  void readMessages() {
    checkTable("messages");
    std::size_t unknown = 0;
    forEachRow(
        "SELECT rowid, topic_id, timestamp FROM messages NOT INDEXED",
        [&](const Statement& statement, std::int64_t row) {
          const auto topic = topics_.find(numberAt(statement, 1, row));
          const std::int64_t stamp = numberAt(statement, 2, row);
          if (topic == topics_.end()) {
            ++unknown;
          } else {
            messages.push_back({stamp, topic->second, 0, static_cast<std::uint64_t>(row), 0});
          }
        });
    if (unknown == 0) return;
    remarks.push_back(path_ + ": " + std::to_string(unknown) +
                      " messages of topics that are not described were skipped");
  }

  void sayUnfinished() {
    try {
      if (openFile(path_ + "-wal")->size() == 0) return;
    } catch (const FileError&) {
      return;  // there is none, as it should be
    }
    remarks.push_back(path_ + " was not closed: what is in " + path_ + "-wal was not read");
  }

  std::vector<std::uint8_t> readBlob(const MessageRef& message, int most) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    sqlite3_blob* raw = nullptr;
    const int result = sqlite3_blob_open(database_.get(), "main", "messages", "data",
                                         static_cast<sqlite3_int64>(message.block), 0, &raw);
    const std::unique_ptr<sqlite3_blob, CloseBlob> blob(raw);
    const std::string place =
        "the message in row " + std::to_string(static_cast<std::int64_t>(message.block));
    if (result != SQLITE_OK) fail(place + " cannot be read");
    std::vector<std::uint8_t> bytes(
        static_cast<std::size_t>(std::max(0, std::min(sqlite3_blob_bytes(raw), most))));
    const int size = static_cast<int>(bytes.size());
    if (size > 0 && sqlite3_blob_read(raw, bytes.data(), size, 0) != SQLITE_OK) {
      fail(place + " cannot be read");
    }
    return bytes;
  }

  std::string path_;
  std::unique_ptr<sqlite3, CloseDatabase> database_;
  std::uint64_t steps_left_ = 0;  // thousands, for opening
  mutable std::mutex mutex_;      // a connection is for one thread at a time
  std::map<std::int64_t, std::uint32_t> topics_;
};

}  // namespace

std::unique_ptr<Storage> openDb3(const std::string& path) {
  return std::make_unique<Db3Storage>(path);
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
