// The random elements that all peers work on, and what is right about them: computed here, in long
// double, from power series alone, so that neither we nor a peer are our own judge.
#ifndef GSLAM_BENCH_GEOMETRY_PEERS_ELEMENTS_H
#define GSLAM_BENCH_GEOMETRY_PEERS_ELEMENTS_H

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

/// Before the functions with which a peer does an operation, so that a call of them is not
/// measured. What they call is inlined or not as it would be in a user's program.
#if defined(__GNUC__) || defined(__clang__)
#define BENCH_INLINE __attribute__((always_inline))
#else
#define BENCH_INLINE
#endif

constexpr std::size_t kElements = 1024;

/// Which of the seven numbers of a tangent (translation, rotation, log scale) a group has.
struct So3 {
  static constexpr const char* kGroup = "so3";
  static constexpr std::size_t kFirst = 3, kSize = 3;
};
struct Se3 {
  static constexpr const char* kGroup = "se3";
  static constexpr std::size_t kFirst = 0, kSize = 6;
};
struct Sim3 {
  static constexpr const char* kGroup = "sim3";
  static constexpr std::size_t kFirst = 0, kSize = 7;
};

using Xyz = std::array<double, 3>;
template <std::size_t N>
using Square = std::array<std::array<long double, N>, N>;

/// The sum of a^k / (k + offset)! over k = 0, 1, ...: the exponential of `a` where offset is 0, the
/// left Jacobian where it is 1 and `a` is the adjoint of a tangent. 80 terms are enough for what is
/// drawn below, whose norm is about 10.
template <std::size_t N>
Square<N> series(const Square<N>& a, int offset) {
  Square<N> term{};
  for (std::size_t i = 0; i < N; ++i) term[i][i] = 1;
  Square<N> sum = term;
  for (int k = 1; k < 80; ++k) {
    Square<N> next{};
    for (std::size_t r = 0; r < N; ++r) {
      for (std::size_t c = 0; c < N; ++c) {
        for (std::size_t i = 0; i < N; ++i) next[r][c] += term[r][i] * a[i][c] / (k + offset);
        sum[r][c] += next[r][c];
      }
    }
    term = next;
  }
  return sum;
}

/// Writes the matrix of `w x` into `to`, from this row and column.
template <std::size_t N>
void setCross(const double* w, std::size_t row, std::size_t column, Square<N>& to) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    to[row + k][column + j] = w[i];
    to[row + j][column + k] = -w[i];
  }
}

/// One element in numbers: a peer makes its own from the part that it likes.
struct Element {
  std::array<double, 7> tangent;     ///< translation, rotation vector, logarithm of the scale
  std::array<double, 4> quaternion;  ///< x y z w
  std::array<double, 9> rotation;    ///< the rotation matrix, row by row
  Xyz translation;
  double scale;

  /// What the element does to a point.
  Xyz operator*(const Xyz& p) const {
    Xyz result = translation;
    for (std::size_t i = 0; i < 9; ++i) result[i / 3] += scale * rotation[i] * p[i % 3];
    return result;
  }

  /// The 6 x 6 left Jacobian of SE3 at the tangent.
  Square<6> leftJacobian() const {
    Square<6> adjoint{};
    setCross(tangent.data() + 3, 0, 0, adjoint);
    setCross(tangent.data(), 0, 3, adjoint);
    setCross(tangent.data() + 3, 3, 3, adjoint);
    return series(adjoint, 1);
  }
};

inline Element elementOf(const std::array<double, 7>& tangent) {
  Square<4> generator{};
  setCross(tangent.data() + 3, 0, 0, generator);
  for (std::size_t i = 0; i < 3; ++i) {
    generator[i][3] = tangent[i];
    generator[i][i] = tangent[6];
  }
  const Square<4> transform = series(generator, 0);
  Element e{tangent, {}, {}, {}, std::exp(tangent[6])};
  for (std::size_t i = 0; i < 9; ++i) {
    e.rotation[i] = static_cast<double>(transform[i / 3][i % 3] /
                                        std::exp(static_cast<long double>(tangent[6])));
  }
  const double angle = std::hypot(tangent[3], tangent[4], tangent[5]);
  for (std::size_t i = 0; i < 3; ++i) {
    e.translation[i] = static_cast<double>(transform[i][3]);
    e.quaternion[i] = std::sin(0.5 * angle) / angle * tangent[3 + i];
  }
  e.quaternion[3] = std::cos(0.5 * angle);
  return e;
}

/// Rotation vectors evenly in the ball of radius pi, translations of deviation 1 along each axis,
/// logarithms of the scale of deviation 0.3.
template <class Kind>
std::vector<Element> randomElements(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-3.14159, 3.14159);
  std::normal_distribution<double> normal;
  std::vector<Element> elements;
  while (elements.size() < kElements) {
    std::array<double, 7> tangent{};
    for (std::size_t i = 3; i < 6; ++i) tangent[i] = uniform(random);
    if (std::hypot(tangent[3], tangent[4], tangent[5]) > 3.14159) continue;
    for (std::size_t i = Kind::kFirst; i < 3; ++i) tangent[i] = normal(random);
    if (Kind::kSize == 7) tangent[6] = 0.3 * normal(random);
    elements.push_back(elementOf(tangent));
  }
  return elements;
}

inline std::vector<Xyz> randomPoints(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Xyz> points(kElements);
  for (Xyz& point : points) {
    for (double& coordinate : point) coordinate = normal(random);
  }
  return points;
}

#endif  // GSLAM_BENCH_GEOMETRY_PEERS_ELEMENTS_H
