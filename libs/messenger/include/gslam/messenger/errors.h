#ifndef GSLAM_MESSENGER_ERRORS_H
#define GSLAM_MESSENGER_ERRORS_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>

#include <string>

/// @file
/// What can go wrong between publishers and subscribers.

namespace gslam {
inline namespace v1 {

/// Publisher and subscriber of one topic do not agree on the message type.
class GSLAM_PUBLIC TypeMismatch : public Error {
 public:
  /// @param topic  name of the topic
  /// @param has    type it was first used with
  /// @param asked  type asked for now
  TypeMismatch(const std::string& topic, const std::string& has, const std::string& asked)
      : Error("topic " + topic + " carries " + has + ", not " + asked) {}
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_ERRORS_H
