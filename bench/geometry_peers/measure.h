// One measurement for all: an operation over 1024 random elements, results stored. All 1024 results
// are compared with those of elements.h before any time is taken.
#ifndef GSLAM_BENCH_GEOMETRY_PEERS_MEASURE_H
#define GSLAM_BENCH_GEOMETRY_PEERS_MEASURE_H

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "elements.h"

/// Registers the cases of one group of one peer, `so3_mult/eigen` and so on, before main(). Only
/// the functions of those cases that are asked for need be there.
///
///     const auto kSo3 = Cases<Rotation>("eigen").mult().trans();
///
/// @tparam Peer  inherits So3, Se3 or Sim3; has types Group and Point, and for exp, log and
/// Jacobian
///   also Tangent, the last two with operator[]; makes its inputs with `Group make(const
///   Element&)`, `Point point(const double*)` and `Tangent tangent(const double*)`; has the static
///   functions `mult(a, b)`, `trans(a, point)`, `exp(tangent)`, `log(a)`, `inverse(a)`,
///   `leftJacobian(tangent)` and `void transMany(a, const Point*, std::size_t, Point*)`
template <class Peer>
class Cases {
 public:
  using Group = typename Peer::Group;
  using Point = typename Peer::Point;
  using State = benchmark::State;

  explicit Cases(const char* name) : name_(name) {}

  /// a b, for 1024 pairs.
  Cases mult() const {
    return add("mult", [](State& state) {
      const std::vector<Group> a = groups(first()), b = groups(second());
      measure(
          state, [&](std::size_t i) BENCH_INLINE { return Peer::mult(a[i], b[i]); },
          [](const Group& ab, std::size_t i) {
            return takes(ab, itself, [i](const Xyz& p) { return first()[i] * (second()[i] * p); });
          });
    });
  }

  /// a p, one point for each of 1024 elements.
  Cases trans() const {
    return add("trans", [](State& state) {
      const std::vector<Group> a = groups(first());
      const std::vector<Point> p = somePoints();
      measure(
          state, [&](std::size_t i) BENCH_INLINE { return Peer::trans(a[i], p[i]); },
          [](const Point& ap, std::size_t i) { return isNear(ap, first()[i] * points()[i]); });
    });
  }

  /// a p, one element for 1024 points.
  Cases transMany() const {
    return add("trans_many", [](State& state) {
      const Group a = Peer::make(first()[0]);
      const std::vector<Point> p = somePoints();
      measureMany<Point>(
          state, [&](Point* to) { Peer::transMany(a, p.data(), kElements, to); },
          [](const Point& ap, std::size_t i) { return isNear(ap, first()[0] * points()[i]); });
    });
  }

  /// 1024 tangents to elements.
  Cases exp() const {
    return add("exp", [](State& state) {
      const auto v = tangents();
      measure(
          state, [&](std::size_t i) BENCH_INLINE { return Peer::exp(v[i]); },
          [](const Group& a, std::size_t i) {
            return takes(a, itself, [i](const Xyz& p) { return first()[i] * p; });
          });
    });
  }

  /// 1024 elements to tangents.
  Cases log() const {
    return add("log", [](State& state) {
      const std::vector<Group> a = groups(first());
      measure(
          state, [&](std::size_t i) BENCH_INLINE { return Peer::log(a[i]); },
          [](const auto& v, std::size_t i) {
            bool is_right = true;
            for (std::size_t k = 0; k < Peer::kSize; ++k) {
              is_right = is_right && isNear(v[k], first()[i].tangent[Peer::kFirst + k]);
            }
            return is_right;
          });
    });
  }

  /// 1024 inverses.
  Cases inverse() const {
    return add("inverse", [](State& state) {
      const std::vector<Group> a = groups(first());
      measure(
          state, [&](std::size_t i) BENCH_INLINE { return Peer::inverse(a[i]); },
          [](const Group& inverse, std::size_t i) {
            return takes(
                inverse, [i](const Xyz& p) { return first()[i] * p; }, itself);
          });
    });
  }

