#include "motion.h"

#include <gslam/geometry/random.h>

#include <algorithm>
#include <cmath>

#include "hash.h"
#include "pi.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr double kMostControls = 1e5;

double pausedBefore(const std::vector<Pause>& pauses, double time) {
  double sum = 0;
  for (const Pause& pause : pauses) {
    sum += std::min(std::max(time - pause.begin, 0.0), pause.end - pause.begin);
  }
  return sum;
}

// Looks to and fro, not faster than 40 degrees a second.
double turnInPauses(const std::vector<Pause>& pauses, double time) {
  double sum = 0;
  for (const Pause& pause : pauses) {
    if (time <= pause.begin || time >= pause.end) continue;
    const double length = pause.end - pause.begin;
    sum += std::min(0.8, 0.1 * length) * std::sin(2 * kPi * (time - pause.begin) / length);
  }
  return sum;
}

struct Plan {
  double round;  // seconds
  int count;     // controls of a round
  double interval() const { return round / count; }
};

Plan planOf(const Route& route, const MotionOptions& options) {
  const double paused = pausedBefore(options.pauses, 1e12);
  const double speed =
      options.speed > 0
          ? options.speed
          : std::min(route.most_speed, route.length / std::max(options.duration - paused, 1e-3));
  Plan plan{};
  plan.round = route.length / speed + paused;
  plan.count = std::max(12, static_cast<int>(std::ceil(route.length / route.control_step)));
  // Pauses need several controls each, and time goes on meanwhile.
  const double timed = std::min(std::ceil(plan.round / 0.45), kMostControls);
  plan.count = std::max(plan.count, static_cast<int>(timed));
  return plan;
}

// Controls around a pause stand still, so that the spline does throughout it.
std::vector<Pause> widened(const std::vector<Pause>& pauses, const Plan& plan) {
  std::vector<Pause> wide;
  const double interval = plan.interval();
  for (const Pause& pause : pauses) {
    wide.push_back({std::max(0.0, pause.begin - 2.05 * interval),
                    std::min(plan.round, pause.end + 2.05 * interval)});
    if (wide.size() > 1 && wide[wide.size() - 2].end > wide.back().begin) {
      wide[wide.size() - 2].end = wide.back().end;
      wide.pop_back();
    }
  }
  return wide;
}

class Controls {
 public:
  Controls(const Route& route, const MotionOptions& options, const Plan& plan)
      : route_(route), options_(options), plan_(plan), wide_(widened(options.pauses, plan)) {}

  std::vector<SE3d> make() const {
    std::vector<SE3d> round;
    for (int k = 0; k < plan_.count; ++k) round.push_back(control(k));
    std::vector<SE3d> controls = {round.back()};
    controls.insert(controls.end(), round.begin(), round.end());
    controls.push_back(round[0]);
    controls.push_back(round[1]);
    return controls;
  }

 private:
  SE3d control(int k) const {
    const double time = k * plan_.interval();
    const double moving = plan_.round - pausedBefore(wide_, plan_.round);
    const double part = (time - pausedBefore(wide_, time)) / std::max(moving, 1e-3);
    const Vec3d place = route_.place(part);
    const Vec3d ahead = route_.place(part + route_.look_ahead / route_.length) -
                        route_.place(part - 0.3 * route_.look_ahead / route_.length);
    const double yaw = std::atan2(ahead[1], ahead[0]) + route_.look_left +
                       route_.swing * std::sin(2 * kPi * (2 * part + 0.25)) +
                       turnInPauses(options_.pauses, time);
    // What stands still shakes by the same in place, but not in its direction.
    const int shaken = pauseOf(time) >= 0 ? -1 - pauseOf(time) : k;
    Generator place_random(keyOf(options_.seed, 20, std::uint64_t(shaken) + 1000));
    Generator angle_random(keyOf(options_.seed, 21, std::uint64_t(k)));
    const Vec3d shift = route_.shake_place * bounded(randomNormal<double, 3>(place_random));
    const Vec3d turn = route_.shake_angle * bounded(randomNormal<double, 3>(angle_random));
    return SE3d(SO3d::exp({{0, 0, yaw}}) * SO3d::exp(turn), place + shift);
  }

  int pauseOf(double time) const {
    for (std::size_t i = 0; i < wide_.size(); ++i) {
      if (time >= wide_[i].begin && time <= wide_[i].end) return static_cast<int>(i);
    }
    return -1;
  }

  static Vec3d bounded(Vec3d v) {
    for (double& x : v.values) x = std::min(std::max(x, -2.5), 2.5);
    return v;
  }

  const Route& route_;
  const MotionOptions& options_;
  Plan plan_;
  std::vector<Pause> wide_;
};

Spline<SE3d> splineOf(const Route& route, const MotionOptions& options) {
  const Plan plan = planOf(route, options);
  const auto interval = static_cast<std::int64_t>(std::ceil(plan.interval() * 1e9));
  return Spline<SE3d>(0, interval, Controls(route, options, plan).make());
}

}  // namespace

Motion::Motion(const Route& route, const MotionOptions& options)
    : round_(0), spline_(splineOf(route, options)) {
  round_ = spline_.end() - spline_.start();
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
