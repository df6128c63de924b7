#ifndef GSLAM_MESSENGER_MESSENGER_H
#define GSLAM_MESSENGER_MESSENGER_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>
#include <gslam/messenger/any_message.h>
#include <gslam/messenger/inbox.h>
#include <gslam/messenger/info.h>
#include <gslam/messenger/options.h>
#include <gslam/messenger/publisher.h>
#include <gslam/messenger/subscriber.h>

#include <chrono>
#include <initializer_list>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// Publish and subscribe by topic inside one process.

namespace gslam {
inline namespace v1 {
namespace detail {

/// Another name for a topic, and those that were given before.
struct OtherName {
  std::string from;
  std::string to;
  std::shared_ptr<const OtherName> before;
};

}  // namespace detail

/// What Messenger::advertise() keeps of messages.
enum class Latch {
  off,  ///< nothing
  on    ///< the last message, which late subscribers get first, before subscribe() returns
};

/// Connects publishers and subscribers by the name and type of a topic.
///
/// A handle: copies are the same messenger. It may go before its publishers and subscribers do. A
/// topic takes its type from whoever comes first and keeps it as long as the messenger lives.
/// All members are thread-safe, and may be called from callbacks. No lock is held while a callback
/// runs.
///
/// **Names** are parts of letters, digits and `_`, joined by `/`: "/sensor/imu". One without a
/// leading slash lies in the name space of the handle, which is "/" unless it was made by
/// inNamespace().
class Messenger {
 public:
  Messenger() : hub_(std::make_shared<detail::Hub>()) {}

  /// A handle of the same messenger for which names without a leading slash lie in a name space:
  /// `messenger.inNamespace("orb").advertise<Pose>("pose")` is "/orb/pose".
  /// @throws ArgumentError for an impossible name
  Messenger inNamespace(const std::string& space) const;

  /// @{
  /// A handle of the same messenger that uses other names for some: with {{"image",
  /// "/camera/left"}} who subscribes to "image" gets "/camera/left".
  /// @param names  pairs of strings, such as a std::map of them
  /// @throws ArgumentError for an impossible name
  Messenger remapped(std::initializer_list<std::pair<const std::string, std::string>> names) const {
    return withNames(names);
  }
  template <class Map>
  Messenger remapped(const Map& names) const {
    return withNames(names);
  }
  /// @}

  /// Makes a sender for a topic.
  /// @throws ArgumentError for an impossible name, TypeMismatch when the topic carries another type
  template <class T>
  Publisher<T> advertise(const std::string& topic, Latch latch = Latch::off) const;

  /// @{
  /// Sends one message by the name of its topic; many are sent faster by a Publisher.
  /// @throws ArgumentError for null or an impossible name, TypeMismatch when the topic carries
  ///         another type
  template <class T>
  void publish(const std::string& topic, const std::shared_ptr<const T>& message) const {
    if (!message) throw ArgumentError("message", "is null, expected one to publish on " + topic);
    detail::Letter<T> letter(message);
    find<T>(topic)->deliver(letter);
  }
  template <class T>
  void publish(const std::string& topic, const T& message) const {
    detail::Letter<T> letter(message);
    find<T>(topic)->deliver(letter);
  }
  template <class T, class = typename std::enable_if<!std::is_lvalue_reference<T>::value &&
                                                     !std::is_const<T>::value>::type>
  void publish(const std::string& topic, T&& message) const {
    detail::Letter<T> letter(std::forward<T>(message));
    find<T>(topic)->deliver(letter);
  }
  /// @}

  /// Calls `callback` in the publisher's thread with each message that is published from now on.
  /// On a latched topic this calls it, too, and returns when no newer message was latched
  /// meanwhile: late, where messages come faster than the callback handles them.
  /// @param topic     its name
  /// @param callback  takes `const T&` (as a generic lambda does) or `std::shared_ptr<const T>`; it
  ///                  may be called by several threads at once, if several publish
  /// @return the handle that holds the subscription: without it the subscription ends at once
  /// @throws ArgumentError for an empty callback or an impossible name, TypeMismatch when the topic
  ///         carries another type
  template <class T, class F>
  GSLAM_NODISCARD Subscriber subscribe(const std::string& topic, F callback) const {
    return subscribe<T>(topic, SubscribeOptions(), std::move(callback));
  }
  /// Calls `callback` with each message, as the options say.
  template <class T, class F>
  GSLAM_NODISCARD Subscriber subscribe(const std::string& topic, const SubscribeOptions& options,
                                       F callback) const;
  /// Calls a member function: `messenger.subscribe<Pose>("pose", &Viewer::show, &viewer)`.
  template <class T, class Method, class Object,
            class = typename std::enable_if<std::is_member_function_pointer<Method>::value>::type>
  GSLAM_NODISCARD Subscriber subscribe(const std::string& topic, Method method,
                                       Object object) const {
    return subscribe<T>(topic, SubscribeOptions(), method, object);
  }
  /// Calls a member function, as the options say.
  template <class T, class Method, class Object>
  GSLAM_NODISCARD Subscriber subscribe(const std::string& topic, const SubscribeOptions& options,
                                       Method method, Object object) const;

  /// Calls `callback(const AnyMessage&)` with the messages of all topics that match a pattern, now
  /// and later: `*` stands for any characters but slashes, `**` for any. "/**" is all of them but
  /// what the messenger tells of itself, "/messenger/**".
  template <class F>
  GSLAM_NODISCARD Subscriber subscribeAny(const std::string& pattern,
                                          const SubscribeOptions& options, F callback) const;
  /// The same, synchronously.
  template <class F>
  GSLAM_NODISCARD Subscriber subscribeAny(const std::string& pattern, F callback) const {
    return subscribeAny(pattern, SubscribeOptions(), std::move(callback));
  }

  /// Keeps messages until they are asked for; the queue is bounded as the options say.
  template <class T>
  GSLAM_NODISCARD Inbox<T> inbox(const std::string& topic,
                                 const SubscribeOptions& options = SubscribeOptions()) const;

  /// Answers calls of a service with `handler(const Request&)`, which gives a Response; in the
  /// caller's thread, or as the options say. There is one server of a service at a time.
  /// @return the handle with which the service ends
  /// @throws ArgumentError for an empty handler, an impossible name or a service that is served
  ///         already, TypeMismatch when it has other types
  template <class Request, class Response, class Handler>
  GSLAM_NODISCARD Subscriber serve(const std::string& service, const SubscribeOptions& options,
                                   Handler handler) const;
  /// The same, in the caller's thread.
  template <class Request, class Response, class Handler>
  GSLAM_NODISCARD Subscriber serve(const std::string& service, Handler handler) const {
    return serve<Request, Response>(service, SubscribeOptions(), std::move(handler));
  }

  /// Asks a service and waits for the answer. A service that answers in the caller's thread takes
  /// as long as it takes; the timeout is for others.
  /// @throws ServiceError when nobody serves it, or gives no answer in time; what the handler
  ///         threw; TypeMismatch and ArgumentError as advertise()
  template <class Request, class Response, class Rep, class Period>
  Response call(const std::string& service, Request request,
                const std::chrono::duration<Rep, Period>& timeout) const;

  /// Whether somebody serves it now.
  bool hasService(const std::string& service) const;

  /// Ends all subscriptions and services, also those that are kept; from then on publishing reaches
  /// nobody, and nothing new can be joined (an Error). What callbacks publish while queues are
  /// drained reaches those who have not ended yet.
  /// @param pending  what becomes of messages that wait in queues
  void shutDown(Pending pending) const { hub_->shutDown(pending); }

  /// Gets what callbacks throw, in the thread where they do, from now on; the log gets it where no
  /// handler is set, or the handler throws it on.
  void onError(CallbackErrorHandler handler) const { hub_->errors()->set(std::move(handler)); }

  /// All topics at this moment, by name.
  std::vector<TopicInfo> topics() const;

 private:
  template <class... Messages>
  friend class Synchronizer;
  using Names = std::shared_ptr<const detail::OtherName>;

  Messenger(std::shared_ptr<detail::Hub> hub, std::string space, Names names)
      : hub_(std::move(hub)), space_(std::move(space)), names_(std::move(names)) {}

  template <class T>
  std::shared_ptr<detail::Topic> find(const std::string& topic) const {
    const detail::PayloadType type = detail::PayloadType::of<T>();
    if (!names_) {  // a name that is there needs no checks
      std::shared_ptr<detail::Topic> known = hub_->knownTopic(topic, type);
      if (known) return known;
    }
    return hub_->topic(resolved(topic), type);
  }
  std::string resolved(const std::string& topic) const;
  template <class Map>
  Messenger withNames(const Map& names) const;

  template <class Payload, class F>
  std::shared_ptr<detail::Subscription> makeSubscription(const SubscribeOptions& options,
                                                         const std::string& topic,
                                                         F callback) const;

  std::shared_ptr<detail::Hub> hub_;
  std::string space_;  // "" or such as "/orb"
  Names names_;        // the last of them; null where nothing is remapped
};

}  // namespace v1
}  // namespace gslam

#include <gslam/messenger/detail/messenger_impl.h>

#endif  // GSLAM_MESSENGER_MESSENGER_H
