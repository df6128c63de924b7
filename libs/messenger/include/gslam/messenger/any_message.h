#ifndef GSLAM_MESSENGER_ANY_MESSAGE_H
#define GSLAM_MESSENGER_ANY_MESSAGE_H

#include <gslam/messenger/detail/payload_type.h>
#include <gslam/messenger/errors.h>

#include <memory>
#include <string>
#include <utility>

/// @file
/// A message of any type, for those who take them all: recorders, bridges, viewers.

namespace gslam {
inline namespace v1 {

/// A message together with its topic and type. Copies share the message.
class AnyMessage {
 public:
  /// No message.
  AnyMessage() = default;
  /// Made by topics.
  AnyMessage(std::shared_ptr<const std::string> topic, detail::PayloadType type,
             std::shared_ptr<const void> message)
      : topic_(std::move(topic)), type_(type), message_(std::move(message)) {}

  /// Name of the topic; empty where there is no message.
  const std::string& topic() const {
    static const std::string none;
    return topic_ != nullptr ? *topic_ : none;
  }
  /// Name of the type, as C++ has it.
  std::string typeName() const { return message_ != nullptr ? type_.name() : std::string(); }
  /// Of the type itself, in bytes, without what it points to.
  std::size_t typeSize() const noexcept { return type_.size; }
  /// The message as bytes of no known type.
  const std::shared_ptr<const void>& get() const noexcept { return message_; }

  /// Whether it is a T.
  template <class T>
  bool is() const noexcept {
    return message_ != nullptr && type_ == detail::PayloadType::of<T>();
  }
  /// The message, if it is a T.
  /// @throws TypeMismatch where it is none
  template <class T>
  std::shared_ptr<const T> as() const {
    const detail::PayloadType asked = detail::PayloadType::of<T>();
    if (!is<T>()) throw TypeMismatch(topic(), typeName(), asked.name());
    return std::static_pointer_cast<const T>(message_);
  }

 private:
  std::shared_ptr<const std::string> topic_;
  detail::PayloadType type_ = {&typeid(void), 0, 0, false};
  std::shared_ptr<const void> message_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_ANY_MESSAGE_H
