#ifndef GSLAM_CORE_SLAM_TOPICS_H
#define GSLAM_CORE_SLAM_TOPICS_H

#include <gslam/core/slam.h>
#include <gslam/messenger/messenger.h>

#include <memory>
#include <string>

/// @file
/// What a SLAM system publishes, for everyone else.

namespace gslam {
inline namespace v1 {

/// Gives a SLAM system a messenger of its own, on which no ground truth travels, and publishes its
/// poses and maps for everyone else: a TrackedPose on "/<name>/pose", a Map on "/<name>/map".
///
/// Messages are handed on in the thread that published them. Threads may share it.
class SlamTopics {
 public:
  /// @param name     of the SLAM system, the first part of its topics
  /// @param outside  the messenger of everyone else
  /// @throws ArgumentError when the name cannot be part of a topic
  SlamTopics(const std::string& name, const Messenger& outside)
      : inside_(Messenger().inNamespace(name)),
        pose_(forward<TrackedPose>("pose", outside.inNamespace(name))),
        map_(forward<Map>("map", outside.inNamespace(name))) {}

  /// For SlamSetup::messenger. What it has beyond poses and maps can be had here.
  const Messenger& inside() const noexcept { return inside_; }

 private:
  template <class T>
  Subscriber forward(const std::string& topic, const Messenger& outside) const {
    const Publisher<T> publisher = outside.advertise<T>(topic);
    return inside_.subscribe<T>(topic, [publisher](const std::shared_ptr<const T>& message) {
      publisher.publish(message);
    });
  }

  Messenger inside_;
  Subscriber pose_;
  Subscriber map_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_SLAM_TOPICS_H
