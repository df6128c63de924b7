#include <boost/signals2.hpp>

#include "publish.h"

namespace {

template <class T>
class BoostSignals2 {
 public:
  void subscribe(std::size_t& received) {
    signal_.connect([&received](const Message<T>&) { ++received; });
  }
  void publish(const Message<T>& message) { signal_(message); }

 private:
  boost::signals2::signal<void(const Message<T>&)> signal_;
};

PEER(BoostSignals2, "boost_signals2");

}  // namespace
