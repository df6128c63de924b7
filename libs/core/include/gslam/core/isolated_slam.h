#ifndef GSLAM_CORE_ISOLATED_SLAM_H
#define GSLAM_CORE_ISOLATED_SLAM_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>
#include <gslam/core/detail/isolation_channel.h>
#include <gslam/core/detail/shared_frames.h>
#include <gslam/core/registry.h>
#include <gslam/core/slam.h>
#include <gslam/messenger/publisher.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// @file
/// A SLAM system in a process of its own: when it crashes or hangs, the program goes on.
///
///     int main(int argc, char** argv) {
///       if (gslam::isIsolationWorker(argc, argv)) return gslam::runIsolationWorker(argc, argv);
///       gslam::IsolationOptions options;
///       options.slam = "orb";
///       gslam::IsolatedSlam slam(options);  // used as any other gslam::Slam
///       try {
///         slam.feed(frame);
///       } catch (const gslam::IsolationError& error) {
///         std::cerr << error.what();  // "... was ended by signal 11 (SIGSEGV) in feed() of frame
///         7"
///       }
///     }
///
/// The first line of main() is from gslam/core/isolation_worker.h.

namespace gslam {
inline namespace v1 {

/// How to run a SLAM system in a process of its own. A limit of 0 is none.
struct IsolationOptions {
  std::string slam;                  ///< whatever Plugins::slam() takes
  std::vector<std::string> folders;  ///< where plugins are; empty: defaultPluginFolders()
  /// The program that is started: its main() begins as above. Empty: the running program.
  std::string worker;
  std::chrono::milliseconds start_limit{10000};       ///< until the program has begun
  std::chrono::milliseconds configure_limit{120000};  ///< of loading the plugin, of configure()
  std::chrono::milliseconds feed_limit{30000};        ///< of each feed()
  std::chrono::milliseconds map_limit{60000};         ///< of each map()
  std::chrono::milliseconds finish_limit{600000};     ///< of finish()
  std::chrono::milliseconds end_limit{5000};  ///< of the destructor; then the process is killed
  std::uint64_t most_memory = 0;  ///< bytes of addresses the process may have; 0: no limit
};

/// How an isolated SLAM system came to its end.
struct IsolationFailure {
  /// What it was.
  enum class Kind {
    signal,         ///< it was ended by the signal `number`
    exit,           ///< it called exit() with the status `number`
    timeout,        ///< it gave no answer in time, and was killed
    out_of_memory,  ///< it was killed, while the system ran out of memory
    garbage,        ///< it sent what is no answer, and was killed
    lost            ///< its end of the connection is closed, and how it ended is not known
  };
  Kind kind = Kind::lost;              ///< what it was
  int number = 0;                      ///< signal or status
  std::string signal_name;             ///< such as "SIGSEGV"; empty: no signal
  std::string call;                    ///< such as "feed"; empty: between two calls
  bool has_frame = false;              ///< whether a frame was fed
  std::uint64_t last_frame = 0;        ///< Frame::id of the last one that was fed
  std::chrono::milliseconds limit{0};  ///< of a timeout
};

/// For people, as the end of a sentence: "was ended by signal 11 (SIGSEGV) in feed() of frame 7".
inline std::string toText(const IsolationFailure& failure);

/// An isolated SLAM system came to its end. What it threw itself is thrown as Error, ArgumentError,
/// FileError or ParseError, as if it were not isolated.
class GSLAM_PUBLIC IsolationError : public Error {
 public:
  /// @param slam     its name
  /// @param failure  what happened
  /// @param hint     another sentence, or nothing
  IsolationError(const std::string& slam, const IsolationFailure& failure,
                 const std::string& hint = "")
      : Error("the isolated SLAM system '" + slam + "' " + toText(failure) +
              (hint.empty() ? "" : "; " + hint)),
        failure_(std::make_shared<IsolationFailure>(failure)) {}
  /// What happened.
  const IsolationFailure& failure() const noexcept { return *failure_; }

 private:
  std::shared_ptr<const IsolationFailure> failure_;  // shared, so that copying never throws
};

/// A SLAM system that runs in a child process.
///
/// **Frames** go through shared memory: their pixels are copied once, and the system gets images
/// that wrap the copy, without gaps between rows. What it keeps stays as it is; the memory grows
/// with that.
///
/// **Topics**: the poses on "pose" come out of the messenger that was given to configure(), in the
/// thread of the call during which they arrive: those that the system publishes between two calls
/// come with the next. Other topics, such as "map", are not forwarded, nor do subscriptions and
/// services reach the child; ask map(). What it logs ends in this program's log, at the level that
/// held at configure(); what it prints goes to stderr; its stdin is empty.
///
/// **Failure**: where the process ends or is late, the call throws an IsolationError, and so do all
/// later calls. The process and all that it started are gone then; it leaves nothing behind, and
/// it ends with this object or this process at the latest. What is wrong in the destructor is
/// logged.
///
/// **Parameters** must have a JSON form: no functions, native objects, NaN or binaries.
///
/// **Threads**: as any Slam. It may be made in any thread; the process is spawned, not forked.
///
/// Linux only: elsewhere the constructor throws.
class IsolatedSlam : public Slam {
 public:
  /// Starts the process and makes the SLAM system there.
  /// @throws FileError when the program cannot be started; Error when it is no worker, this system
  ///   cannot isolate, or this process is a worker itself; what loading and making it throws;
  ///   IsolationError
  explicit IsolatedSlam(const IsolationOptions& options);
  IsolatedSlam(const IsolatedSlam&) = delete;
  IsolatedSlam& operator=(const IsolatedSlam&) = delete;
  ~IsolatedSlam() override;

  /// As Slam. @throws also IsolationError, and SvarError for parameters without a JSON form
  void configure(const SlamSetup& setup) override;
  /// As Slam. @throws also IsolationError
  void feed(const std::shared_ptr<const Frame>& frame) override;
  /// As Slam: a copy of it. @throws also IsolationError
  std::shared_ptr<const Map> map() override;
  /// As Slam. @throws also IsolationError
  void finish() override;

  /// What the child knows of the system: name, description, parameters, needs. Its plugin is not
  /// loaded in this process. `make` makes another isolated one.
  const SlamFactory& factory() const noexcept { return factory_; }
  /// How it came to its end; null while it runs.
  const IsolationFailure* failure() const noexcept { return failure_.get(); }
  /// Number of the process; 0 where there is none any more.
  long processNumber() const noexcept;
  /// Bytes of the shared memory.
  std::uint64_t sharedBytes() const noexcept;

 private:
#if GSLAM_DETAIL_HAS_ISOLATION
  void start();
  void greet();
  std::vector<char> call(detail::MessageKind kind, const detail::MessageWriter& question,
                         std::chrono::milliseconds limit, const char* name,
                         const Frame* frame = nullptr);
  std::vector<char> answer(detail::Deadline deadline, std::chrono::milliseconds limit,
                           const char* name);
  bool handle(const detail::Message& message, detail::ThrownMessage& thrown);
  [[noreturn]] void fail(IsolationFailure::Kind kind, std::chrono::milliseconds limit,
                         const char* name);
  void judge(IsolationFailure& failure, const detail::ChildEnd& end) const;
  void endQuietly() noexcept;

  detail::FrameWriter frames_;
  detail::FileHandle socket_;
  detail::ChildProcess child_;
  std::uint64_t killed_before_ = 0;  // of the whole system, for lack of memory
#endif
  IsolationOptions options_;
  SlamFactory factory_;
  Publisher<TrackedPose> pose_;
  bool has_pose_ = false;
  bool has_frame_ = false;
  std::uint64_t last_frame_ = 0;
  std::unique_ptr<IsolationFailure> failure_;
};

/// A factory whose SLAM systems run isolated.
/// @param like     its name, description, parameters and needs are taken over
/// @param options  where `slam` is empty, the name of `like` is taken
inline SlamFactory isolatedFactory(const SlamFactory& like, IsolationOptions options) {
  if (options.slam.empty()) options.slam = like.name;
  SlamFactory factory = like;
  factory.make = [options] { return std::unique_ptr<Slam>(new IsolatedSlam(options)); };
  return factory;
}

}  // namespace v1
}  // namespace gslam

#include <gslam/core/detail/isolated_slam_impl.h>

#endif  // GSLAM_CORE_ISOLATED_SLAM_H
