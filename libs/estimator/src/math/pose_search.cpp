#include <algorithm>
#include <cmath>

#include "math/jacobi_eigen.h"
#include "math/pnp_small.h"
#include "math/pose_form.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pnp {
namespace {

// Real roots of a x^4 + b x^3 + ..., and the real parts of complex ones, to about half the digits:
// L. Ferrari's way.
void quarticRoots(const double* coefficient, double* roots) noexcept {
  double largest = 0;
  for (int i = 0; i < 5; ++i) largest = std::max(largest, std::fabs(coefficient[i]));
  double lead = coefficient[0];
  if (std::fabs(lead) < 1e-12 * largest) lead = 1e-12 * largest + 1e-300;
  const double b = coefficient[1] / lead, c = coefficient[2] / lead, d = coefficient[3] / lead,
               e = coefficient[4] / lead;
  const double p = c - 0.375 * b * b;
  const double q = d - 0.5 * b * c + 0.125 * b * b * b;
  const double r = e - 0.25 * b * d + b * b * c / 16 - 3 * b * b * b * b / 256;
  // The greatest root m of m^3 + p m^2 + (p^2 / 4 - r) m - q^2 / 8.
  const double k = 0.25 * p * p - r;
  const double u = (p * p - 3 * k) / 9;
  const double v = (2 * p * p * p - 9 * p * k - 3.375 * q * q) / 54;
  double m;
  if (v * v < u * u * u) {
    const double angle = std::acos(std::min(1.0, std::max(-1.0, v / (u * std::sqrt(u)))));
    // -2 sqrt(u) cos((angle + 2 pi) / 3) is the greatest.
    m = -2 * std::sqrt(u) * std::cos((angle + 6.283185307179586) / 3) - p / 3;
  } else {
    const double a = -std::copysign(std::cbrt(std::fabs(v) + std::sqrt(v * v - u * u * u)), v);
    m = a + (a != 0 ? u / a : 0) - p / 3;
  }
  for (int pass = 0; pass < 2; ++pass) {
    const double slope = (3 * m + 2 * p) * m + k;
    if (slope != 0) m -= (((m + p) * m + k) * m - 0.125 * q * q) / slope;
  }
  const double s = std::sqrt(std::max(0.0, 2 * m));
  for (int i = 0; i < 2; ++i) {
    const double sign = i == 0 ? 1 : -1;
    const double under = s > 0 ? -(2 * p + 2 * m + sign * 2 * q / s)
                               : -2 * p + sign * 2 * std::sqrt(std::max(0.0, p * p - 4 * r));
    const double root = std::sqrt(std::max(0.0, under));
    roots[2 * i] = 0.5 * (sign * s + root) - 0.25 * b;
    roots[2 * i + 1] = 0.5 * (sign * s - root) - 0.25 * b;
  }
}

// An orthonormal frame of a triangle, in columns.
void frameOfTriangle(const double* a, const double* b, const double* c, double* f) noexcept {
  double ab[3], ac[3];
  for (int i = 0; i < 3; ++i) {
    ab[i] = b[i] - a[i];
    ac[i] = c[i] - a[i];
  }
  cross3(ab, ac, f + 6);
  cross3(f + 6, ab, f + 3);
  for (int i = 0; i < 3; ++i) f[i] = ab[i];
  for (int k = 0; k < 3; ++k) {
    const double inverse = 1 / std::sqrt(dot3(f + 3 * k, f + 3 * k));
    for (int i = 0; i < 3; ++i) f[3 * k + i] *= inverse;
  }
}

// First guesses of the rotation from three points (J. Grunert 1841, with the names of R. Haralick
// et al., "Review and analysis of solutions of the three point perspective pose estimation
// problem", IJCV 13(3), 1994). Not exact, and some may be wrong.
int guessFromTriangle(const double (*x)[3], const double (*ray)[3], double (*q)[4]) noexcept {
  double square[3], cosine[3];  // of the side and the angle opposite of point i
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    square[i] = 0;
    for (int e = 0; e < 3; ++e) square[i] += (x[j][e] - x[k][e]) * (x[j][e] - x[k][e]);
    cosine[i] = dot3(ray[j], ray[k]);
  }
  if (!(square[0] > 0 && square[1] > 0 && square[2] > 0)) return 0;
  const double a2 = square[0] / square[1], c2 = square[2] / square[1];
  const double ca = cosine[0], cb = cosine[1], cc = cosine[2];
  const double k = a2 - c2, l = a2 + c2;
  const double coefficient[5] = {
      (k - 1) * (k - 1) - 4 * c2 * ca * ca,
      4 * (k * (1 - k) * cb - (1 - l) * ca * cc + 2 * c2 * ca * ca * cb),
      2 * (k * k - 1 + 2 * k * k * cb * cb + 2 * (1 - c2) * ca * ca - 4 * l * ca * cb * cc +
           2 * (1 - a2) * cc * cc),
      4 * (-k * (1 + k) * cb + 2 * a2 * cc * cc * cb - (1 - l) * ca * cc),
      (1 + k) * (1 + k) - 4 * a2 * cc * cc};
  double roots[4];
  quarticRoots(coefficient, roots);
  double world[9];
  frameOfTriangle(x[0], x[1], x[2], world);
  int count = 0;
  for (const double v : roots) {
    const double below = 1 + v * v - 2 * v * cb;  // (side b / distance of the first)^2
    if (!(v > 0 && below > 0)) continue;
    // The distance of the second over that of the first: of the two that side c allows, the one
    // that fits side a.
    const double root = std::sqrt(std::max(0.0, cc * cc - 1 + c2 * below));
    const auto misfit = [&](double u) {
      return std::fabs(u * u + v * v - 2 * u * v * ca - a2 * below);
    };
    const double u = misfit(cc + root) < misfit(cc - root) ? cc + root : cc - root;
    double y[3][3], camera[9], r[9];
    for (int e = 0; e < 3; ++e) {
      y[0][e] = ray[0][e];
      y[1][e] = u * ray[1][e];
      y[2][e] = v * ray[2][e];
    }
    frameOfTriangle(y[0], y[1], y[2], camera);
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        r[3 * j + i] =
            camera[i] * world[j] + camera[3 + i] * world[3 + j] + camera[6 + i] * world[6 + j];
      }
    }
    if (!std::isfinite(dot3(r, r) + dot3(r + 3, r + 3) + dot3(r + 6, r + 6))) continue;
    quaternionOfColumns(r, q[count++]);
  }
  return count;
}

