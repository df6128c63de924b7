// Definitions of what isolated_slam.h declares.
#ifndef GSLAM_CORE_DETAIL_ISOLATED_SLAM_IMPL_H
#define GSLAM_CORE_DETAIL_ISOLATED_SLAM_IMPL_H

#include <gslam/base/log_hook.h>
#include <gslam/core/build_facts.h>
#include <gslam/core/detail/isolation_channel.h>
#include <gslam/core/detail/map_transport.h>
#include <gslam/core/detail/shared_library.h>
#include <gslam/core/isolated_slam.h>
#include <gslam/svar/json.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {

inline std::string toText(const IsolationFailure& failure) {
  const std::string number = std::to_string(failure.number);
  std::string text;
  switch (failure.kind) {
    case IsolationFailure::Kind::signal:
      text = "was ended by signal " + number + " (" + failure.signal_name + ")";
      break;
    case IsolationFailure::Kind::exit:
      text = "ended its process with status " + number;
      break;
    case IsolationFailure::Kind::timeout:
      text = "gave no answer within " + std::to_string(failure.limit.count()) + " ms";
      break;
    case IsolationFailure::Kind::out_of_memory:
      text = "was killed for lack of memory";
      break;
    case IsolationFailure::Kind::garbage:
      text = "sent what is no answer";
      break;
    case IsolationFailure::Kind::lost:
      text = "is gone, its process was reaped by somebody else";
      break;
  }
  text += failure.call.empty() ? " between two calls" : " in " + failure.call + "()";
  if (!failure.has_frame) return text;
  const std::string frame = "frame " + std::to_string(failure.last_frame);
  return text + (failure.call == "feed" ? " of " : " after ") + frame;
}

#if GSLAM_DETAIL_HAS_ISOLATION

namespace detail {

constexpr const char* kWorkerVariable = "GSLAM_ISOLATION_WORKER";
constexpr const char* kWorkerArgument = "--gslam-isolation-worker";

// Names of source files live as long as the program, as those of LogRecord::file do. A child that
// invents names gets no more than that.
inline const char* keptFileName(const std::string& name) {
  static std::mutex* const mutex = new std::mutex;
  static std::set<std::string>* const names = new std::set<std::string>;
  const std::lock_guard<std::mutex> lock(*mutex);
  if (names->size() >= 1000 && names->count(name) == 0) return "isolated";
  return names->insert(name).first->c_str();
}

inline void logFromChild(MessageReader& in) {
  const std::uint32_t level = in.number<std::uint32_t>();
  const std::int32_t line = in.number<std::int32_t>();
  const std::string file = in.text();
  std::string text = in.text();
  in.expectEnd();
  if (level > static_cast<std::uint32_t>(LogLevel::error)) throw Error("there is no such level");
  log({static_cast<LogLevel>(level), keptFileName(file), line, std::move(text)});
}

}  // namespace detail

inline IsolatedSlam::IsolatedSlam(const IsolationOptions& options) : options_(options) {
  if (std::getenv(detail::kWorkerVariable) != nullptr) {
    throw Error("this process is an isolation worker already, which cannot isolate in turn");
  }
  if (options_.slam.empty()) throw ArgumentError("slam", "is empty, expected a name or path");
  if (options_.worker.empty()) options_.worker = detail::programPath();
  if (options_.worker.empty()) throw Error("the path of this program is not known: say which");
  start();
  greet();
}

inline void IsolatedSlam::start() {
  std::pair<detail::FileHandle, detail::FileHandle> ends = detail::socketPair();
  socket_ = std::move(ends.first);
  killed_before_ = detail::outOfMemoryCount();
  child_.start(options_.worker, ends.second, frames_.memory(),
               {options_.worker, detail::kWorkerArgument},
               std::string(detail::kWorkerVariable) + "=1");
}

