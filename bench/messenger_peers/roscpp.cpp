// ROS 1 inside one process. Its nodes register with a master; the one here says yes to all, so that
// none has to run. Where roscpp does not start, the benchmark says so.
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/Int32.h>
#include <std_msgs/UInt8MultiArray.h>
#include <xmlrpcpp/XmlRpc.h>

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "publish.h"

namespace {

class MasterMethod : public XmlRpc::XmlRpcServerMethod {
 public:
  MasterMethod(const std::string& name, int status, XmlRpc::XmlRpcServer& server)
      : XmlRpcServerMethod(name, &server), status_(status) {}
  void execute(XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& result) override {
    result.setSize(3);
    result[0] = status_;
    result[1] = std::string();
    result[2].setSize(0);  // nobody else is there
  }

 private:
  int status_;
};

class Master {
 public:
  Master() {
    for (const char* name : {"registerPublisher", "unregisterPublisher", "registerSubscriber",
                             "unregisterSubscriber", "registerService", "unregisterService"}) {
      methods_.emplace_back(new MasterMethod(name, 1, server_));
    }
    for (const char* name : {"getParam", "hasParam", "subscribeParam", "searchParam"}) {
      methods_.emplace_back(new MasterMethod(name, -1, server_));  // there are no parameters
    }
    if (!server_.bindAndListen(0)) return;
    port_ = server_.get_port();
    std::thread([this] { server_.work(-1.0); }).detach();  // as long as the program
  }
  int port() const { return port_; }

 private:
  XmlRpc::XmlRpcServer server_;
  std::vector<std::unique_ptr<MasterMethod>> methods_;
  int port_ = 0;
};

// The node of this program; null where there can be none.
ros::NodeHandle* node() {
  static ros::NodeHandle* const made = []() -> ros::NodeHandle* {
    static Master* const master = new Master;
    if (master->port() == 0) return nullptr;
    const ros::M_string where = {{"__master", "http://127.0.0.1:" + std::to_string(master->port())},
                                 {"__ip", "127.0.0.1"}};
    ros::init(where, "messenger_peers",
              ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
    auto* const node = new ros::NodeHandle;
    return ros::ok() ? node : nullptr;
  }();
  return made;
}

template <class T>
struct RosMessage;
template <>
struct RosMessage<int> {
  using Type = std_msgs::Int32;
  static void fill(Type&) {}
};
template <>
struct RosMessage<Megabyte> {
  using Type = std_msgs::UInt8MultiArray;
  static void fill(Type& message) { message.data.resize(sizeof(Megabyte)); }
};

std::string nextTopic() {
  static int count = 0;
  return "t" + std::to_string(count++);
}

// Callbacks are called in the same thread, right after publishing.
template <class T>
class Roscpp {
  using Type = typename RosMessage<T>::Type;

 public:
  Roscpp() {
    Type* const filled = new Type;
    RosMessage<T>::fill(*filled);
    message_.reset(filled);
    if (node() == nullptr) return;
    node()->setCallbackQueue(&callbacks_);
    publisher_ = node()->advertise<Type>(topic_, 10);
  }
  ~Roscpp() {
    if (node() != nullptr) node()->setCallbackQueue(nullptr);
  }
  void subscribe(std::size_t& received) {
    if (node() == nullptr) return;
    const boost::function<void(const boost::shared_ptr<const Type>&)> count =
        [&received](const boost::shared_ptr<const Type>&) { ++received; };
    subscribers_.push_back(node()->subscribe<Type>(topic_, 10, count));
  }
  void publish(const Message<T>&) {
    publisher_.publish(message_);
    callbacks_.callAvailable();
  }

 private:
  const std::string topic_ = nextTopic();
  ros::CallbackQueue callbacks_;
  boost::shared_ptr<const Type> message_;
  ros::Publisher publisher_;
  std::vector<ros::Subscriber> subscribers_;
};

PEER(Roscpp, "roscpp");

}  // namespace
