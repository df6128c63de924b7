#include <gslam/base/error.h>
#include <gslam/evaluation/allocation_counts.h>
#include <gslam/evaluation/frame_times.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "steady_time.h"

namespace gslam {
inline namespace v1 {
namespace {

bool isFinite(const SE3d& pose) {
  return std::all_of(pose.data(), pose.data() + 7, [](double x) { return std::isfinite(x); });
}

// Milliseconds with all digits of a nanosecond, whatever the locale.
std::string milliseconds(double value) {
  const long long nanoseconds = std::llround(1e6 * std::max(0.0, value));
  const std::string digits = std::to_string(nanoseconds % 1000000);
  return std::to_string(nanoseconds / 1000000) + '.' + std::string(6 - digits.size(), '0') + digits;
}

}  // namespace

class MeasuredSlam::Impl {
 public:
  Impl(std::shared_ptr<Slam> slam, MeasureOptions options)
      : slam_(std::move(slam)),
        tree_(std::move(options.tree)),
        on_frame_(std::move(options.on_frame)),
        start_(detail::steadyTime()) {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  const std::shared_ptr<Slam>& slam() const { return slam_; }

  void begin(Subscriber subscriber) {
    subscriber_ = std::move(subscriber);
    const std::lock_guard<std::mutex> lock(mutex_);
    start_ = detail::steadyTime();
    used_before_ = read();
  }
  // No pose is noted after it.
  void end() { subscriber_ = Subscriber(); }

  void feed(const std::shared_ptr<const Frame>& frame) {
    const std::int64_t delivered = takeDelivered(frame->id);
    const std::size_t index = open(frame->id, frame->stamp, delivered);
    const std::int64_t before = detail::steadyTime();
    try {
      slam_->feed(frame);
    } catch (...) {
      close(index, before);
      throw;
    }
    close(index, before);
  }

  void noteDelivered(std::uint64_t frame, std::int64_t stamp) {
    const std::lock_guard<std::mutex> lock(mutex_);
    delivered_.push_back({frame, stamp, detail::steadyTime()});
  }

  // Those that were delivered before a frame, or all.
  void dropWaiting(const std::uint64_t* before = nullptr) {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!delivered_.empty() && (before == nullptr || delivered_.front().frame != *before)) {
      const Delivery dropped = delivered_.front();
      delivered_.pop_front();
      lock.unlock();
      drop(dropped.frame, dropped.stamp, dropped.time);
      lock.lock();
    }
  }

  void drop(std::uint64_t frame, std::int64_t stamp, std::int64_t time) {
    Entry entry;
    entry.time.frame = frame;
    entry.time.stamp = stamp;
    entry.time.is_dropped = true;
    std::size_t index = 0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      entry.time.delivered = time - start_;
      index = entries_.size();
      entries_.push_back(entry);
    }
    tell(index);
  }

  void take(const TrackedPose& pose) {
    const std::int64_t time = detail::steadyTime();
    std::size_t index = 0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const auto found = index_.find(pose.frame);
      if (found == index_.end()) return;  // of no frame that was fed
      index = found->second;
      Entry& entry = entries_[index];
      if (entry.time.has_result) {
        ++entry.time.corrections;
        return;
      }
      entry.time.has_result = true;
      // As the Recorder has it.
      const bool is_invalid = hasPose(pose.state) && !isFinite(pose.T_world_body);
      entry.time.state = is_invalid ? TrackingState::lost : pose.state;
      entry.time.wall_ms = 1e-6 * double(time - entry.begin);
      charge(entry);
      if (!entry.is_fed) return;
    }
    tell(index);
  }

  std::vector<FrameTime> frames() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<FrameTime> frames;
    frames.reserve(entries_.size());
    for (const Entry& entry : entries_) frames.push_back(entry.time);
    return frames;
  }

  void setSeconds(double Impl::*which, std::int64_t begin) {
    const std::lock_guard<std::mutex> lock(mutex_);
    this->*which = 1e-9 * double(detail::steadyTime() - begin);
  }
  double seconds(double Impl::*which) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return this->*which;
  }

  double configure_seconds_ = 0, finish_seconds_ = 0;  // guarded by the mutex

 private:
  struct Meters {
    std::int64_t cpu = 0;  // nanoseconds
    AllocationCounts allocations;
  };
  struct Entry {
    FrameTime time;
    std::int64_t begin = 0;  // its delivery
    std::int64_t cpu = 0;    // nanoseconds, at the begin of feed()
    std::uint64_t calls = 0, bytes = 0;
    bool is_fed = false;  // feed() has returned
  };
  struct Delivery {
    std::uint64_t frame;
    std::int64_t stamp, time;
  };

  // As the frame is now, so that what is told last is never older than what was told before.
  void tell(std::size_t index) {
    if (!on_frame_) return;
    const std::lock_guard<std::mutex> in_order(tell_mutex_);
    FrameTime frame;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      frame = entries_[index].time;
    }
    on_frame_(frame);
  }

  Meters read() const {
    Meters meters;
    meters.allocations = allocationCountsOf(tree_->root());
    meters.cpu = tree_->cpuTime();
    return meters;
  }

  // When a frame was delivered that comes now; those before it were dropped.
  std::int64_t takeDelivered(std::uint64_t frame) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const auto is_it = [frame](const Delivery& delivery) { return delivery.frame == frame; };
      if (std::none_of(delivered_.begin(), delivered_.end(), is_it)) return detail::steadyTime();
    }
    dropWaiting(&frame);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (delivered_.empty()) return detail::steadyTime();  // another thread dropped it
    const std::int64_t time = delivered_.front().time;
    delivered_.pop_front();
    return time;
  }

  // What this allocates itself comes before the meters are read.
  std::size_t open(std::uint64_t frame, std::int64_t stamp, std::int64_t delivered) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::size_t index = entries_.size();
    entries_.emplace_back();
    index_[frame] = index;
    Entry& entry = entries_.back();
    entry.time.frame = frame;
    entry.time.stamp = stamp;
    entry.time.delivered = delivered - start_;
    entry.begin = delivered;
    const Meters meters = read();
    entry.cpu = meters.cpu;
    entry.calls = meters.allocations.calls;
    entry.bytes = meters.allocations.bytes;
    entry.time.cpu_ms_before = 1e-6 * double(meters.cpu - used_before_.cpu);
    entry.time.allocations_before = entry.calls - used_before_.allocations.calls;
    entry.time.allocated_bytes_before = entry.bytes - used_before_.allocations.bytes;
    return index;
  }

  void close(std::size_t index, std::int64_t before) {
    const std::int64_t time = detail::steadyTime();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      Entry& entry = entries_[index];
      entry.time.feed_ms = 1e-6 * double(time - before);
      charge(entry);
      entry.is_fed = true;
    }
    tell(index);
  }

  // Called at the pose and at the end of feed(), the later of which stays.
  void charge(Entry& entry) const {
    const Meters meters = read();
    entry.time.cpu_ms = 1e-6 * double(meters.cpu - entry.cpu);
    entry.time.has_allocations = meters.allocations.is_counted;
    entry.time.allocations = meters.allocations.calls - entry.calls;
    entry.time.allocated_bytes = meters.allocations.bytes - entry.bytes;
  }

  const std::shared_ptr<Slam> slam_;
  const std::shared_ptr<ProcessTree> tree_;
  const std::function<void(const FrameTime&)> on_frame_;
  std::mutex tell_mutex_;  // taken before the other
  mutable std::mutex mutex_;
  std::int64_t start_;
  Meters used_before_;  // at the start
  std::deque<Delivery> delivered_;
  std::vector<Entry> entries_;
  std::unordered_map<std::uint64_t, std::size_t> index_;  // of the last with a number
  Subscriber subscriber_;
};

