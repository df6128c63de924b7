#include <gslam/messenger.h>

#include <vector>

#include "queue.h"

namespace {

/// @tparam Options  gives the gslam::SubscribeOptions
template <class Options>
class Gslam {
 public:
  Gslam(std::size_t subscribers, std::size_t capacity, Handled& handled) {
    const gslam::SubscribeOptions options =
        capacity == 0 ? Options::get() : Options::get().blockPublisher(capacity);
    for (std::size_t i = 0; i < subscribers; ++i) {
      subscribers_.push_back(messenger_.subscribe<int>(
          "n", options.drainAtEnd(),
          [&handled](const QueuedMessage& message) { handled.add(message); }));
    }
  }
  void push(const QueuedMessage& message) { publisher_.publish(message); }

 private:
  gslam::Messenger messenger_;
  gslam::Publisher<int> publisher_ = messenger_.advertise<int>("n");
  std::vector<gslam::Subscriber> subscribers_;
};

struct OwnThread {
  static gslam::SubscribeOptions get() { return gslam::inOwnThread(); }
};
struct Spinning {
  static gslam::SubscribeOptions get() {
    return gslam::inOwnThread().spinFor(std::chrono::milliseconds(1));
  }
};

BURST_PEER(Gslam<OwnThread>, "gslam");
ONE_BY_ONE_PEER(Gslam<OwnThread>, "gslam");
ONE_BY_ONE_PEER(Gslam<Spinning>, "gslam_spinning");
PUBLISHERS_PEER(Gslam<OwnThread>, "gslam");

}  // namespace
