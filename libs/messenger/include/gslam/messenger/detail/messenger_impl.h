// Function bodies of messenger.h, which says what they do.
#ifndef GSLAM_MESSENGER_DETAIL_MESSENGER_IMPL_H
#define GSLAM_MESSENGER_DETAIL_MESSENGER_IMPL_H

#include <gslam/messenger/detail/service_call.h>
#include <gslam/messenger/messenger.h>

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

template <class Map>
Messenger Messenger::withNames(const Map& names) const {
  Names all = names_;
  for (const auto& one : names) {
    const detail::OtherName next = {detail::topicName(space_, one.first), resolved(one.second),
                                    std::move(all)};
    all = std::make_shared<detail::OtherName>(next);
  }
  return Messenger(hub_, space_, std::move(all));
}

inline std::string Messenger::resolved(const std::string& topic) const {
  std::string name = detail::topicName(space_, topic);
  for (const detail::OtherName* one = names_.get(); one != nullptr; one = one->before.get()) {
    if (one->from == name) return one->to;
  }
  return name;
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
  Subscriber subscriber(found, subscription);
  found->add(subscription);
  hub_->refuseAfterShutDown();
  found->tell(TopicChange::subscriber_came);
  return subscriber;
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
  Subscriber subscriber(hub_, subscription);
  hub_->addPattern(subscription);
  return subscriber;
}

template <class T>
Inbox<T> Messenger::inbox(const std::string& topic, const SubscribeOptions& options) const {
  using Subscription = detail::InboxSubscription<detail::TypedPayload<T>>;
  const std::shared_ptr<detail::Topic> found = find<T>(topic);
  const auto subscription = std::make_shared<Subscription>(options, found->name());
  Subscriber subscriber(found, subscription);
  found->add(subscription);
  hub_->refuseAfterShutDown();
  found->tell(TopicChange::subscriber_came);
  return Inbox<T>(std::move(subscriber), subscription);
}

// --- services

template <class Request, class Response, class Handler>
Subscriber Messenger::serve(const std::string& service, const SubscribeOptions& options,
                            Handler handler) const {
  using Call = detail::ServiceCall<Request, Response>;
  if (detail::isEmpty(handler, 0)) throw ArgumentError("handler", "is empty, expected a function");
  const std::shared_ptr<detail::Topic> found =
      hub_->service(resolved(service), detail::PayloadType::of<Call>());
  const std::shared_ptr<detail::Subscription> subscription =
      makeSubscription<detail::TypedPayload<Call>>(
          options, found->name(),
          detail::CallAnswerer<Request, Response, Handler>(std::move(handler)));
  Subscriber server(found, subscription);
  if (!found->addOnly(subscription))
    throw ArgumentError("service", "is \"" + found->name() + "\", which is served already");
  hub_->refuseAfterShutDown();
  return server;
}

template <class Request, class Response, class Rep, class Period>
Response Messenger::call(const std::string& service, Request request,
                         const std::chrono::duration<Rep, Period>& timeout) const {
  using Call = detail::ServiceCall<Request, Response>;
  const std::shared_ptr<detail::Topic> found =
      hub_->service(resolved(service), detail::PayloadType::of<Call>());
  if (found->subscriptions().empty()) throw ServiceError(found->name(), ServiceError::unavailable);
  const auto answer = [&] {
    const auto call = std::make_shared<const Call>(found->name(), std::move(request));
    detail::Letter<Call> letter(call);
    found->deliver(letter);
    return call->answer();
  }();  // where nobody took the call, its end has told so
  return answer->waitFor(found->name(), timeout);
}

inline bool Messenger::hasService(const std::string& service) const {
  return hub_->isServed(resolved(service));
}

// --- telling

inline std::vector<TopicInfo> Messenger::topics() const {
  std::vector<TopicInfo> infos;
  for (const std::shared_ptr<detail::Topic>& one : hub_->topics()) {
    const detail::Topic& topic = *one;
    TopicInfo info;
    info.name = topic.name();
    info.type = topic.type().name();
    info.type_size = topic.type().size;
    info.publishers = topic.publisher_count;
    info.messages = topic.messageCount();
    info.bytes = topic.type().is_flat ? info.messages * info.type_size : 0;
    info.is_latched = topic.isLatched();
    info.at = std::chrono::steady_clock::now();
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
