// What all batches have in common: any number of elements, at any address, in place or not, in rows
// or in columns, gives the results of the classes, and in every place the same bits. Each operation
// is a type with First, Second, Result, one() and many().
#ifndef GSLAM_GEOMETRY_TESTS_BATCH_PLACES_H
#define GSLAM_GEOMETRY_TESTS_BATCH_PLACES_H

#include <gslam/geometry/batch.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "reference.h"

namespace batch_places {

using gslam::ArraysOf;
using gslam::SE3;
using gslam::SIM3;
using gslam::SO3;
using gslam::Span;
using gslam::Vec;

// Elements of every kind. Angles from 0 to beyond half a turn, both signs of quaternions.

template <class T>
Vec<T, 3> someVector(reference::Random<T>& random) {
  return random.uniform(T(-3), T(3)) * random.direction();
}
template <class T>
void fill(reference::Random<T>& random, Vec<T, 3>& v) {
  v = someVector(random);
  if (random.uniform(T(0), T(20)) < 1) v *= T(3);
  if (random.uniform(T(0), T(20)) < 1) v *= T(0);
}
template <class T>
void fill(reference::Random<T>& random, Vec<T, 6>& v) {
  Vec<T, 3> turn;
  fill(random, turn);
  v.setSegment(0, someVector(random));
  v.setSegment(3, turn);
}
template <class T>
void fill(reference::Random<T>& random, Vec<T, 7>& v) {
  Vec<T, 6> rigid;
  fill(random, rigid);
  v.setSegment(0, rigid);
  v[6] = random.uniform(T(-2), T(2));
}
template <class T>
void fill(reference::Random<T>& random, SO3<T>& r) {
  r = SO3<T>::exp(T(2) * someVector(random));  // beyond pi w is below 0
  if (random.uniform(T(0), T(20)) < 1) r = SO3<T>::exp(Vec<T, 3>{});
}
template <class T>
void fill(reference::Random<T>& random, SE3<T>& t) {
  SO3<T> r;
  fill(random, r);
  t = SE3<T>(r, someVector(random));
}
template <class T>
void fill(reference::Random<T>& random, SIM3<T>& s) {
  SE3<T> t;
  fill(random, t);
  s = SIM3<T>(t, random.uniform(T(0.3), T(3)));
}

template <class E>
std::vector<E> someElements(std::size_t n, unsigned seed) {
  reference::Random<typename gslam::detail::ElementFacts<E>::Scalar> random(seed);
  std::vector<E> elements(n);
  for (E& e : elements) fill(random, e);
  return elements;
}

// Of numbers that are not NaN.
template <class E>
bool sameBits(const E& a, const E& b) {
  for (std::size_t k = 0; k < gslam::detail::ElementFacts<E>::kNumbers; ++k) {
    const auto x = a.data()[k];
    const auto y = b.data()[k];
    if (!(x == y) || std::signbit(x) != std::signbit(y)) return false;
  }
  return true;
}

// Elements in columns, one of which begins at an odd address (as numbers go).
template <class E>
class Table {
 public:
  using T = typename gslam::detail::ElementFacts<E>::Scalar;
  static constexpr std::size_t kNumbers = gslam::detail::ElementFacts<E>::kNumbers;

  explicit Table(const std::vector<E>& rows)
      : size_(rows.size()), numbers_(kNumbers * (size_ + 1)) {
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t k = 0; k < kNumbers; ++k) column(k)[i] = rows[i].data()[k];
    }
  }
  std::vector<E> rows() const {
    std::vector<E> result(size_);
    for (std::size_t i = 0; i < size_; ++i) {
      T element[kNumbers];
      for (std::size_t k = 0; k < kNumbers; ++k) {
        element[k] = numbers_[k * (size_ + 1) + i];
      }
      std::memcpy(static_cast<void*>(&result[i]), element, sizeof(E));
    }
    return result;
  }
  ArraysOf<E> view(std::size_t begin, std::size_t n) {
    T* first[kNumbers];
    for (std::size_t k = 0; k < kNumbers; ++k) first[k] = column(k) + begin;
    return ArraysOf<E>(first, n);
  }

 private:
  T* column(std::size_t k) { return numbers_.data() + k * (size_ + 1); }

  std::size_t size_;
  std::vector<T> numbers_;
};

constexpr std::size_t kAll = 1100;

