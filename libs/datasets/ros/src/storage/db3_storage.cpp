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
    sqlite3* raw = nullptr;
    const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX;
    const int result = sqlite3_open_v2(addressOf(path_).c_str(), &raw, flags, nullptr);
    database_.reset(raw);
    if (result != SQLITE_OK) fail("cannot be opened");
    // What a strange file could use: SQL in it, and sizes beyond the file.
    sqlite3_db_config(raw, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_exec(raw, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
    constexpr std::uint64_t kMost = 1U << 30;
    sqlite3_limit(raw, SQLITE_LIMIT_LENGTH,
                  static_cast<int>(std::min(std::max<std::uint64_t>(size, 1U << 16), kMost)));
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

  // Views could be anything.
  void checkTable(const char* name) const {
    const Statement statement = prepare("SELECT type FROM sqlite_master WHERE name = ?1");
    sqlite3_bind_text(statement.get(), 1, name, -1, SQLITE_STATIC);
    if (step(statement) && textAt(statement, 0) == "table") return;
    throw FileError(path_, std::string("is no database of ROS 2: it has no table '") + name + "'");
  }

  void readTopics() {
    checkTable("topics");
    const Statement statement = prepare("SELECT id, name, type, serialization_format FROM topics");
    while (step(statement)) {
      const std::int64_t id = sqlite3_column_int64(statement.get(), 0);
      topics_[id] = list.add(textAt(statement, 1), textAt(statement, 2), textAt(statement, 3));
    }
  }

  void readMessages() {
    checkTable("messages");
    const Statement statement =
        prepare("SELECT rowid, topic_id, timestamp FROM messages NOT INDEXED");
    std::size_t unknown = 0;
    bool is_first = true;
    for (std::int64_t last = 0; step(statement); is_first = false) {
      const std::int64_t row = sqlite3_column_int64(statement.get(), 0);
      // Pages that are linked twice would be read again and again.
      if (!is_first && row <= last) throw FileError(path_, "is damaged: rows are out of order");
      last = row;
      const auto topic = topics_.find(sqlite3_column_int64(statement.get(), 1));
      if (topic == topics_.end()) ++unknown;
      if (topic == topics_.end()) continue;
      const std::int64_t stamp = sqlite3_column_int64(statement.get(), 2);
      messages.push_back({stamp, topic->second, 0, static_cast<std::uint64_t>(row), 0});
    }
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
  mutable std::mutex mutex_;  // a connection is for one thread at a time
  std::map<std::int64_t, std::uint32_t> topics_;
};

}  // namespace

std::unique_ptr<Storage> openDb3(const std::string& path) {
  return std::make_unique<Db3Storage>(path);
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
