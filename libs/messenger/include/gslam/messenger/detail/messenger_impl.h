// Function bodies of messenger.h, which says what they do.
#ifndef GSLAM_MESSENGER_DETAIL_MESSENGER_IMPL_H
#define GSLAM_MESSENGER_DETAIL_MESSENGER_IMPL_H

#include <gslam/messenger/messenger.h>

#include <chrono>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Whether a std::function or pointer is empty; nothing else can be.
template <class F>
auto isEmpty(const F& callback, int) -> decltype(callback == nullptr) {
  return callback == nullptr;
}
template <class F>
bool isEmpty(const F&, long) {
  return false;
}

/// A member function together with its object.
template <class Method, class Object>
class MemberCall {
 public:
  MemberCall(Method method, Object object) : method_(method), object_(std::move(object)) {}
  template <class Message>
  auto operator()(const Message& message)
      -> decltype((*std::declval<Object&>().*std::declval<Method>())(message), void()) {
    ((*object_).*method_)(message);
  }
  friend bool operator==(const MemberCall& call, std::nullptr_t) {
    return call.method_ == nullptr || call.object_ == nullptr;
  }

 private:
  Method method_;
  Object object_;
};

}  // namespace detail

// --- names

inline Messenger Messenger::inNamespace(const std::string& space) const {
  return Messenger(hub_, detail::topicName(space_, space), names_);
}

inline Messenger Messenger::remapped(const std::map<std::string, std::string>& names) const {
  Names all = names_ ? *names_ : Names();
  for (const Names::value_type& one : names) {
    all[detail::topicName(space_, one.first)] = resolved(one.second);
  }
  return Messenger(hub_, space_, std::make_shared<const Names>(std::move(all)));
}

inline std::string Messenger::resolved(const std::string& topic) const {
  const std::string name = detail::topicName(space_, topic);
  if (!names_) return name;
  const Names::const_iterator other = names_->find(name);
  return other != names_->end() ? other->second : name;
}

// --- publishing and subscribing

template <class T>
Publisher<T> Messenger::advertise(const std::string& topic, Latch latch) const {
  const std::shared_ptr<detail::Topic> found = find<T>(topic);
  if (latch == Latch::on) found->latch();
  return Publisher<T>(found);
}

template <class Payload, class F>
std::shared_ptr<detail::Subscription> Messenger::makeSubscription(const SubscribeOptions& options,
                                                                  const std::string& topic,
                                                                  F callback) const {
  if (detail::isEmpty(callback, 0))
    throw ArgumentError("callback", "is empty, expected a function");
  if (options.delivery == Delivery::synchronous) {
    return std::make_shared<detail::SynchronousSubscription<Payload, F>>(options, topic,
                                                                         std::move(callback));
  }
  const auto queued = std::make_shared<detail::QueuedSubscription<Payload, F>>(
      options, topic, std::move(callback), hub_->errors());
  queued->start();
  return queued;
}

template <class T, class F>
Subscriber Messenger::subscribe(const std::string& topic, const SubscribeOptions& options,
                                F callback) const {
  const std::shared_ptr<detail::Topic> found = find<T>(topic);
  const std::shared_ptr<detail::Subscription> subscription =
      makeSubscription<detail::TypedPayload<T>>(options, found->name(), std::move(callback));
  found->add(subscription);
  return Subscriber(hub_, found, subscription);
}

template <class T, class Method, class Object>
Subscriber Messenger::subscribe(const std::string& topic, const SubscribeOptions& options,
                                Method method, Object object) const {
  return subscribe<T>(topic, options,
                      detail::MemberCall<Method, Object>(method, std::move(object)));
}

template <class F>
Subscriber Messenger::subscribeAny(const std::string& pattern, const SubscribeOptions& options,
                                   F callback) const {
  const std::shared_ptr<detail::Subscription> subscription = makeSubscription<detail::AnyPayload>(
      options, detail::topicName(space_, pattern, true), std::move(callback));
  hub_->addPattern(subscription);
  return Subscriber(hub_, nullptr, subscription);
}

template <class T>
Inbox<T> Messenger::inbox(const std::string& topic, const SubscribeOptions& options) const {
  using Subscription = detail::InboxSubscription<detail::TypedPayload<T>>;
  const std::shared_ptr<detail::Topic> found = find<T>(topic);
  const auto subscription = std::make_shared<Subscription>(options, found->name());
  found->add(subscription);
  return Inbox<T>(Subscriber(hub_, found, subscription), subscription);
}

// --- telling

inline std::vector<TopicInfo> Messenger::topics() const {
  std::vector<TopicInfo> infos;
  for (const auto& one : hub_->topics()) {
    const detail::Topic& topic = *one.second;
    TopicInfo info = {topic.name(),
                      topic.type().name(),
                      topic.type().size,
                      topic.publisher_count,
                      topic.messageCount(),
                      topic.isLatched(),
                      {},
                      std::chrono::steady_clock::now()};
    for (const std::shared_ptr<detail::Subscription>& subscription : topic.subscriptions()) {
      const detail::QueueCounts counts = subscription->counts();
      info.subscribers.push_back({subscription->name(), subscription->topic(),
                                  subscription->typeName() == "any", counts.waiting,
                                  counts.dropped});
    }
    infos.push_back(std::move(info));
  }
  return infos;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_MESSENGER_IMPL_H