// The 60 rotations of an icosahedron: no rotation is farther than 45 degrees from the next one.
struct RotationGrid {
  double q[60][4];

  RotationGrid() noexcept {
    int count = 0;
    const auto add = [&](double a, double b, double c, double d) {
      double* const to = q[count++];
      to[0] = a, to[1] = b, to[2] = c, to[3] = d;
    };
    for (int i = 0; i < 4; ++i) add(i == 0, i == 1, i == 2, i == 3);
    for (int signs = 0; signs < 8; ++signs) {
      add(signs & 1 ? 0.5 : -0.5, signs & 2 ? 0.5 : -0.5, signs & 4 ? 0.5 : -0.5, 0.5);
    }
    // Even permutations of (0, 1 / phi, 1, phi) / 2, one of q and -q.
    static const int kEven[12][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 0, 3, 2},
                                     {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 0, 1, 3}, {2, 1, 3, 0},
                                     {2, 3, 0, 1}, {3, 0, 2, 1}, {3, 1, 0, 2}, {3, 2, 1, 0}};
    const double phi = 0.5 * (1 + std::sqrt(5.0));
    for (const auto& places : kEven) {
      for (int signs = 0; signs < 4; ++signs) {
        const double value[4] = {0, signs & 1 ? 0.5 / phi : -0.5 / phi, signs & 2 ? 0.5 : -0.5,
                                 0.5 * phi};
        double p[4];
        for (int i = 0; i < 4; ++i) p[places[i]] = value[i];
        add(p[0], p[1], p[2], p[3]);
      }
    }
  }
  static const RotationGrid& get() noexcept {
    static const RotationGrid grid;
    return grid;
  }
};

