#ifndef GSLAM_GEOMETRY_RANDOM_H
#define GSLAM_GEOMETRY_RANDOM_H

#include <gslam/base/error.h>
#include <gslam/geometry/se2.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so2.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

/// @file
/// Random rotations, poses and vectors, for tests, simulations and samplers.
///
/// The generator is the caller's, with the caller's seed: any uniform random bit generator, such as
/// std::mt19937. The distributions are our own, because those of `<random>` differ from one
/// standard library to the next: the same generator gives the same bits everywhere. (But for the
/// last bits where a compiler is told to fuse products and sums, and of normal numbers and scales,
/// which call std::log and std::exp.)

namespace gslam {
inline namespace v1 {
namespace detail {

/// 53 bits of a generator whose numbers may have any range: of each number as many low bits are
/// taken as are evenly distributed; the numbers beyond are thrown away.
template <class Generator>
std::uint64_t random53Bits(Generator& generator) {
  constexpr std::uint64_t low = Generator::min();
  constexpr std::uint64_t range = Generator::max() - low;
  static_assert(range > 0, "the generator gives only one number");
  int bits = 0;
  while (bits < 64 && range >> bits != 0) ++bits;
  const std::uint64_t all = bits == 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << bits) - 1;
  if (range != all) --bits;  // 2^bits numbers of range + 1 are used
  const std::uint64_t last = range != all ? all >> 1 : all;
  std::uint64_t result = 0;
  for (int missing = 53; missing > 0; missing -= bits) {
    std::uint64_t number = generator() - low;
    while (number > last) number = generator() - low;
    const int taken = bits < missing ? bits : missing;
    result = (result << taken) | (number >> (bits - taken));
  }
  return result;
}

/// The points of the unit disc but its centre, evenly.
struct RandomDiscPoint {
  double x, y, square;

  template <class Generator>
  explicit RandomDiscPoint(Generator& generator) {
    do {
      x = symmetric(generator);
      y = symmetric(generator);
      square = x * x + y * y;
    } while (square >= 1 || square < 1e-30);  // so small ones would cost digits
  }

  /// From -1 to 1, without both.
  template <class Generator>
  static double symmetric(Generator& generator) {
    return static_cast<double>(2 * static_cast<std::int64_t>(random53Bits(generator)) + 1 -
                               (std::int64_t(1) << 53)) /
           9007199254740992.0;
  }
};

}  // namespace detail

/// A number from `low` to `high`, evenly distributed.
/// @param generator  gives the bits
/// @param low        least
/// @param high       greatest
/// @throws ArgumentError when a bound is not finite
template <class T, class Generator>
T randomUniform(Generator& generator, T low, T high) {
  if (!std::isfinite(low) || !std::isfinite(high)) {
    throw ArgumentError("bound", "is not finite, expected a range of numbers");
  }
  const double u = 0.5 + 0.5 * detail::RandomDiscPoint::symmetric(generator);
  return static_cast<T>(static_cast<double>(low) * (1 - u) + static_cast<double>(high) * u);
}

/// N independent normal numbers with mean 0 and variance 1. (G. Marsaglia, T. Bray, "A convenient
/// method for generating normal variables", SIAM Review 6(3), 1964)
/// @param generator  gives the bits
template <class T, std::size_t N, class Generator>
Vec<T, N> randomNormal(Generator& generator) {
  Vec<T, N> result;
  for (std::size_t i = 0; i < N; i += 2) {
    const detail::RandomDiscPoint p(generator);
    const double factor = std::sqrt(-2 * std::log(p.square) / p.square);
    result[i] = static_cast<T>(factor * p.x);
    if (i + 1 < N) result[i + 1] = static_cast<T>(factor * p.y);
  }
  return result;
}

/// A point of the unit sphere, evenly distributed. (G. Marsaglia, "Choosing a point from the
/// surface of a sphere", Ann. Math. Stat. 43(2), 1972)
/// @param generator  gives the bits
template <class T, class Generator>
Vec<T, 3> randomDirection(Generator& generator) {
  const detail::RandomDiscPoint p(generator);
  const double factor = 2 * std::sqrt(1 - p.square);
  return {{static_cast<T>(factor * p.x), static_cast<T>(factor * p.y),
           static_cast<T>(1 - 2 * p.square)}};
}

namespace detail {

template <class T, std::size_t N, class Generator>
Vec<T, N> randomInCube(Generator& generator, T reach) {
  Vec<T, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = randomUniform<T>(generator, -reach, reach);
  return result;
}

template <class G>
struct RandomOf;

template <class T>
struct RandomOf<SO2<T>> {
  template <class Generator>
  static SO2<T> draw(Generator& generator) {
    const RandomDiscPoint p(generator);
    return SO2<T>::fromComplex(static_cast<T>((p.x * p.x - p.y * p.y) / p.square),
                               static_cast<T>(2 * p.x * p.y / p.square));
  }
};
// Two points of the disc make one of the sphere in four dimensions, without a transcendental
// function (Marsaglia 1972).
template <class T>
struct RandomOf<SO3<T>> {
  template <class Generator>
  static SO3<T> draw(Generator& generator) {
    const RandomDiscPoint p(generator);
    const RandomDiscPoint q(generator);
    const double factor = std::sqrt((1 - p.square) / q.square);
    return SO3<T>::fromQuaternion(static_cast<T>(p.x), static_cast<T>(p.y),
                                  static_cast<T>(factor * q.x), static_cast<T>(factor * q.y));
  }
};
template <class T>
struct RandomOf<SE2<T>> {
  template <class Generator>
  static SE2<T> draw(Generator& generator, T reach = 1) {
    const SO2<T> rotation = RandomOf<SO2<T>>::draw(generator);
    return SE2<T>(rotation, randomInCube<T, 2>(generator, reach));
  }
};
template <class T>
struct RandomOf<SE3<T>> {
  template <class Generator>
  static SE3<T> draw(Generator& generator, T reach = 1) {
    const SO3<T> rotation = RandomOf<SO3<T>>::draw(generator);
    return SE3<T>(rotation, randomInCube<T, 3>(generator, reach));
  }
};
template <class T>
struct RandomOf<SIM3<T>> {
  template <class Generator>
  static SIM3<T> draw(Generator& generator, T reach = 1, T scale_reach = 2) {
    const SE3<T> rigid = RandomOf<SE3<T>>::draw(generator, reach);
    const T log_scale = std::log(scale_reach);
    return SIM3<T>(rigid, std::exp(randomUniform<T>(generator, -log_scale, log_scale)));
  }
};

}  // namespace detail

/// A random element of a group:
///
///     std::mt19937 generator(7);
///     const auto r = randomOf<SO3d>(generator);
///     const auto t = randomOf<SE3d>(generator, 10.0);
///     const auto s = randomOf<SIM3d>(generator, 10.0, 4.0);
///
/// @param generator  gives the bits
/// @param reach      nothing for SO2 and SO3, whose elements are all equally likely. For SE2 and
///   SE3: the translation is evenly distributed in the cube from -reach to reach (1). For SIM3 in
///   addition a second number: the logarithm of the scale is evenly distributed, the scale from its
///   inverse to it (2)
template <class G, class Generator, class... Reach>
G randomOf(Generator& generator, Reach... reach) {
  return detail::RandomOf<G>::draw(generator, reach...);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_RANDOM_H
