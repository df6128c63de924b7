// Writes databases as rosbag2 does.
#ifndef GSLAM_DATASETS_ROS_TESTS_DB3_WRITER_H
#define GSLAM_DATASETS_ROS_TESTS_DB3_WRITER_H

#include <gslam/base/error.h>
#include <sqlite3.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "recorded.h"

namespace db3_writer {

inline void check(int result, sqlite3* database) {
  if (result == SQLITE_OK || result == SQLITE_DONE) return;
  throw gslam::Error(std::string("SQLite: ") + sqlite3_errmsg(database));
}

inline void run(sqlite3* database, const std::string& sql) {
  check(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), database);
}

/// Tables as schema version 3 has them.
inline void write(const std::string& path, const std::vector<Recorded>& messages) {
  std::remove(path.c_str());
  sqlite3* database = nullptr;
  check(sqlite3_open(path.c_str(), &database), database);
  run(database,
      "PRAGMA page_size = 1024;"
      "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,"
      "serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,"
      "timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
      "CREATE INDEX timestamp_idx ON messages (timestamp ASC); BEGIN");
  std::map<std::string, std::size_t> ids;
  for (const Recorded& one : messages) {
    const auto known = ids.emplace(one.topic, ids.size() + 1);
    const std::string id = std::to_string(known.first->second);
    if (known.second) {
      run(database, "INSERT INTO topics VALUES(" + id + ",'" + one.topic + "','" +
                        ros2Type(one.type) + "','cdr','')");
    }
    sqlite3_stmt* statement = nullptr;
    check(sqlite3_prepare_v2(database,
                             "INSERT INTO messages(topic_id,timestamp,data) VALUES(?1,?2,?3)", -1,
                             &statement, nullptr),
          database);
    sqlite3_bind_int64(statement, 1, std::stoll(id));
    sqlite3_bind_int64(statement, 2, one.received);
    sqlite3_bind_blob(statement, 3, one.bytes.data(), static_cast<int>(one.bytes.size()),
                      SQLITE_STATIC);
    check(sqlite3_step(statement), database);
    sqlite3_finalize(statement);
  }
  run(database, "COMMIT");
  sqlite3_close(database);
}

}  // namespace db3_writer

#endif  // GSLAM_DATASETS_ROS_TESTS_DB3_WRITER_H
