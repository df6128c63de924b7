#ifndef GSLAM_MESSENGER_SYNCHRONIZER_H
#define GSLAM_MESSENGER_SYNCHRONIZER_H

#include <gslam/messenger/detail/approximate_matcher.h>
#include <gslam/messenger/detail/exact_matcher.h>
#include <gslam/messenger/detail/set_delivery.h>
#include <gslam/messenger/message_stamp.h>
#include <gslam/messenger/messenger.h>
#include <gslam/messenger/time_policy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

/// @file
/// Messages of several topics that belong together in time.

namespace gslam {
inline namespace v1 {

/// Subscribes to two to four topics, and calls back with one message of each that belong together
/// by their stamps; MessageStamp tells these. It ends with this object.
///
///     gslam::Synchronizer<Image, Imu> synchronizer(
///         messenger, {"/left", "/imu"}, gslam::approximateTime(5000000), 100,
///         [](const Image& image, const Imu& imu) { ... });
///
/// **Callbacks** run without a lock, one at a time, with sets in the order of time, in the thread
/// of the publisher that completed the set. When a set is completed while a callback runs, in
/// another thread or by this very callback, it waits, and the thread of that callback delivers it
/// next. Callbacks may publish, and may destroy the Synchronizer. What they throw goes to
/// Messenger::onError(), with the topic whose message completed the set; the sets after it are
/// delivered all the same.
///
/// **Memory**: of each topic no more messages are kept than the queue size says, and, while a
/// callback runs, as many complete sets; beyond that the oldest are dropped. What waits at the end
/// is dropped.
///
/// **Late messages** are dropped, as the policy says. So a source that starts over at an earlier
/// time, as a dataset that is played again, is not heard until reset().
///
/// Movable, not copyable. dropped(), waiting() and reset() are thread-safe, otherwise it is not for
/// use by two threads at once. When the end returns, the callback does not run and will not run any
/// more, as with a Subscriber: it waits for a callback that another thread is in, but not where it
/// is itself called from inside of a callback.
template <class... Messages>
class Synchronizer {
 public:
  /// Number of topics.
  static constexpr std::size_t size() noexcept { return sizeof...(Messages); }
  static_assert(sizeof...(Messages) >= 2 && sizeof...(Messages) <= max_synchronized_topics,
                "a Synchronizer takes two to four topics");

  /// Synchronizes nothing.
  Synchronizer() = default;

  /// Subscribes. The first callback may come before this returns.
  /// @param messenger   where the topics are
  /// @param topics      one for each type
  /// @param policy      exactTime() or approximateTime(), which say what belongs together
  /// @param queue_size  how many messages of each topic may wait, in exact time how many sets
  /// @param callback    takes `const Messages&...` or `std::shared_ptr<const Messages>...`
  /// @throws ArgumentError for a queue of 0, an empty callback or an impossible name, TypeMismatch
  ///         when a topic carries another type
  template <class Policy, class F>
  Synchronizer(const Messenger& messenger,
               const std::array<std::string, sizeof...(Messages)>& topics, const Policy& policy,
               std::size_t queue_size, F callback) {
    if (queue_size == 0) throw ArgumentError("queue_size", "is 0, expected 1 or more");
    if (detail::isEmpty(callback, 0))
      throw ArgumentError("callback", "is empty, expected a function");
    std::array<std::string, sizeof...(Messages)> names;
    for (std::size_t i = 0; i < size(); ++i) names[i] = messenger.resolved(topics[i]);
    delivery_ = std::make_shared<detail::TypedSetDelivery<F, Messages...>>(
        detail::makeMatcher<sizeof...(Messages)>(policy, queue_size), std::move(names), queue_size,
        messenger.hub_->errors(), std::move(callback));
    subscribe(messenger, topics, typename detail::MakeIndices<sizeof...(Messages)>::Type());
  }

  /// Takes the subscriptions over; `other` synchronizes nothing then.
  Synchronizer(Synchronizer&& other) noexcept = default;
  /// Ends its own subscriptions and takes the others over.
  Synchronizer& operator=(Synchronizer&& other) noexcept {
    Synchronizer ended(std::move(other));
    delivery_.swap(ended.delivery_);
    subscribers_.swap(ended.subscribers_);
    return *this;
  }
  ~Synchronizer() { unsubscribe(); }

  /// Ends the subscriptions.
  void unsubscribe() noexcept {
    // Taken out first: the end of the callback may destroy this object, which it may own.
    const std::shared_ptr<Delivery> delivery = std::move(delivery_);
    const Subscribers subscribers = std::move(subscribers_);
    if (delivery) delivery->end();
  }

  /// Whether it is subscribed.
  explicit operator bool() const noexcept { return delivery_ != nullptr; }

  /// Forgets what came: drops the messages that wait for others, and takes messages of any time
  /// again. Complete sets are still delivered.
  void reset() {
    if (delivery_) delivery_->reset();
  }

  /// Messages of a topic that were not, and will not be, delivered; 0 when it synchronizes nothing.
  /// @param topic  its place among the topics, from 0
  /// @throws ArgumentError where there is none
  std::uint64_t dropped(std::size_t topic) const {
    return delivery_ ? delivery_->dropped(topic) : 0;
  }
  /// Messages of a topic that wait for others, or for the callback; 0 when it synchronizes nothing.
  /// @param topic  its place among the topics, from 0
  /// @throws ArgumentError where there is none
  std::size_t waiting(std::size_t topic) const { return delivery_ ? delivery_->waiting(topic) : 0; }
  /// Name of a topic; empty when it synchronizes nothing.
  /// @param topic  its place among the topics, from 0
  /// @throws ArgumentError where there is none
  std::string topic(std::size_t topic) const {
    return delivery_ ? delivery_->topic(topic) : std::string();
  }

 private:
  using Subscribers = std::array<Subscriber, sizeof...(Messages)>;
  using Delivery = detail::SetDelivery<sizeof...(Messages)>;

  template <std::size_t... Is>
  void subscribe(const Messenger& messenger,
                 const std::array<std::string, sizeof...(Messages)>& topics,
                 detail::Indices<Is...>) {
    // in braces: one after the other
    subscribers_ = Subscribers{{subscribeTo<Messages>(messenger, topics[Is], Is)...}};
  }

  template <class T>
  Subscriber subscribeTo(const Messenger& messenger, const std::string& name, std::size_t topic) {
    const std::shared_ptr<Delivery> delivery = delivery_;
    return messenger.subscribe<T>(
        name, SubscribeOptions().named("synchronizer"),
        [delivery, topic](const std::shared_ptr<const T>& message) {
          delivery->receive(topic, {MessageStamp<T>::nanoseconds(*message), message});
        });
  }

  std::shared_ptr<Delivery> delivery_;
  Subscribers subscribers_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_SYNCHRONIZER_H
