// Instantiates the templates of GSLAM::messenger; compiled alone under every compiler and standard
// by tests/headers.
#include <gslam/messenger.h>

#include <cstdint>

struct Stamped {
  std::int64_t stamp;
};

template class gslam::Publisher<int>;
template class gslam::Synchronizer<Stamped, Stamped>;

void instantiateMessenger(const gslam::Messenger& messenger);

void instantiateMessenger(const gslam::Messenger& messenger) {
  messenger.subscribe<int>("/n", [](const std::shared_ptr<const int>&) {}).keep();
  messenger.advertise<int>("/n").publish(1);
  const auto nothing = [](const Stamped&, const Stamped&) {};
  gslam::Synchronizer<Stamped, Stamped>(messenger, {"/a", "/b"}, gslam::exactTime(), 1, nothing)
      .unsubscribe();
  gslam::Synchronizer<Stamped, Stamped>(messenger, {"/a", "/b"}, gslam::approximateTime(), 1,
                                        nothing)
      .unsubscribe();
}
