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

/// By the name of the topic each time.
template <class T>
class ByName {
 public:
  void subscribe(std::size_t& received) {
    subscribers_.push_back(
        messenger_.subscribe<T>("/t", [&received](const Message<T>&) { ++received; }));
  }
  void publish(const Message<T>& message) { messenger_.publish<T>("/t", message); }

 private:
  gslam::Messenger messenger_;
  std::vector<gslam::Subscriber> subscribers_;
};

BENCHMARK_TEMPLATE(publish, ByName, int)->Name("publish_by_name/gslam")->Arg(1);
BENCHMARK_TEMPLATE(publish, ByName, Megabyte)->Name("publish_megabyte_by_name/gslam")->Arg(16);

}  // namespace
