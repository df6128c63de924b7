// Instantiates the templates of GSLAM::messenger; compiled alone under every compiler and standard
// by tests/headers.
#include <gslam/messenger.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

struct Dated {
  std::int64_t stamp;
};

template class gslam::Publisher<int>;
template class gslam::Inbox<std::string>;
template class gslam::Synchronizer<Dated, Dated>;

struct View {
  void show(const int&) {}
};

int instantiateMessenger(const gslam::Messenger& messenger);

int instantiateMessenger(const gslam::Messenger& messenger) {
  View view;
  messenger.subscribe<int>("/n", [](const std::shared_ptr<const int>&) {}).keep();
  messenger.subscribe<int>("/n", gslam::inOwnThread().keepLast(1), [](int) {}).keep();
  messenger.subscribe<int>("/n", &View::show, &view).unsubscribe();
  messenger.subscribeAny("/**", [](const gslam::AnyMessage&) {}).keep();
  messenger.advertise<int>("/n").publish(1);
  messenger.publish<int>("/n", 2);
  messenger.serve<int, std::string>("/s", [](const int& n) { return std::to_string(n); }).keep();
  const auto nothing = [](const Dated&, const Dated&) {};
  gslam::Synchronizer<Dated, Dated>(messenger, {"/a", "/b"}, gslam::exactTime(), 1, nothing)
      .unsubscribe();
  gslam::Synchronizer<Dated, Dated>(messenger, {"/a", "/b"}, gslam::approximateTime(), 1, nothing)
      .unsubscribe();
  const std::string answer =
      messenger.call<int, std::string>("/s", 3, std::chrono::milliseconds(10));
  return static_cast<int>(answer.size() + messenger.topics().size());
}