// The child tells how it was built, and is told what to make.
inline void IsolatedSlam::greet() {
  std::vector<char> bytes;
  try {
    bytes = answer(detail::deadlineAfter(options_.start_limit), options_.start_limit, "start");
  } catch (const IsolationError& error) {
    throw IsolationError(options_.slam, error.failure(),
                         "does main() of " + options_.worker + " begin with isIsolationWorker()?");
  }
  BuildFacts built = thisBuild();
  std::string problem;
  try {
    detail::MessageReader in(bytes);
    if (in.number<std::uint32_t>() != detail::kIsolationProtocol) problem = "has another protocol";
    if (problem.empty()) in.raw(built);
  } catch (const Error&) {
    problem = "has another protocol";
  }
  built.sanitizer = thisBuild().sanitizer;  // the two only talk
  if (problem.empty()) problem = detail::buildProblem(built, thisBuild());
  if (!problem.empty()) throw FileError(options_.worker, problem);

  detail::MessageWriter question;
  question.text(options_.slam);
  question.raw(std::uint64_t(options_.folders.size()));
  for (const std::string& folder : options_.folders) question.text(folder);
  question.raw(options_.most_memory);
  question.raw(std::int32_t(detail::logState().least.load(std::memory_order_relaxed)));
  const std::vector<char> made =
      call(detail::MessageKind::create, question, options_.configure_limit, "make");
  try {
    detail::MessageReader in(made);
    factory_ = detail::readFactory(in);
  } catch (const Error&) {  // it is no such answer
    fail(IsolationFailure::Kind::garbage, options_.configure_limit, "make");
  }
  const IsolationOptions options = options_;
  factory_.make = [options] { return std::unique_ptr<Slam>(new IsolatedSlam(options)); };
}

inline IsolatedSlam::~IsolatedSlam() {
  endQuietly();
}

inline void IsolatedSlam::endQuietly() noexcept {
  if (failure_ || child_.id() <= 0) return;
  try {
    const detail::Deadline deadline = detail::deadlineAfter(options_.end_limit);
    sendMessage(socket_.get(), detail::MessageKind::quit, {}, &child_, deadline);
    detail::Message last;  // what it says on its way out
    while (receiveMessage(socket_.get(), last, &child_, deadline) == detail::Received::done) {
      detail::MessageReader in(last.bytes);
      if (last.kind == detail::MessageKind::log) detail::logFromChild(in);
    }
    IsolationFailure failure;
    failure.call = "end";
    failure.has_frame = has_frame_;
    failure.last_frame = last_frame_;
    const bool is_late = !child_.waitUntil(deadline);
    judge(failure, child_.end());
    if (is_late) failure.kind = IsolationFailure::Kind::timeout;
    failure.limit = options_.end_limit;
    if (failure.kind == IsolationFailure::Kind::exit && failure.number == 0) return;
    const std::string text = IsolationError(options_.slam, failure).what();
    detail::logParts(LogLevel::warning, __FILE__, __LINE__, {text.c_str()});
  } catch (...) {  // NOLINT(bugprone-empty-catch): the process is ended by its own destructor
  }
}

inline void IsolatedSlam::configure(const SlamSetup& setup) {
  detail::MessageWriter question;
  question.text(printJson(setup.parameters));
  detail::writeSensors(question, setup.sensors);
  question.raw(std::int32_t(detail::logState().least.load(std::memory_order_relaxed)));
  pose_ = setup.messenger.advertise<TrackedPose>("pose");
  has_pose_ = true;
  call(detail::MessageKind::configure, question, options_.configure_limit, "configure");
}

inline void IsolatedSlam::feed(const std::shared_ptr<const Frame>& frame) {
  if (!frame) throw ArgumentError("frame", "is null, expected one to feed");
  if (failure_) throw IsolationError(options_.slam, *failure_);
  std::vector<detail::SharedImage> images;
  const detail::SharedSlot slot = frames_.write(*frame, images);
  detail::MessageWriter question;
  try {
    detail::writeFrame(question, *frame, slot, images);
  } catch (...) {
    frames_.release(slot);
    throw;
  }
  call(detail::MessageKind::feed, question, options_.feed_limit, "feed", frame.get());
}

inline std::shared_ptr<const Map> IsolatedSlam::map() {
  const std::vector<char> bytes =
      call(detail::MessageKind::map, detail::MessageWriter(), options_.map_limit, "map");
  // The first byte says whether there is one.
  if (bytes.empty() || bytes[0] == 0) return nullptr;
  return detail::mapOfBytes(reinterpret_cast<const std::uint8_t*>(bytes.data()) + 1,
                            bytes.size() - 1);
}

inline void IsolatedSlam::finish() {
  call(detail::MessageKind::finish, detail::MessageWriter(), options_.finish_limit, "finish");
}

inline long IsolatedSlam::processNumber() const noexcept {
  return child_.id() > 0 ? child_.id() : 0;
}
inline std::uint64_t IsolatedSlam::sharedBytes() const noexcept {
  return frames_.size();
}