MeasuredSlam::MeasuredSlam(std::shared_ptr<Slam> slam, MeasureOptions options) {
  if (!slam) throw ArgumentError("slam", "is null, expected a SLAM system");
  if (!options.tree) options.tree = std::make_shared<ProcessTree>();
  impl_ = std::make_shared<Impl>(std::move(slam), std::move(options));
}

MeasuredSlam::~MeasuredSlam() {
  impl_->end();
}

void MeasuredSlam::configure(const SlamSetup& setup) {
  const std::weak_ptr<Impl> weak = impl_;
  impl_->begin(setup.messenger.subscribe<TrackedPose>("pose", [weak](const TrackedPose& pose) {
    if (const std::shared_ptr<Impl> impl = weak.lock()) impl->take(pose);
  }));
  const std::int64_t before = detail::steadyTime();
  impl_->slam()->configure(setup);
  impl_->setSeconds(&Impl::configure_seconds_, before);
}

void MeasuredSlam::feed(const std::shared_ptr<const Frame>& frame) {
  if (!frame) throw ArgumentError("frame", "is null, expected one to feed");
  impl_->feed(frame);
}

std::shared_ptr<const Map> MeasuredSlam::map() {
  return impl_->slam()->map();
}

void MeasuredSlam::finish() {
  impl_->dropWaiting();
  const std::int64_t before = detail::steadyTime();
  impl_->slam()->finish();
  impl_->setSeconds(&Impl::finish_seconds_, before);
}

void MeasuredSlam::noteDropped(std::uint64_t frame, std::int64_t stamp) {
  impl_->drop(frame, stamp, detail::steadyTime());
}
void MeasuredSlam::noteDelivered(std::uint64_t frame, std::int64_t stamp) {
  impl_->noteDelivered(frame, stamp);
}
void MeasuredSlam::dropWaiting() {
  impl_->dropWaiting();
}
std::vector<FrameTime> MeasuredSlam::frames() const {
  return impl_->frames();
}
double MeasuredSlam::configureSeconds() const {
  return impl_->seconds(&Impl::configure_seconds_);
}
double MeasuredSlam::finishSeconds() const {
  return impl_->seconds(&Impl::finish_seconds_);
}
const std::shared_ptr<Slam>& MeasuredSlam::inside() const noexcept {
  return impl_->slam();
}

std::string frameTimesCsv(const std::vector<FrameTime>& frames) {
  std::string out =
      "frame,stamp_ns,delivered_ns,dropped,wall_ms,feed_ms,cpu_ms,allocations,allocated_bytes,"
      "state,corrections,cpu_ms_before,allocations_before,allocated_bytes_before\n";
  for (const FrameTime& f : frames) {
    const auto counted = [&f](std::uint64_t count) {
      return f.has_allocations ? std::to_string(count) : std::string();
    };
    out += std::to_string(f.frame) + ',' + std::to_string(f.stamp) + ',' +
           std::to_string(f.delivered) + ',' + (f.is_dropped ? "1," : "0,");
    if (f.is_dropped) {
      out += ",,,,,,,,,\n";
      continue;
    }
    out += (f.has_result ? milliseconds(f.wall_ms) : "") + ',' + milliseconds(f.feed_ms) + ',' +
           milliseconds(f.cpu_ms) + ',' + counted(f.allocations) + ',' +
           counted(f.allocated_bytes) + ',' + (f.has_result ? trackingStateName(f.state) : "") +
           ',' + std::to_string(f.corrections) + ',' + milliseconds(f.cpu_ms_before) + ',' +
           counted(f.allocations_before) + ',' + counted(f.allocated_bytes_before) + '\n';
  }
  return out;
}

}  // namespace v1
}  // namespace gslam