// The results of [begin, begin + n) alone, all else left as it was.
template <class Op>
std::vector<typename Op::Result> fromRows(std::vector<typename Op::First> a,
                                          std::vector<typename Op::Second> b,
                                          std::vector<typename Op::Result> out, std::size_t begin,
                                          std::size_t n) {
  Op::many(Span<const typename Op::First>(a).subspan(begin, n),
           Span<const typename Op::Second>(b).subspan(begin, n),
           Span<typename Op::Result>(out).subspan(begin, n));
  return out;
}
template <class Op>
std::vector<typename Op::Result> fromColumns(const std::vector<typename Op::First>& a,
                                             const std::vector<typename Op::Second>& b,
                                             const std::vector<typename Op::Result>& out,
                                             std::size_t begin, std::size_t n) {
  Table<typename Op::First> table_a(a);
  Table<typename Op::Second> table_b(b);
  Table<typename Op::Result> table_out(out);
  Op::many(ArraysOf<const typename Op::First>(table_a.view(begin, n)),
           ArraysOf<const typename Op::Second>(table_b.view(begin, n)), table_out.view(begin, n));
  return table_out.rows();
}

template <class Op>
class Batch : public testing::Test {
 public:
  using Scalar = typename gslam::detail::ElementFacts<typename Op::Result>::Scalar;

  std::vector<typename Op::First> a = someElements<typename Op::First>(kAll, 1);
  std::vector<typename Op::Second> b = someElements<typename Op::Second>(kAll, 2);
  std::vector<typename Op::Result> before = someElements<typename Op::Result>(kAll, 3);

  // Elements outside [begin, begin + n) are those before, those inside have the bits of `all`.
  void expectPart(const std::vector<typename Op::Result>& actual,
                  const std::vector<typename Op::Result>& all, std::size_t begin, std::size_t n,
                  const char* what) const {
    for (std::size_t i = 0; i < kAll; ++i) {
      const bool is_inside = i >= begin && i < begin + n;
      ASSERT_TRUE(sameBits(actual[i], is_inside ? all[i] : before[i]))
          << what << ", element " << i << " of " << begin << " + " << n;
    }
  }
};
TYPED_TEST_SUITE_P(Batch);

TYPED_TEST_P(Batch, GivesWhatTheClassesGive) {
  using Op = TypeParam;
  using T = typename TestFixture::Scalar;
  double worst = 0;
  for (const gslam::Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd forced(variant);
    const auto actual = fromRows<Op>(this->a, this->b, this->before, 0, kAll);
    for (std::size_t i = 0; i < kAll; ++i) {
      const typename Op::Result expected = Op::one(this->a[i], this->b[i]);
      double size = 1;
      for (std::size_t k = 0; k < sizeof(expected) / sizeof(T); ++k) {
        size = std::max(size, std::fabs(static_cast<double>(expected.data()[k])));
      }
      for (std::size_t k = 0; k < sizeof(expected) / sizeof(T); ++k) {
        const double error = std::fabs(static_cast<double>(actual[i].data()[k]) -
                                       static_cast<double>(expected.data()[k])) /
                             size / static_cast<double>(std::numeric_limits<T>::epsilon());
        ASSERT_LE(error, 20) << simdName(variant) << ", element " << i << ": " << actual[i]
                             << ", expected " << expected;
        worst = std::max(worst, error);
      }
    }
  }
  this->RecordProperty("worst_in_epsilons", std::to_string(worst));
}

TYPED_TEST_P(Batch, GivesTheSameBitsForAnyNumberInAnyPlace) {
  using Op = TypeParam;
  for (const gslam::Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd forced(variant);
    const auto all = fromRows<Op>(this->a, this->b, this->before, 0, kAll);
    const auto all_columns = fromColumns<Op>(this->a, this->b, this->before, 0, kAll);
    this->expectPart(all_columns, all, 0, kAll, "columns");
    for (std::size_t n = 0; n <= 70; ++n) {
      const std::size_t begin = 13 * n % 100;
      this->expectPart(fromRows<Op>(this->a, this->b, this->before, begin, n), all, begin, n,
                       "rows");
      this->expectPart(fromColumns<Op>(this->a, this->b, this->before, begin, n), all, begin, n,
                       "columns");
    }
  }
}

