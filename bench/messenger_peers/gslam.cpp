#include <gslam/messenger.h>

#include <vector>

#include "publish.h"

namespace {

template <class T>
class Gslam {
 public:
  void subscribe(std::size_t& received) {
    subscribers_.push_back(
        messenger_.subscribe<T>("/t", [&received](const Message<T>&) { ++received; }));
  }
  void publish(const Message<T>& message) { publisher_.publish(message); }

 private:
  gslam::Messenger messenger_;
  gslam::Publisher<T> publisher_ = messenger_.advertise<T>("/t");
  std::vector<gslam::Subscriber> subscribers_;
};

PEER(Gslam, "gslam");

}  // namespace