// By insertion.
template <class T, class Before>
void sortFew(T* first, std::size_t count, Before is_before) noexcept {
  for (std::size_t i = 1; i < count; ++i) {
    const T value = first[i];
    std::size_t place = i;
    for (; place > 0 && is_before(value, first[place - 1]); --place)
      first[place] = first[place - 1];
    first[place] = value;
  }
}

// A first guess and its cost.
struct PoseStart {
  double q[4];
  double cost;
};

// What is known while minima are looked for.
class PoseSearch {
 public:
  // Whether nothing, the least minimum, or all minima worth giving are found for sure.
  enum class Certainty { kNone, kBest, kAll };

  PoseSearch(const Rays& rays, const PoseFrame& frame, const PoseForm& form) noexcept
      : rays_(rays), frame_(frame), form_(form) {}

  // Descends from q, and keeps what is new.
  void descendFrom(const double* start) noexcept {
    FramePose pose;
    std::copy(start, start + 4, pose.q);
    pose.cost = descend(form_, pose.q);
    double r[9];
    columnsOfQuaternion(pose.q, r);
    if (!(form_.meanDepth(r) > 0) || !std::isfinite(pose.cost)) return;
    form_.translationOf(r, pose.t);
    insert(pose);
  }

  // Descends from the best of the starts.
  void descendFromBest(PoseStart* starts, std::size_t count, std::size_t most) noexcept {
    sortFew(starts, count, [](const PoseStart& a, const PoseStart& b) { return a.cost < b.cost; });
    for (std::size_t i = 0; i < std::min(most, count); ++i) descendFrom(starts[i].q);
  }

  // Puts a start where it belongs, if the points are before the camera.
  bool rate(const double* q, PoseStart& start) const noexcept {
    double r[9];
    columnsOfQuaternion(q, r);
    if (!(form_.meanDepth(r) > 0)) return false;
    std::copy(q, q + 4, start.q);
    start.cost = form_.cost(r);
    return true;
  }

  void searchGrid(std::size_t most) noexcept {
    PoseStart starts[60];
    std::size_t count = 0;
    for (const auto& q : RotationGrid::get().q) {
      if (rate(q, starts[count])) ++count;
    }
    descendFromBest(starts, count, most);
  }

  void searchTriangles(std::size_t most) noexcept;
  Certainty searchRelaxed() noexcept;
  void searchMirrored() noexcept;

  std::size_t finish(Span<SE3d> poses);

  std::size_t count() const noexcept { return count_; }
  double bestCost() const noexcept { return minima_[0].cost; }

 private:
  static constexpr std::size_t kMost = 8;

  // Whether one of the first minima is the same.
  bool isKnown(const FramePose& pose, std::size_t first) const noexcept {
    for (std::size_t i = 0; i < first; ++i) {
      double cosine = 0;
      for (int k = 0; k < 4; ++k) cosine += pose.q[k] * minima_[i].q[k];
      if (std::fabs(cosine) > 1 - 1e-9) return true;
    }
    return false;
  }

  void insert(const FramePose& pose) noexcept {
    if (isKnown(pose, count_)) return;
    std::size_t place = count_;
    while (place > 0 && minima_[place - 1].cost > pose.cost) --place;
    if (place == kMost) return;
    count_ = std::min(count_ + 1, kMost);
    for (std::size_t i = count_ - 1; i > place; --i) minima_[i] = minima_[i - 1];
    minima_[place] = pose;
  }

