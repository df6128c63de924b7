#ifndef GSLAM_GEOMETRY_SPLINE_H
#define GSLAM_GEOMETRY_SPLINE_H

#include <gslam/base/error.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Smooth motions through rotations or poses.

namespace gslam {
inline namespace v1 {

/// A point of a Spline.
template <class G>
struct SplineSample {
  G value;                       ///< the rotation or pose
  typename G::Tangent velocity;  ///< in the body's frame, per second: value' = value hat(velocity)
  typename G::Tangent acceleration;  ///< the derivative of velocity, per second squared
};

/// A cumulative cubic B-spline on a group (SO2, SO3, SE2, SE3, SIM3): a motion that is twice
/// continuously differentiable, and of which each piece depends on four controls only. It runs near
/// the controls, not through them; controls of a constant velocity are met.
///
///     value(t) = c_i exp(l1 d_1) exp(l2 d_2) exp(l3 d_3),    d_j = log(c_(i+j-1)^-1 c_(i+j))
///
/// with polynomials l1, l2, l3 of the time within the interval. Between two controls the spline
/// takes the shorter way round, so they must be less than half a turn apart.
///
/// Of SE3 with T_world_body and velocity (v, w), acceleration (a, b): an inertial sensor in the
/// body feels the turning rate w and the acceleration a + w x v, less gravity.
///
/// Thread-safety: immutable, may be shared.
///
/// Source: C. Sommer, V. Usenko, D. Schubert, N. Demmel, D. Cremers, "Efficient derivative
/// computation for cumulative B-splines on Lie groups", CVPR 2020.
template <class G>
class Spline {
 public:
  using Scalar = typename G::Scalar;    ///< float or double
  using Tangent = typename G::Tangent;  ///< that of the group

  /// @param start     time at which the spline begins, ns. It is that of the second control; the
  ///   first and the last only shape the ends
  /// @param interval  time from one control to the next, ns
  /// @param controls  four or more
  /// @throws ArgumentError when there are fewer than four, the interval is not above 0, or the end
  ///   is beyond what a time may be
  Spline(std::int64_t start, std::int64_t interval, std::vector<G> controls)
      : start_(start), interval_(interval), controls_(std::move(controls)) {
    if (controls_.size() < 4) {
      throw ArgumentError("controls",
                          "are " + std::to_string(controls_.size()) + ", expected 4 or more");
    }
    if (interval_ <= 0) {
      throw ArgumentError("interval",
                          "is " + std::to_string(interval_) + " ns, expected more than 0");
    }
    // As unsigned, because the difference of two times may be beyond their range.
    const auto begin = static_cast<std::uint64_t>(start_);
    const auto step = static_cast<std::uint64_t>(interval_);
    const std::uint64_t room =
        static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) - begin;
    const std::uint64_t count = controls_.size() - 3;
    if (count > room / step) {
      throw ArgumentError("interval", "is too long, the end is beyond the range of times");
    }
    end_ = static_cast<std::int64_t>(begin + count * step);
    steps_.reserve(controls_.size() - 1);
    for (std::size_t i = 1; i < controls_.size(); ++i) {
      steps_.push_back((controls_[i - 1].inverse() * controls_[i]).log());
    }
  }

  /// First time of the spline, ns.
  std::int64_t start() const noexcept { return start_; }
  /// Last time of the spline, ns.
  std::int64_t end() const noexcept { return end_; }
  /// Time from one control to the next, ns.
  std::int64_t interval() const noexcept { return interval_; }
  /// The controls.
  const std::vector<G>& controls() const noexcept { return controls_; }

  /// The rotation or pose at a time.
  /// @param time  ns, from start() to end()
  /// @throws ArgumentError when it is not
  G at(std::int64_t time) const {
    const Piece piece = pieceAt(time);
    G value = controls_[piece.first];
    for (std::size_t j = 0; j < 3; ++j) {
      value *= G::exp(steps_[piece.first + j] * piece.weight[j]);
    }
    return value;
  }

  /// The same with its first and second derivative.
  /// @param time  ns, from start() to end()
  /// @throws ArgumentError when it is not
  SplineSample<G> sampleAt(std::int64_t time) const {
    const Piece piece = pieceAt(time);
    SplineSample<G> sample{controls_[piece.first], {}, {}};
    for (std::size_t j = 0; j < 3; ++j) {
      const Tangent& d = steps_[piece.first + j];
      const G factor = G::exp(d * piece.weight[j]);
      const auto back = factor.inverse().adjoint();
      const Tangent turned = back * sample.velocity;
      sample.value *= factor;
      sample.velocity = turned + piece.slope[j] * d;
      sample.acceleration = back * sample.acceleration + piece.slope[j] * (G::ad(turned) * d) +
                            piece.curvature[j] * d;
    }
    return sample;
  }

 private:
  // Between which controls a time lies, and the polynomials with their derivatives by seconds.
  struct Piece {
    std::size_t first;
    Scalar weight[3], slope[3], curvature[3];
  };

  Piece pieceAt(std::int64_t time) const {
    if (time < start_ || time > end_) {
      throw ArgumentError("time", "is " + std::to_string(time) + " ns, expected one from " +
                                      std::to_string(start_) + " to " + std::to_string(end_));
    }
    const std::uint64_t since =
        static_cast<std::uint64_t>(time) - static_cast<std::uint64_t>(start_);
    const auto step = static_cast<std::uint64_t>(interval_);
    std::size_t first = static_cast<std::size_t>(since / step);
    if (first == controls_.size() - 3) --first;  // the end belongs to the last piece
    const auto u =
        static_cast<Scalar>(static_cast<double>(since - first * step) / static_cast<double>(step));
    const auto rate = static_cast<Scalar>(1e9 / static_cast<double>(interval_));
    const Scalar sixth = Scalar(1) / 6;
    const Scalar square = u * u;
    const Scalar cube = square * u;
    return {first,
            {sixth * (5 + 3 * u - 3 * square + cube), sixth * (1 + 3 * (u + square) - 2 * cube),
             sixth * cube},
            {rate * (Scalar(0.5) - u + Scalar(0.5) * square), rate * (Scalar(0.5) + u - square),
             rate * Scalar(0.5) * square},
            {rate * rate * (u - 1), rate * rate * (1 - 2 * u), rate * rate * u}};
  }

  std::int64_t start_, interval_, end_;
  std::vector<G> controls_;
  std::vector<Tangent> steps_;  // from each control to the next
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_SPLINE_H
