#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "mapping/mapping.h"
#include "pipeline.h"
#include "tracking/patience.h"

namespace visual {
namespace {

using gslam::KeyframeId;
using gslam::TrackingState;

// Work for a thread: one job after the other, until it is closed. A job that throws ends the work;
// what it threw is thrown again by whoever asks.
class Worker {
 public:
  Worker() : thread_([this] { run(); }) {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() { close(); }

  void post(std::function<void()> job) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (error_ != nullptr || is_closed_) return;
    jobs_.push_back(std::move(job));
    changed_.notify_one();
  }
  /// Jobs that wait or are in work.
  std::size_t pending() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return jobs_.size() + (is_working_ ? 1 : 0);
  }
  /// Waits until there is nothing left to do.
  void drain() {
    std::unique_lock<std::mutex> lock(mutex_);
    idle_.wait(lock, [this] { return jobs_.empty() && !is_working_; });
  }
  /// Waits until fewer than `count` jobs wait or are in work.
  void waitBelow(std::size_t count) {
    std::unique_lock<std::mutex> lock(mutex_);
    idle_.wait(lock, [&] { return jobs_.size() + (is_working_ ? 1 : 0) < count; });
  }
  void rethrow() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (error_ != nullptr) std::rethrow_exception(error_);
  }
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_closed_ = true;
      changed_.notify_one();
    }
    if (thread_.joinable()) thread_.join();
  }

 private:
  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return !jobs_.empty() || is_closed_; });
      if (jobs_.empty()) return;
      const std::function<void()> job = std::move(jobs_.front());
      jobs_.pop_front();
      is_working_ = true;
      lock.unlock();
      std::exception_ptr error;
      try {
        job();
      } catch (...) {
        error = std::current_exception();
      }
      lock.lock();
      is_working_ = false;
      if (error != nullptr) {
        error_ = error;
        jobs_.clear();
      }
      idle_.notify_all();
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_, idle_;
  std::deque<std::function<void()>> jobs_;
  std::exception_ptr error_;
  bool is_working_ = false;
  bool is_closed_ = false;
  std::thread thread_;  // last: it uses all of the above
};

// The mapper's thread owns the world; after each change it shows a snapshot, which the other two
// threads read. They talk to it by jobs alone.
class ThreadedPipeline : public Pipeline {
 public:
  ThreadedPipeline(const Options& options, const Eye& eye)
      : options_(options),
        places_(options.loop, options.seed),
        relocalizer_(options, places_),
        mapping_(options, eye, places_),
        tracker_(options, relocalizer_),
        detector_(options, places_) {
    show();
  }

  ~ThreadedPipeline() override { end(); }

  Tracked step(const std::shared_ptr<const View>& view) override {
    rethrow();
    has_restarted_ = false;
    std::shared_ptr<const Scene> scene = this->scene();
    if (scene->facts.empty()) return start(view);
    Tracked tracked = tracker_.track(view, *scene, mapper_.pending() == 0);
    if (patience_.isOver(tracked.state, scene->map.keyframes().size())) {
      return restart(view);
    }
    if (tracked.is_keyframe_due) {
      // Rather late than lost: what comes next needs the points of this one.
      mapper_.waitBelow(kMostWaiting);
      mapper_.post([this, request = std::make_shared<KeyframeRequest>(tracker_.takeKeyframe())] {
        addKeyframe(*request);
      });
    }
    return tracked;
  }

  void finish() override {
    end();
    rethrow();
  }

  std::shared_ptr<const Scene> scene() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return shown_;
  }

  bool hasRestarted() override { return has_restarted_; }

 private:
  static constexpr std::size_t kMostWaiting = 2;

  // Waits until nobody works. A job of one may post to the other: a keyframe is searched for a
  // loop, which is closed, then all is adjusted, and applied.
  void settle() {
    for (int i = 0; i < 2; ++i) {
      mapper_.drain();
      looper_.drain();
    }
    mapper_.drain();
  }

  void end() {
    settle();
    looper_.close();
    mapper_.close();
  }

  void rethrow() const {
    mapper_.rethrow();
    looper_.rethrow();
  }

  // In the thread of the mapper, or while it is idle.
  void show() {
    std::shared_ptr<const Scene> scene = std::make_shared<const Scene>(mapping_.scene());
    const std::lock_guard<std::mutex> lock(mutex_);
    shown_.swap(scene);
  }

  // The first keyframes are made while all others wait.
  Tracked start(const std::shared_ptr<const View>& view) {
    Tracked tracked;
    tracked.state = TrackingState::starting;
    if (!mapping_.begin(view, tracked.reason)) return tracked;
    show();
    return tracker_.begin(view, mapping_.scene());
  }

  Tracked restart(const std::shared_ptr<const View>& view) {
    settle();
    rethrow();
    has_restarted_ = true;
    patience_.reset();
    mapping_.reset();
    detector_.reset();
    show();
    return start(view);
  }

  // Below: the thread of the mapper.
  void addKeyframe(const KeyframeRequest& request) {
    const KeyframeId id = mapping_.add(request);
    show();
    mapping_.improve(id, mapper_.pending() > 1);
    show();
    if (!options_.loop.enabled || is_closing_) return;
    looper_.post([this, id, scene = this->scene()] { detect(*scene, id); });
  }

  void close(const Loop& loop) {
    if (mapping_.scene().map.find(loop.here) == nullptr ||
        mapping_.scene().map.find(loop.there) == nullptr) {
      is_closing_ = false;
      return;
    }
    mapping_.close(loop);
    show();
    if (!options_.loop.adjust_all) {
      is_closing_ = false;
      return;
    }
    looper_.post([this, scene = this->scene()] {
      auto adjusted = std::make_shared<AdjustedScene>(adjustAll(*scene, options_));
      mapper_.post([this, adjusted] {
        mapping_.apply(*adjusted);
        show();
        is_closing_ = false;
      });
    });
  }

  // Below: the thread of loops.
  void detect(const Scene& scene, KeyframeId id) {
    if (is_closing_) return;
    std::optional<Loop> loop = detector_.detect(scene, id);
    if (!loop.has_value()) return;
    is_closing_ = true;
    mapper_.post([this, found = std::make_shared<Loop>(std::move(*loop))] { close(*found); });
  }

  Options options_;
  PlaceIndex places_;
  Relocalizer relocalizer_;
  Mapping mapping_;        // of the mapper's thread
  Tracker tracker_;        // of the caller's thread
  LoopDetector detector_;  // of the thread of loops
  Patience patience_;
  bool has_restarted_ = false;
  std::atomic<bool> is_closing_{false};
  std::mutex mutex_;  // guards shown_
  std::shared_ptr<const Scene> shown_;
  Worker mapper_, looper_;  // last: their threads use all of the above
};

}  // namespace

std::unique_ptr<Pipeline> makeThreadedPipeline(const Options& options, const Eye& eye) {
  return std::make_unique<ThreadedPipeline>(options, eye);
}

}  // namespace visual