  const Rays& rays_;
  const PoseFrame& frame_;
  const PoseForm& form_;
  FramePose minima_[kMost];
  std::size_t count_ = 0;
};

// Of the cost as the form gives it, rounding included.
constexpr double kCostOfExactForm = 1e-14;
// Costs below are rounding: the root mean square residual is 1e-8 of the size of the scene.
constexpr double kCostOfRounding = 1e-16;
// Square of a distance of (c1, c2), of square 2, within which there is one minimum.
constexpr double kSafeSquare = 0.2;
// Other minima are given up to this multiple of the least.
constexpr double kCostOfOthers = 4;

// Guesses from triples of points, large ones first.
void PoseSearch::searchTriangles(std::size_t most) noexcept {
  constexpr std::size_t kPoints = 5;
  const std::size_t n = std::min(rays_.size(), kPoints);
  double x[kPoints][3], b[kPoints][3];
  for (std::size_t i = 0; i < n; ++i) {
    double unused[3];
    frame_.load(rays_, i * rays_.size() / n, x[i], b[i], unused);
  }
  struct Triple {
    std::size_t i, j, k;
    double size;
  };
  Triple triples[10];
  std::size_t triple_count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        double u[3], v[3], w[3];
        for (int e = 0; e < 3; ++e) {
          u[e] = x[j][e] - x[i][e];
          v[e] = x[k][e] - x[i][e];
        }
        cross3(u, v, w);
        triples[triple_count++] = {i, j, k, dot3(w, w)};
      }
    }
  }
  sortFew(triples, triple_count, [](const Triple& a, const Triple& c) { return a.size > c.size; });
  PoseStart starts[40];
  std::size_t count = 0;
  const std::size_t used = std::min<std::size_t>(triple_count, n == 3 ? 1 : most);
  const int turns = n == 3 ? 3 : 1;
  for (std::size_t t = 0; t < used; ++t) {
    const std::size_t corner[3] = {triples[t].i, triples[t].j, triples[t].k};
    for (int first = 0; first < turns; ++first) {
      double xs[3][3], bs[3][3], q[4][4];
      for (int e = 0; e < 3; ++e) {
        std::copy(x[corner[(e + first) % 3]], x[corner[(e + first) % 3]] + 3, xs[e]);
        std::copy(b[corner[(e + first) % 3]], b[corner[(e + first) % 3]] + 3, bs[e]);
      }
      const int guesses = guessFromTriangle(xs, bs, q);
      for (int g = 0; g < guesses; ++g) {
        if (rate(q[g], starts[count])) ++count;
      }
    }
  }
  descendFromBest(starts, count, n == 3 ? 12 : 5);
}

// The least cost where (c1, c2), x below, need only have length sqrt(2), and c3 is free: a bound
// from below that is reached without guessing, sharp for exact data. That c3 is free makes it right
// for planes, too, of which c3 is the normal.
class RelaxedForm {
 public:
  explicit RelaxedForm(const PoseForm& form) noexcept : form_(form) {
    eliminateNormal();
    double m[6][6];
    for (int i = 0; i < 6; ++i) std::copy(reduced_[i], reduced_[i] + 6, m[i]);
    const JacobiEigen<6> eigen(m);
    double pull[6];
    double trace = 0, pulls = 0;
    for (int i = 0; i < 6; ++i) {
      pull[i] = 0;
      for (int k = 0; k < 6; ++k) pull[i] += eigen.vectors[i][k] * reduced_linear_[k];
      trace += eigen.values[i];
      pulls += pull[i] * pull[i];
    }
    bool is_central = pulls == 0;
    if (is_central) {
      shift_ = -eigen.values[0];
    } else {
      if (std::fabs(pull[0]) < 1e-12 * trace) pull[0] = std::copysign(1e-12 * trace, pull[0]);
      shift_ = secularRoot(eigen.values, pull);
    }
    double y[6], flipped[6];
    for (int i = 0; i < 6; ++i) {
      y[i] = is_central ? (i == 0 ? std::sqrt(2.0) : 0) : -pull[i] / (eigen.values[i] + shift_);
      flipped[i] = i == 0 ? -y[i] : y[i];
    }
    cost_ = constant_;
    for (int i = 0; i < 6; ++i) cost_ += y[i] * (eigen.values[i] * y[i] + 2 * pull[i]);
    stiffness_[0] = eigen.values[0] + shift_;
    stiffness_[1] = eigen.values[1] + shift_;
    complete(eigen, y, r_[0]);
    complete(eigen, flipped, r_[1]);
  }