TYPED_TEST_P(Batch, WorksInPlace) {
  using Op = TypeParam;
  for (const gslam::Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd forced(variant);
    const auto all = fromRows<Op>(this->a, this->b, this->before, 0, kAll);
    for (const std::size_t n : {std::size_t(5), std::size_t(64), kAll}) {
      const auto rows = Op::inPlaceOfRows(this->a, this->b, n);
      const auto columns = Op::inPlaceOfColumns(this->a, this->b, n);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_TRUE(sameBits(rows[i], all[i]))
            << simdName(variant) << " rows, " << i << " of " << n;
        ASSERT_TRUE(sameBits(columns[i], all[i])) << simdName(variant) << " columns, " << i;
      }
    }
  }
}

REGISTER_TYPED_TEST_SUITE_P(Batch, GivesWhatTheClassesGive, GivesTheSameBitsForAnyNumberInAnyPlace,
                            WorksInPlace);

// The operations. Those whose result is of another type than their inputs are never in place.

template <class A, class B, class C>
struct NeverInPlace {
  using First = A;
  using Second = B;
  using Result = C;
  static std::vector<C> inPlaceOfRows(const std::vector<A>&, const std::vector<B>&, std::size_t) {
    return {};
  }
  static std::vector<C> inPlaceOfColumns(const std::vector<A>&, const std::vector<B>&,
                                         std::size_t) {
    return {};
  }
};

// The result takes the place of the second input.
template <class Op, class A, class B>
struct InPlaceOfSecond {
  using First = A;
  using Second = B;
  using Result = B;
  static std::vector<B> inPlaceOfRows(const std::vector<A>& a, std::vector<B> b, std::size_t n) {
    const Span<B> part = Span<B>(b).first(n);
    Op::many(Span<const A>(a).first(n), Span<const B>(part), part);
    b.resize(n);
    return b;
  }
  static std::vector<B> inPlaceOfColumns(const std::vector<A>& a, const std::vector<B>& b,
                                         std::size_t n) {
    Table<A> table_a(a);
    Table<B> table_b(b);
    const ArraysOf<B> part = table_b.view(0, n);
    Op::many(ArraysOf<const A>(table_a.view(0, n)), ArraysOf<const B>(part), part);
    std::vector<B> rows = table_b.rows();
    rows.resize(n);
    return rows;
  }
};

template <class G>
struct Exp : NeverInPlace<typename G::Tangent, typename G::Tangent, G> {
  static G one(const typename G::Tangent& a, const typename G::Tangent&) { return G::exp(a); }
  template <class A, class B, class C>
  static void many(const A& a, const B&, const C& out) {
    gslam::expMany<G>(a, out);
  }
};

template <class G>
struct Log : NeverInPlace<G, G, typename G::Tangent> {
  static typename G::Tangent one(const G& a, const G&) { return a.log(); }
  template <class A, class B, class C>
  static void many(const A& a, const B&, const C& out) {
    gslam::logMany<G>(a, out);
  }
};

template <class G>
struct Inverse : InPlaceOfSecond<Inverse<G>, G, G> {
  static G one(const G&, const G& b) { return b.inverse(); }
  template <class A, class B, class C>
  static void many(const A&, const B& b, const C& out) {
    gslam::inverseMany<G>(b, out);
  }
};

template <class G>
struct Compose : InPlaceOfSecond<Compose<G>, G, G> {
  static G one(const G& a, const G& b) { return a * b; }
  template <class A, class B, class C>
  static void many(const A& a, const B& b, const C& out) {
    gslam::composeMany<G>(a, b, out);
  }
};

template <class G>
struct Points : InPlaceOfSecond<Points<G>, G, typename G::Point> {
  static typename G::Point one(const G& a, const typename G::Point& b) { return a * b; }
  template <class A, class B, class C>
  static void many(const A& a, const B& b, const C& out) {
    gslam::transformPoints<G>(a, b, out);
  }
};

// One transform for all.
template <class G>
struct Cloud : InPlaceOfSecond<Cloud<G>, G, typename G::Point> {
  static const G& transform() {
    static const G g = someElements<G>(1, 4)[0];
    return g;
  }
  static typename G::Point one(const G&, const typename G::Point& b) { return transform() * b; }
  template <class A, class B, class C>
  static void many(const A&, const B& b, const C& out) {
    gslam::transformPoints(transform(), b, out);
  }
};

template <class G>
using Operations = testing::Types<Exp<G>, Log<G>, Inverse<G>, Compose<G>, Points<G>, Cloud<G>>;

}  // namespace batch_places

#endif  // GSLAM_GEOMETRY_TESTS_BATCH_PLACES_H