inline std::vector<char> IsolatedSlam::call(detail::MessageKind kind,
                                            const detail::MessageWriter& question,
                                            std::chrono::milliseconds limit, const char* name,
                                            const Frame* frame) {
  if (failure_) throw IsolationError(options_.slam, *failure_);
  if (child_.hasEnded()) fail(IsolationFailure::Kind::lost, limit, "");
  if (frame != nullptr) {
    has_frame_ = true;
    last_frame_ = frame->id;
  }
  const detail::Deadline deadline = detail::deadlineAfter(limit);
  switch (sendMessage(socket_.get(), kind, question.bytes(), &child_, deadline)) {
    case detail::Transfer::done:
      break;
    case detail::Transfer::late:
      fail(IsolationFailure::Kind::timeout, limit, name);
    case detail::Transfer::closed:
      fail(IsolationFailure::Kind::lost, limit, name);
  }
  return answer(deadline, limit, name);
}

// What the child says until it is done.
inline std::vector<char> IsolatedSlam::answer(detail::Deadline deadline,
                                              std::chrono::milliseconds limit, const char* name) {
  for (;;) {
    detail::Message message;
    switch (receiveMessage(socket_.get(), message, &child_, deadline)) {
      case detail::Received::done:
        break;
      case detail::Received::late:
        fail(IsolationFailure::Kind::timeout, limit, name);
      case detail::Received::closed:
        fail(IsolationFailure::Kind::lost, limit, name);
      case detail::Received::broken:
        fail(IsolationFailure::Kind::garbage, limit, name);
    }
    if (message.kind == detail::MessageKind::done) return std::move(message.bytes);
    detail::ThrownMessage thrown;
    bool is_thrown = false;
    try {
      is_thrown = handle(message, thrown);
    } catch (const Error&) {  // it is no such message
      fail(IsolationFailure::Kind::garbage, limit, name);
    }
    if (is_thrown) detail::rethrow(thrown);
    if (std::chrono::steady_clock::now() >= deadline) {
      fail(IsolationFailure::Kind::timeout, limit, name);
    }
  }
}

// Handles what comes before the end; true when it is an exception.
inline bool IsolatedSlam::handle(const detail::Message& message, detail::ThrownMessage& thrown) {
  detail::MessageReader in(message.bytes);
  switch (message.kind) {
    case detail::MessageKind::thrown:
      thrown = detail::readThrown(in);
      return true;
    case detail::MessageKind::pose: {
      const TrackedPose pose = detail::readPose(in);
      if (has_pose_) pose_.publish(pose);
      return false;
    }
    case detail::MessageKind::log:
      detail::logFromChild(in);
      return false;
    default:
      throw Error("a message that no child sends");
  }
}

// Ends what is left of the child and throws.
inline void IsolatedSlam::fail(IsolationFailure::Kind kind, std::chrono::milliseconds limit,
                               const char* name) {
  std::unique_ptr<IsolationFailure> failure(new IsolationFailure);
  failure->call = name;
  failure->has_frame = has_frame_;
  failure->last_frame = last_frame_;
  // One that closed the socket is on its way: how it ends is what matters.
  const bool is_ours = kind != IsolationFailure::Kind::lost ||
                       !child_.waitUntil(detail::deadlineAfter(std::chrono::milliseconds(2000)));
  judge(*failure, child_.end());
  if (is_ours) failure->kind = kind;
  if (failure->kind == IsolationFailure::Kind::timeout) failure->limit = limit;
  socket_.close();
  failure_ = std::move(failure);
  throw IsolationError(options_.slam, *failure_);
}

inline void IsolatedSlam::judge(IsolationFailure& failure, const detail::ChildEnd& end) const {
  failure.number = end.number;
  if (end.what == detail::ChildEnd::exited) failure.kind = IsolationFailure::Kind::exit;
  if (end.what != detail::ChildEnd::killed) return;
  failure.kind = IsolationFailure::Kind::signal;
  failure.signal_name = detail::signalName(end.number);
  if (detail::isKillSignal(end.number) && detail::outOfMemoryCount() > killed_before_) {
    failure.kind = IsolationFailure::Kind::out_of_memory;
  }
}

#else

inline IsolatedSlam::IsolatedSlam(const IsolationOptions&) {
  throw Error("this system cannot isolate a SLAM system: that needs Linux (memfd_create)");
}
inline IsolatedSlam::~IsolatedSlam() = default;
inline void IsolatedSlam::configure(const SlamSetup&) {}
inline void IsolatedSlam::feed(const std::shared_ptr<const Frame>&) {}
inline std::shared_ptr<const Map> IsolatedSlam::map() {
  return nullptr;
}
inline void IsolatedSlam::finish() {}
inline long IsolatedSlam::processNumber() const noexcept {
  return 0;
}
inline std::uint64_t IsolatedSlam::sharedBytes() const noexcept {
  return 0;
}

#endif  // GSLAM_DETAIL_HAS_ISOLATION

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_ISOLATED_SLAM_IMPL_H