  // The place of the least cost, and the one beyond the flattest direction. Not rotations.
  const double* place(int which) const noexcept { return r_[which]; }
  double cost() const noexcept { return cost_; }
  // The cost grows by this times the square of the distance (times more, for the second, where the
  // way is not along the flattest direction).
  double stiffness(int which) const noexcept { return stiffness_[which]; }

 private:
  void eliminateNormal() noexcept {
    constexpr std::size_t kStride = PoseForm::kStride;
    double normal[3][3];
    double b[7][3];  // omega(c3, c1 c2), linear(c3)
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) normal[i][k] = form_.omega[kStride * (6 + i) + 6 + k];
      for (std::size_t k = 0; k < 6; ++k) b[k][i] = form_.omega[kStride * (6 + i) + k];
      b[6][i] = form_.linear[6 + i];
    }
    for (int k = 0; k < 7; ++k) std::copy(b[k], b[k] + 3, normal_[k]);
    double all = 0;
    for (std::size_t i = 0; i < 9; ++i) all += form_.omega[kStride * i + i];
    const double trace = normal[0][0] + normal[1][1] + normal[2][2];
    (void)solveSymmetric<3, 7>(normal, std::max(1e-13 * all, 1e-12 * trace), normal_);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t k = 0; k < 6; ++k) {
        reduced_[i][k] = form_.omega[kStride * i + k] - dot3(b[i], normal_[k]);
      }
      reduced_linear_[i] = form_.linear[i] - dot3(b[i], normal_[6]);
    }
    constant_ = form_.constant - dot3(b[6], normal_[6]);
  }

  // The shift s > -values[0] with sum (pull / (values + s))^2 = 2, by Newton's method on the
  // inverse of the length, which comes from the left and never goes past. (J. More, D. Sorensen,
  // "Computing a trust region step", SIAM J. Sci. Stat. Comput. 4(3), 1983)
  static double secularRoot(const double* values, const double* pull) noexcept {
    double s = std::fabs(pull[0]) / std::sqrt(2.0) - values[0];
    for (int iteration = 0; iteration < 20; ++iteration) {
      double length = 0, slope = 0;
      for (int i = 0; i < 6; ++i) {
        const double inverse = 1 / (values[i] + s);
        const double square = pull[i] * pull[i] * inverse * inverse;
        length += square;
        slope += square * inverse;
      }
      const double step = (std::sqrt(0.5 * length) - 1) * length / slope;
      s += step;
      if (!(step > 1e-10 * (s + values[0]))) break;
    }
    return s;
  }

  void complete(const JacobiEigen<6>& eigen, const double* y, double* r) const noexcept {
    for (int k = 0; k < 6; ++k) {
      r[k] = 0;
      for (int i = 0; i < 6; ++i) r[k] += y[i] * eigen.vectors[i][k];
    }
    for (int i = 0; i < 3; ++i) {
      r[6 + i] = -normal_[6][i];
      for (int k = 0; k < 6; ++k) r[6 + i] -= normal_[k][i] * r[k];
    }
  }

  const PoseForm& form_;
  double normal_[7][3];  // omega(c3, c3)^-1 (omega(c3, c1 c2), linear(c3))
  double reduced_[6][6];
  double reduced_linear_[6];
  double constant_;
  double shift_;
  double stiffness_[2];
  double cost_;
  double r_[2][9];
};

