#ifndef GSLAM_CORE_SHARED_MAP_H
#define GSLAM_CORE_SHARED_MAP_H

#include <gslam/core/map.h>

#include <memory>
#include <mutex>
#include <utility>

/// @file
/// A map that one thread writes and others look at.

namespace gslam {
inline namespace v1 {

/// A map that one thread writes, and the last state of it that it showed to all others.
///
///     SharedMap shared;
///     // the SLAM system's thread              // any other
///     shared.edit().add(keyframe);             const auto map = shared.latest();
///     shared.publish();                        for (const auto& item : map->points()) ...
///
/// Nobody waits: a reader has a snapshot that stays as it is for as long as it is kept; the writer
/// goes on, and copies what it changes of what a snapshot has. A few microseconds a snapshot.
///
/// **Threads.** edit() and publish() are for one thread at a time, latest() for any.
class SharedMap {
 public:
  /// Shows an empty map.
  SharedMap() : latest_(std::make_shared<const Map>()) {}
  /// Shows a map, and goes on from there.
  explicit SharedMap(Map map) : map_(std::move(map)), latest_(std::make_shared<const Map>(map_)) {}
  SharedMap(const SharedMap&) = delete;
  SharedMap& operator=(const SharedMap&) = delete;

  /// The map that the writer works on; nobody else sees it.
  Map& edit() noexcept { return map_; }
  /// The same, to be read by the writer.
  const Map& working() const noexcept { return map_; }

  /// Shows the map as it is now.
  std::shared_ptr<const Map> publish() {
    std::shared_ptr<const Map> shown = std::make_shared<const Map>(map_);
    std::shared_ptr<const Map> last = shown;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      latest_.swap(last);
    }
    return shown;  // `last` may be what frees the map before: not under the lock
  }

  /// The map as it was shown last; never null. Who asks for a part of it by find(), at() or
  /// observations() keeps the pointer meanwhile; ranges such as points() keep what they go through.
  std::shared_ptr<const Map> latest() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return latest_;
  }

 private:
  Map map_;
  mutable std::mutex mutex_;
  std::shared_ptr<const Map> latest_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_SHARED_MAP_H
