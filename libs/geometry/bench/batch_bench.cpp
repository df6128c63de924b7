// Batches of 1024 elements in every SIMD variant of the machine, from arrays of structures (aos)
// and structures of arrays (soa), beside the loop over the functions of the classes that somebody
// would write: items are elements.
#include <benchmark/benchmark.h>
#include <gslam/geometry/batch.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace {

using gslam::Arrays;
using gslam::SE3;
using gslam::SIM3;
using gslam::SO3;
using gslam::Vec;

constexpr std::size_t kElements = 1024;
// From one array of a structure of arrays to the next. Not a multiple of 4096 bytes, at which all
// arrays would fight for the same places of the cache.
constexpr std::size_t kStride = kElements + 40;

template <class T>
Vec<T, 3> vectorInBall(std::mt19937& generator) {
  std::uniform_real_distribution<double> coordinate(-3.14159265, 3.14159265);
  for (;;) {
    Vec<T, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = static_cast<T>(coordinate(generator));
    if (v.norm() < T(3.14159265)) return v;
  }
}

// Elements of every kind: rotation vectors and points evenly distributed in the ball of radius pi.
template <class T>
void fill(std::mt19937& generator, Vec<T, 3>& v) {
  v = vectorInBall<T>(generator);
}
template <class T>
void fill(std::mt19937& generator, Vec<T, 6>& v) {
  v.setSegment(0, vectorInBall<T>(generator));
  v.setSegment(3, vectorInBall<T>(generator));
}
template <class T>
void fill(std::mt19937& generator, SO3<T>& r) {
  r = SO3<T>::exp(vectorInBall<T>(generator));
}
template <class T>
void fill(std::mt19937& generator, SE3<T>& t) {
  t = {SO3<T>::exp(vectorInBall<T>(generator)), vectorInBall<T>(generator)};
}
template <class T>
void fill(std::mt19937& generator, SIM3<T>& s) {
  s = {SO3<T>::exp(vectorInBall<T>(generator)), vectorInBall<T>(generator), T(2)};
}

// The same elements in both layouts.
template <class E>
struct Elements {
  using T = typename gslam::detail::ElementFacts<E>::Scalar;
  static constexpr std::size_t kNumbers = gslam::detail::ElementFacts<E>::kNumbers;

  explicit Elements(unsigned seed) : rows(kElements), columns(kNumbers * kStride) {
    std::mt19937 generator(seed);
    for (std::size_t i = 0; i < kElements; ++i) {
      fill(generator, rows[i]);
      for (std::size_t k = 0; k < kNumbers; ++k) columns[k * kStride + i] = rows[i].data()[k];
    }
  }
  Arrays<T, kNumbers> arrays() {
    T* first[kNumbers];
    for (std::size_t k = 0; k < kNumbers; ++k) first[k] = columns.data() + k * kStride;
    return Arrays<T, kNumbers>(first, kElements);
  }

  std::vector<E> rows;
  std::vector<T> columns;
};

template <class Operation>
void measure(benchmark::State& state, const Operation& operation) {
  for (auto _ : state) {
    operation();
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kElements));
}

// One case: `each` for the loop, `rows` and `columns` are batches.
template <class Each, class Aos, class Soa>
void addCase(const std::string& name, const Each& each, const Aos& rows, const Soa& columns) {
  benchmark::RegisterBenchmark((name + "_aos/loop").c_str(), [each](benchmark::State& state) {
    measure(state, [&] {
      for (std::size_t i = 0; i < kElements; ++i) each(i);
    });
  });
  for (const gslam::Simd variant : gslam::availableSimd()) {
    const std::string gslam = std::string("/gslam_") + simdName(variant);
    benchmark::RegisterBenchmark((name + "_aos" + gslam).c_str(),
                                 [variant, rows](benchmark::State& state) {
                                   const gslam::ScopedSimd forced(variant);
                                   measure(state, rows);
                                 });
    benchmark::RegisterBenchmark((name + "_soa" + gslam).c_str(),
                                 [variant, columns](benchmark::State& state) {
                                   const gslam::ScopedSimd forced(variant);
                                   measure(state, columns);
                                 });
  }
}

template <class E>
Elements<E>& elements(unsigned seed) {
  static Elements<E> all[3] = {Elements<E>(1), Elements<E>(2), Elements<E>(3)};
  return all[seed];
}

template <class T>
std::string suffix() {
  return std::is_same<T, float>::value ? "_float" : "";
}

template <class G>
void addGroup(const std::string& group) {
  using T = typename G::Scalar;
  using Point = typename G::Point;
  Elements<Point>& in = elements<Point>(0);
  Elements<Point>& out = elements<Point>(1);
  Elements<G>& a = elements<G>(0);
  Elements<G>& b = elements<G>(1);
  Elements<G>& c = elements<G>(2);
  const std::string end = "_" + group + suffix<T>();
  addCase(
      "points" + end, [&](std::size_t i) { out.rows[i] = a.rows[0] * in.rows[i]; },
      [&] { gslam::transformPoints(a.rows[0], in.rows, out.rows); },
      [&] { gslam::transformPoints(a.rows[0], in.arrays(), out.arrays()); });
  addCase(
      "each_point" + end, [&](std::size_t i) { out.rows[i] = a.rows[i] * in.rows[i]; },
      [&] { gslam::transformPoints<G>(a.rows, in.rows, out.rows); },
      [&] { gslam::transformPoints<G>(a.arrays(), in.arrays(), out.arrays()); });
  addCase(
      "compose" + end, [&](std::size_t i) { c.rows[i] = a.rows[i] * b.rows[i]; },
      [&] { gslam::composeMany<G>(a.rows, b.rows, c.rows); },
      [&] { gslam::composeMany<G>(a.arrays(), b.arrays(), c.arrays()); });
  addCase(
      "inverse" + end, [&](std::size_t i) { c.rows[i] = a.rows[i].inverse(); },
      [&] { gslam::inverseMany<G>(a.rows, c.rows); },
      [&] { gslam::inverseMany<G>(a.arrays(), c.arrays()); });
}

template <class G>
void addExpLog(const std::string& group) {
  using T = typename G::Scalar;
  using Tangent = typename G::Tangent;
  Elements<Tangent>& in = elements<Tangent>(0);
  Elements<Tangent>& out = elements<Tangent>(1);
  Elements<G>& a = elements<G>(0);
  Elements<G>& c = elements<G>(2);
  const std::string end = "_" + group + suffix<T>();
  addCase(
      "exp" + end, [&](std::size_t i) { c.rows[i] = G::exp(in.rows[i]); },
      [&] { gslam::expMany<G>(in.rows, c.rows); },
      [&] { gslam::expMany<G>(in.arrays(), c.arrays()); });
  addCase(
      "log" + end, [&](std::size_t i) { out.rows[i] = a.rows[i].log(); },
      [&] { gslam::logMany<G>(a.rows, out.rows); },
      [&] { gslam::logMany<G>(a.arrays(), out.arrays()); });
}

template <class T>
int addAll() {
  addGroup<SO3<T>>("so3");
  addGroup<SE3<T>>("se3");
  addGroup<SIM3<T>>("sim3");
  addExpLog<SO3<T>>("so3");
  addExpLog<SE3<T>>("se3");
  return 0;
}

const int all_added = addAll<double>() + addAll<float>();

}  // namespace