// Guesses by the relaxed form: whatever costs less than the least cost found, or little more, lies
// next to one of its two places.
PoseSearch::Certainty PoseSearch::searchRelaxed() noexcept {
  const RelaxedForm relaxed(form_);
  for (int which = 0; which < 2; ++which) {
    double r[9], q[4];
    if (!(form_.meanDepth(relaxed.place(which)) > 0)) continue;
    if (!rotationOfTwoColumns(relaxed.place(which), r)) continue;
    quaternionOfColumns(r, q);
    descendFrom(q);
    if (count_ == 0) continue;
    const double excess = kCostOfOthers * bestCost() - relaxed.cost();
    if (excess < kSafeSquare * relaxed.stiffness(0)) return Certainty::kAll;
  }
  if (count_ == 0) return Certainty::kNone;
  const double safe = relaxed.cost() + kSafeSquare * relaxed.stiffness(1);
  if (kCostOfOthers * bestCost() < safe) return Certainty::kAll;
  return bestCost() < safe ? Certainty::kBest : Certainty::kNone;
}

// The other minimum of flat scenes seen from afar: mirrored by a plane orthogonal to the line of
// sight. (G. Schweighofer, A. Pinz, "Robust pose estimation from a planar target", PAMI 28(12),
// 2006)
void PoseSearch::searchMirrored() noexcept {
  if (count_ == 0) return;
  const FramePose best = minima_[0];
  const double length = std::sqrt(dot3(best.t, best.t));
  if (!(length > 0)) return;
  double r[9], mirrored[9], q[4];
  columnsOfQuaternion(best.q, r);
  for (int j = 0; j < 6; j += 3) {
    const double along = 2 * dot3(r + j, best.t) / (length * length);
    for (int i = 0; i < 3; ++i) mirrored[j + i] = r[j + i] - along * best.t[i];
  }
  cross3(mirrored, mirrored + 3, mirrored + 6);
  quaternionOfColumns(mirrored, q);
  descendFrom(q);
}

std::size_t PoseSearch::finish(Span<SE3d> poses) {
  for (std::size_t i = 0; i < count_; ++i) polish(rays_, frame_, minima_[i]);
  sortFew(minima_, count_, [](const FramePose& a, const FramePose& b) { return a.cost < b.cost; });
  std::size_t given = 0;
  for (std::size_t i = 0; i < count_ && given < poses.size(); ++i) {
    const FramePose& pose = minima_[i];
    if (!(pose.cost <= kCostOfOthers * minima_[0].cost + kCostOfRounding)) break;
    if (isKnown(pose, i)) continue;  // two came together
    if (frame_.setPose(pose.q, pose.t, poses[given])) ++given;
  }
  return given;
}

}  // namespace

std::size_t solvePose(const Rays& rays, Span<SE3d> poses) {
  PoseFrame frame;
  PoseForm form;
  if (!frame.set(rays) || !frame.isWide()) return 0;
  if (!form.set(rays, frame)) return 0;
  PoseSearch search(rays, frame, form);
  const bool is_central = rays.origins.empty();
  const bool is_few = rays.size() < 6;
  // Few points of a camera leave the relaxed form undetermined.
  using Certainty = PoseSearch::Certainty;
  const Certainty certainty = is_central && is_few ? Certainty::kNone : search.searchRelaxed();
  if (certainty == Certainty::kBest) search.searchMirrored();
  if (certainty == Certainty::kNone) {
    if (is_central) search.searchTriangles(4);
    const bool is_exact = search.count() > 0 && search.bestCost() < kCostOfExactForm;
    if (!is_exact || rays.size() == 3) {
      search.searchMirrored();
      if (!is_central || search.count() == 0) search.searchGrid(rays.size() == 4 ? 12 : 8);
    }
  }
  return search.finish(poses);
}

}  // namespace pnp
}  // namespace detail
}  // namespace v1
}  // namespace gslam
