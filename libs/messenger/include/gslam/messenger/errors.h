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

/// A service that gave no answer.
class GSLAM_PUBLIC ServiceError : public Error {
 public:
  /// Why there is none.
  enum Reason {
    unavailable,  ///< nobody serves it
    timeout,      ///< the answer did not come in time
    dropped       ///< the call was dropped: its server ended, or its queue was full
  };

  /// @param service  its name
  /// @param reason   why there is no answer
  ServiceError(const std::string& service, Reason reason)
      : Error("service " + service + " gave no answer: " +
              (reason == unavailable ? "nobody serves it"
               : reason == timeout   ? "it did not come in time"
                                     : "the call was dropped by its server")),
        reason_(reason) {}

  /// Why there is none.
  Reason reason() const noexcept { return reason_; }

 private:
  Reason reason_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_ERRORS_H
