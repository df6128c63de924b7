#ifndef GSLAM_EVALUATION_FRAME_TIMES_H
#define GSLAM_EVALUATION_FRAME_TIMES_H

#include <gslam/core/slam.h>
#include <gslam/evaluation/export.h>
#include <gslam/evaluation/process_usage.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// @file
/// What each frame costs a SLAM system.
///
///     auto tree = std::make_shared<gslam::ProcessTree>();
///     gslam::MeasuredSlam slam(gslam::makeSlam(factory), {tree});
///     // In real time frames wait, and are dropped, before they come to the system.
///     const auto played = messenger.subscribe<gslam::Frame>(
///         "/sensor/frame", [&](const gslam::Frame& f) { slam.noteDelivered(f.id, f.stamp); });
///     gslam::runSlam(slam, player, dataset, setup, messenger);
///     const std::vector<gslam::FrameTime> frames = slam.frames();
///
/// An isolated one is measured alone:
///
///     gslam::countAllocationsOfChildren();          // first thing in main()
///     auto isolated = std::make_shared<gslam::IsolatedSlam>(options);
///     gslam::ProcessTreeOptions of_child;
///     of_child.root = isolated->processNumber();
///     gslam::MeasuredSlam slam(isolated, {std::make_shared<gslam::ProcessTree>(of_child)});

namespace gslam {
inline namespace v1 {

/// What became of one frame.
///
/// Thread-safety: plain data.
struct FrameTime {
  std::uint64_t frame = 0;     ///< Frame::id
  std::int64_t stamp = 0;      ///< Frame::stamp, nanoseconds
  std::int64_t delivered = 0;  ///< nanoseconds since configure() was called: when noteDelivered()
                               ///< told of it, or else when it came to feed() or was dropped
  bool is_dropped = false;     ///< it was not given to the system
  bool has_result = false;  ///< whether there was a pose; otherwise wall_ms and state mean nothing
  double wall_ms = 0;       ///< from delivery to the first pose of this frame
  double feed_ms = 0;       ///< time in feed()
  /// @{
  /// Of all processes that are measured, whatever they did: from the begin of feed() until both the
  /// pose is there and feed() has returned; without a pose: in feed(). Where frames overlap, as
  /// with a queue in the system, it counts for each; costOf() counts it once.
  double cpu_ms = 0;
  std::uint64_t allocations = 0, allocated_bytes = 0;
  /// @}
  bool has_allocations = false;  ///< whether they are counted; otherwise these mean nothing
  /// @{
  /// What the same processes had used from configure() until the begin of feed(). With it one sees
  /// what belongs to two frames.
  double cpu_ms_before = 0;
  std::uint64_t allocations_before = 0, allocated_bytes_before = 0;
  /// @}
  TrackingState state = TrackingState::lost;  ///< as the first pose of this frame says; lost when
                                              ///< that is not finite
  std::size_t corrections = 0;                ///< further poses of this frame
};

/// What MeasuredSlam measures with.
struct MeasureOptions {
  /// Whose CPU time and allocations (allocationCountsOf() its root) count; null: this process's.
  std::shared_ptr<ProcessTree> tree;
  /// Is told of each frame as soon as feed() has returned, of one whose first pose comes later
  /// again then, and of dropped ones; in the thread in which that happens, by one thread at a time.
  /// The last that is told of a frame is how it is, but for corrections. It should be quick, must
  /// not throw, and must not call what tells it again (feed(), noteDelivered() ...). May be empty.
  std::function<void(const FrameTime&)> on_frame = {};
};

/// A SLAM system around another that notes what each frame costs. Everything is handed on; with a
/// SlamThread inside, waiting in its queue is part of `wall_ms`, with one around it (as
/// Player::play() puts there in real time) only where noteDelivered() is called before the queue.
///
/// Results are the poses on "pose" of the messenger that configure() is given, during feed() or
/// later, in any thread. They are noted after subscribers that were there before. An IsolatedSlam
/// hands on what its system publishes between two calls with the next call: such a pose is as late
/// as that, and `wall_ms` with it.
///
/// As any Slam; the note functions and frames() are thread-safe. It takes about 250 bytes a frame
/// and, of the time of a frame, about 5 us.
class GSLAM_EVALUATION_EXPORT MeasuredSlam : public Slam {
 public:
  /// @throws ArgumentError when slam is null; without a tree as ProcessTree
  explicit MeasuredSlam(std::shared_ptr<Slam> slam, MeasureOptions options = {});
  MeasuredSlam(const MeasuredSlam&) = delete;
  MeasuredSlam& operator=(const MeasuredSlam&) = delete;
  ~MeasuredSlam() override;

  void configure(const SlamSetup& setup) override;
  void feed(const std::shared_ptr<const Frame>& frame) override;
  std::shared_ptr<const Map> map() override;
  void finish() override;

  /// Notes that a frame was given to a queue in front of this one: its time begins now. Frames that
  /// a later one of these overtakes are dropped, and so are those that have not come by finish().
  void noteDelivered(std::uint64_t frame, std::int64_t stamp);
  /// All that noteDelivered() told of and that did not come are dropped; for runs without finish().
  void dropWaiting();
  /// Notes a frame that the system is not given, such as one for which there was no time.
  void noteDropped(std::uint64_t frame, std::int64_t stamp);

  /// All frames so far, in the order in which they came.
  std::vector<FrameTime> frames() const;

  /// @{
  /// How long the calls took, seconds; 0: there was none yet.
  double configureSeconds() const;
  double finishSeconds() const;
  /// @}

  /// The system inside.
  const std::shared_ptr<Slam>& inside() const noexcept;

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

/// A CSV file (RFC 4180, but for line ends of one character), one line for each frame after
/// `frame,stamp_ns,delivered_ns,dropped,wall_ms,feed_ms,cpu_ms,allocations,allocated_bytes,state,
/// corrections,cpu_ms_before,allocations_before,allocated_bytes_before` (one line); what there is
/// no value of is empty.
GSLAM_EVALUATION_EXPORT std::string frameTimesCsv(const std::vector<FrameTime>& frames);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_FRAME_TIMES_H
