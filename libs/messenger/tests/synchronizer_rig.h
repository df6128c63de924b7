// A synchronizer with its publishers, which keeps what was published and what came of it.
#ifndef GSLAM_MESSENGER_TESTS_SYNCHRONIZER_RIG_H
#define GSLAM_MESSENGER_TESTS_SYNCHRONIZER_RIG_H

#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace synchronizer_rig {

struct Stamped {
  Stamped(std::int64_t its_stamp = 0,  // NOLINT(google-explicit-constructor)
          std::size_t its_place = 0)
      : stamp(its_stamp), place(its_place) {}
  std::int64_t stamp;
  std::size_t place;  // among all of its topic
};
struct Arrival {
  std::size_t topic;
  std::int64_t stamp;
};
using Stamps = std::vector<std::vector<std::int64_t>>;  // by topic
using Places = std::vector<std::size_t>;                // one of each topic
using Sets = std::vector<Places>;

template <class... Messages>
class Rig {
 public:
  template <class Policy>
  explicit Rig(const Policy& policy, std::size_t queue_size = 1000)
      : stamps(sizeof...(Messages)),
        synchronizer_(messenger_, names(), policy, queue_size,
                      [this](const std::shared_ptr<const Messages>&... message) {
                        sets.push_back({message->place...});
                        set_stamps.push_back({message->stamp...});
                      }) {
    for (const std::string& name : names()) {
      publishers_.push_back(messenger_.advertise<Stamped>(name));
    }
  }
  void publish(const Arrival& one) {
    publishers_[one.topic].publish(Stamped{one.stamp, stamps[one.topic].size()});
    stamps[one.topic].push_back(one.stamp);
  }
  gslam::Synchronizer<Messages...>& synchronizer() { return synchronizer_; }

  // Nothing is lost, and nothing counted twice.
  void expectBalance() const {
    for (std::size_t i = 0; i < sizeof...(Messages); ++i) {
      EXPECT_EQ(sets.size() + synchronizer_.dropped(i) + synchronizer_.waiting(i),
                stamps[i].size());
    }
  }

  Stamps stamps;
  Sets sets;
  Stamps set_stamps;

 private:
  static std::array<std::string, sizeof...(Messages)> names() {
    std::array<std::string, sizeof...(Messages)> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = "/t" + std::to_string(i);
    return all;
  }
  const gslam::Messenger messenger_;
  gslam::Synchronizer<Messages...> synchronizer_;
  std::vector<gslam::Publisher<Stamped>> publishers_;
};
using Two = Rig<Stamped, Stamped>;
using Three = Rig<Stamped, Stamped, Stamped>;
using Four = Rig<Stamped, Stamped, Stamped, Stamped>;

inline int draw(std::mt19937& random, int from, int to) {
  return std::uniform_int_distribution<int>(from, to)(random);
}

}  // namespace synchronizer_rig

#endif  // GSLAM_MESSENGER_TESTS_SYNCHRONIZER_RIG_H
