#ifndef GSLAM_CORE_ISOLATION_WORKER_H
#define GSLAM_CORE_ISOLATION_WORKER_H

#include <gslam/base/error.h>
#include <gslam/base/log_hook.h>
#include <gslam/core/detail/isolation_channel.h>
#include <gslam/core/detail/map_transport.h>
#include <gslam/core/detail/shared_frames.h>
#include <gslam/core/isolated_slam.h>
#include <gslam/core/plugins.h>
#include <gslam/messenger/messenger.h>
#include <gslam/svar/json.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

/// @file
/// The child's side of IsolatedSlam: the first line of main().

namespace gslam {
inline namespace v1 {

/// What a worker does with its plugins before it looks for the SLAM system, such as adding those
/// that are part of the program.
using PreparePlugins = std::function<void(Plugins&)>;

/// Whether this process was started by IsolatedSlam. To be asked before anything else is done.
inline bool isIsolationWorker(int argc, const char* const* argv) noexcept;

/// Runs the SLAM system for the host until that has no more need of it.
/// @param argc, argv  of main()
/// @param prepare  called once, before the SLAM system is looked for; empty: nothing to do
/// @return the status of the process
inline int runIsolationWorker(int argc, const char* const* argv,
                              const PreparePlugins& prepare = PreparePlugins());

#if GSLAM_DETAIL_HAS_ISOLATION

namespace detail {

// Ends this process and, where it leads a group as IsolatedSlam has it, all that it started.
[[noreturn]] inline void endAll() {
  if (getpgrp() == getpid()) kill(0, SIGKILL);
  std::_Exit(1);
}

// Ends the process when the host is gone, even where the SLAM system hangs. (The parent-death
// signal of Linux would not do: it comes when the thread ends that started this process.)
class HangUpWatch {
 public:
  explicit HangUpWatch(int socket) {
    std::pair<FileHandle, FileHandle> ends = socketPair();
    stop_ = std::move(ends.first);
    const int stop = ends.second.get();
    stopped_ = std::move(ends.second);
    thread_ = std::thread([socket, stop] {
      if (waitForHangUp(socket, stop)) endAll();
    });
  }
  HangUpWatch(const HangUpWatch&) = delete;
  HangUpWatch& operator=(const HangUpWatch&) = delete;
  ~HangUpWatch() {
    stop_.close();
    thread_.join();
  }

 private:
  FileHandle stop_, stopped_;
  std::thread thread_;
};

class IsolationWorker {
 public:
  IsolationWorker(int socket, int memory, PreparePlugins prepare)
      : socket_(socket), frames_(memory), prepare_(std::move(prepare)) {}
  IsolationWorker(const IsolationWorker&) = delete;
  IsolationWorker& operator=(const IsolationWorker&) = delete;

  int run() {
    MessageWriter hello;
    hello.raw(kIsolationProtocol);
    hello.raw(thisBuild());
    send(MessageKind::done, hello.bytes());
    Message question;
    while (receiveMessage(socket_, question, nullptr, Deadline::max()) == Received::done &&
           question.kind != MessageKind::quit) {
      answer(question);
    }
    slam_.reset();
    setLogSink(LogSink());
    return 0;
  }

 private:
  void answer(const Message& question) {
    MessageWriter out;
    MessageKind kind = MessageKind::done;
    std::vector<char> bytes;
    try {
      MessageReader in(question.bytes);
      bytes = handle(question.kind, in);
    } catch (...) {
      kind = MessageKind::thrown;
      writeThrown(out, currentException());
      bytes = out.bytes();
    }
    send(kind, bytes);
  }

  std::vector<char> handle(MessageKind kind, MessageReader& in) {
    if (kind == MessageKind::create) return create(in);
    if (!slam_) throw Error("there is no SLAM system: making it failed");
    if (kind == MessageKind::configure) {
      configure(in);
    } else if (kind == MessageKind::feed) {
      feed(in);
    } else if (kind == MessageKind::map) {
      return mapBytes();
    } else if (kind == MessageKind::finish) {
      slam_->finish();
    } else {
      throw Error("the host asks for what this worker does not know");
    }
    return {};
  }

  // Gives back what the host is to know of the system, whose plugin it does not load itself.
  std::vector<char> create(MessageReader& in) {
    const std::string slam = in.text();
    std::vector<std::string> folders(in.count(sizeof(std::uint64_t)));
    for (std::string& folder : folders) folder = in.text();
    limitMemory(in.number<std::uint64_t>());
    connectLog(in.number<std::int32_t>());
    if (folders.empty()) folders = defaultPluginFolders();
    plugins_.reset(new Plugins(folders));
    if (prepare_) prepare_(*plugins_);
    const SlamFactory factory = plugins_->slam(slam);
    slam_ = makeSlam(factory);
    MessageWriter out;
    writeFactory(out, factory);
    return out.bytes();
  }

  void configure(MessageReader& in) {
    SlamSetup setup;
    setup.parameters = parseJson(in.text(), "parameters");
    setup.sensors = readSensors(in);
    connectLog(in.number<std::int32_t>());
    plugins_->connectLogs();
    setup.messenger = messenger_;
    pose_ = messenger_.subscribe<TrackedPose>("pose", [this](const TrackedPose& pose) {
      MessageWriter out;
      writePose(out, pose);
      send(MessageKind::pose, out.bytes());
    });
    slam_->configure(setup);
  }

  void feed(MessageReader& in) {
    const std::shared_ptr<Frame> frame = std::make_shared<Frame>();
    readFrame(in, *frame,
              [this](const SharedSlot& slot, const std::vector<SharedImage>& images, Frame& read) {
                frames_.attach(slot, images, read);
              });
    slam_->feed(frame);
  }

  std::vector<char> mapBytes() {
    const std::shared_ptr<const Map> map = slam_->map();
    std::vector<char> bytes(1, map ? 1 : 0);
    if (!map) return bytes;
    const std::vector<std::uint8_t> content = bytesOfMap(*map);
    bytes.insert(bytes.end(), content.begin(), content.end());
    return bytes;
  }

  void connectLog(int least) {
    if (least >= kLogOff || least < 0) return setLogSink(LogSink());
    setLogSink(
        [this](const LogRecord& record) {
          MessageWriter out;
          out.raw(static_cast<std::uint32_t>(record.level));
          out.raw(std::int32_t(record.line));
          out.text(record.file);
          out.text(record.message);
          send(MessageKind::log, out.bytes());
        },
        static_cast<LogLevel>(least));
  }

  // From whatever thread. Where the host is gone there is nobody to tell.
  void send(MessageKind kind, const std::vector<char>& bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    sendMessage(socket_, kind, bytes, nullptr, Deadline::max());
  }

  int socket_;
  std::mutex mutex_;  // one message at a time
  FrameReader frames_;
  PreparePlugins prepare_;
  Messenger messenger_;
  std::unique_ptr<Plugins> plugins_;
  std::unique_ptr<Slam> slam_;
  Subscriber pose_;
};

}  // namespace detail

inline bool isIsolationWorker(int argc, const char* const* argv) noexcept {
  return argc == 2 && std::strcmp(argv[1], detail::kWorkerArgument) == 0;
}

inline int runIsolationWorker(int argc, const char* const* argv, const PreparePlugins& prepare) {
  if (!isIsolationWorker(argc, argv) || std::getenv(detail::kWorkerVariable) == nullptr ||
      !detail::isSocket(detail::kChildSocket)) {
    return 2;  // somebody typed it
  }
  detail::keepFromPrograms(detail::kChildSocket);
  detail::keepFromPrograms(detail::kChildMemory);
  const detail::HangUpWatch watch(detail::kChildSocket);
  detail::IsolationWorker worker(detail::kChildSocket, detail::kChildMemory, prepare);
  return worker.run();
}

#else

inline bool isIsolationWorker(int, const char* const*) noexcept {
  return false;
}
inline int runIsolationWorker(int, const char* const*, const PreparePlugins&) {
  return 2;
}

#endif  // GSLAM_DETAIL_HAS_ISOLATION

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_ISOLATION_WORKER_H