  /// The left Jacobian at 1024 tangents; of SE3 alone.
  Cases leftJacobian() const {
    return add("left_jacobian", [](State& state) {
      const auto v = tangents();
      measure(
          state, [&](std::size_t i) BENCH_INLINE { return Peer::leftJacobian(v[i]); },
          [](const auto& jacobian, std::size_t i) {
            const Square<6> expected = first()[i].leftJacobian();
            bool is_right = true;
            for (std::size_t k = 0; k < 36; ++k) {
              is_right = is_right && isNear(jacobian(k / 6, k % 6), expected[k / 6][k % 6]);
            }
            return is_right;
          });
    });
  }

 private:
  template <class Function>
  Cases add(const char* operation, Function function) const {
    const std::string name = std::string(Peer::kGroup) + "_" + operation + "/" + name_;
    benchmark::RegisterBenchmark(name.c_str(), function);
    return *this;
  }

  // The inputs in numbers, and as the peer has them.
  static const std::vector<Element>& first() {
    static const std::vector<Element> elements = randomElements<Peer>(1);
    return elements;
  }
  static const std::vector<Element>& second() {
    static const std::vector<Element> elements = randomElements<Peer>(2);
    return elements;
  }
  static const std::vector<Xyz>& points() {
    static const std::vector<Xyz> points = randomPoints(3);
    return points;
  }
  static std::vector<Group> groups(const std::vector<Element>& elements) {
    std::vector<Group> result;
    for (const Element& element : elements) result.push_back(Peer::make(element));
    return result;
  }
  static auto tangents() {
    std::vector<typename Peer::Tangent> result;
    for (const Element& e : first()) result.push_back(Peer::tangent(&e.tangent[Peer::kFirst]));
    return result;
  }
  static std::vector<Point> somePoints() {
    std::vector<Point> result;
    for (const Xyz& point : points()) result.push_back(Peer::point(point.data()));
    return result;
  }

  // What is right.
  static bool isNear(long double value, long double expected) {
    return std::fabs(value - expected) <= 1e-6L * std::max(1.0L, std::fabs(expected));
  }
  static bool isNear(const Point& point, const Xyz& expected) {
    return isNear(point[0], expected[0]) && isNear(point[1], expected[1]) &&
           isNear(point[2], expected[2]);
  }
  static Xyz itself(const Xyz& p) { return p; }

  /// Whether `a` takes from(p) to to(p); four points, not in a plane, leave no doubt.
  template <class From, class To>
  static bool takes(const Group& a, const From& from, const To& to) {
    const Xyz corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return std::all_of(std::begin(corners), std::end(corners), [&](const Xyz& p) {
      return isNear(Peer::trans(a, Peer::point(from(p).data())), to(p));
    });
  }

  /// @param operation  makes one result, given its index
  /// @param is_right   whether a result is right, given it and its index
  template <class Operation, class IsRight>
  static void measure(State& state, const Operation& operation, const IsRight& is_right) {
    using Result = decltype(operation(0));
    measureMany<Result>(
        state,
        [&](Result* to) BENCH_INLINE {
          for (std::size_t i = 0; i < kElements; ++i) to[i] = operation(i);
        },
        is_right);
  }

  /// @param operation  writes 1024 results to where it is told
  template <class Result, class Operation, class IsRight>
  static void measureMany(State& state, const Operation& operation, const IsRight& is_right) {
    // Not at a multiple of 4096 bytes from an input, where the processor would take each load for
    // one of what was just stored.
    std::vector<Result> storage(kElements + 1500 / sizeof(Result));
    Result* const results = &storage[1500 / sizeof(Result)];
    operation(results);
    for (std::size_t i = 0; i < kElements; ++i) {
      if (is_right(results[i], i)) continue;
      state.SkipWithError(("wrong for element " + std::to_string(i)).c_str());
      return;
    }
    for (auto _ : state) {
      operation(results);
      benchmark::DoNotOptimize(results);
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kElements));
  }

  const char* name_;
};

/// trans for each of many points: what users of a peer without a call for many write.
template <class Peer>
void transOneByOne(const typename Peer::Group& a, const typename Peer::Point* p, std::size_t n,
                   typename Peer::Point* to) {
  for (std::size_t i = 0; i < n; ++i) to[i] = Peer::trans(a, p[i]);
}

#endif  // GSLAM_BENCH_GEOMETRY_PEERS_MEASURE_H
