#include "robust/plane_parallax.h"

#include <algorithm>
#include <cmath>

#include "robust/random_bits.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

constexpr std::size_t kSamples = 40;  // samples of three; enough where half is on the plane
constexpr std::size_t kTested = 150;  // matches that a sample is tested with

// v of three rays and what it has to be there.
bool solvePlane(const Vec3d* rays, const double* depths, Vec3d& plane) {
  const Vec3d ab = rays[0].cross(rays[1]), bc = rays[1].cross(rays[2]), ca = rays[2].cross(rays[0]);
  const double determinant = rays[0].dot(bc);
  const double size = rays[0].norm() * rays[1].norm() * rays[2].norm();
  if (!(std::abs(determinant) > 1e-9 * size)) return false;
  plane = (depths[0] * bc + depths[1] * ca + depths[2] * ab) / determinant;
  return true;
}

// Least squares over all matches that agree so far.
void polish(const EpipolarMatches& matches, const HomographyFamily& family,
            const std::vector<std::uint32_t>& indices, double largest, PlaneFit& fit) {
  Mat3d normal{};
  Vec3d right{};
  for (const std::uint32_t i : indices) {
    if (!(matches.transferSquared(fit.homography, fit.inverse, i) <= largest)) continue;
    const Vec3d ray = matches.first(i);
    double depth;
    if (!family.inverseDepth(ray, matches.second(i), depth)) continue;
    normal += outer(ray, ray);
    right += depth * ray;
  }
  Mat3d inverse;
  if (!invert(normal, inverse)) return;
  PlaneFit polished;
  polished.plane = inverse * right;
  polished.homography = family.homography(polished.plane);
  if (!invert(polished.homography, polished.inverse)) return;
  for (const std::uint32_t i : indices) {
    polished.on_plane +=
        matches.transferSquared(polished.homography, polished.inverse, i) <= largest;
  }
  polished.is_found = true;
  if (polished.on_plane >= fit.on_plane) fit = polished;
}

}  // namespace

bool HomographyFamily::inverseDepth(const Vec3d& first, const Vec3d& second, double& depth) const {
  const Vec3d side = second.cross(epipole);
  const double square = side.squaredNorm();
  if (!(square > 1e-12 * second.squaredNorm() * epipole.squaredNorm())) return false;
  depth = -side.dot(second.cross(base * first)) / square;
  return std::isfinite(depth);
}

Mat3d HomographyFamily::homography(const Vec3d& plane) const {
  return base + outer(epipole, plane);
}

bool invert(const Mat3d& m, Mat3d& inverse) {
  const Vec3d a = m.row(0), b = m.row(1), c = m.row(2);
  const Vec3d bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  const double determinant = a.dot(bc);
  const double size = a.norm() * b.norm() * c.norm();
  if (!(std::abs(determinant) > 1e-14 * size)) return false;
  for (std::size_t r = 0; r < 3; ++r) {
    inverse(r, 0) = bc[r] / determinant;
    inverse(r, 1) = ca[r] / determinant;
    inverse(r, 2) = ab[r] / determinant;
  }
  return true;
}

PlaneFit planeOf(const EpipolarMatches& matches, const HomographyFamily& family,
                 const std::uint32_t* three) {
  PlaneFit fit;
  Vec3d rays[3];
  double depths[3];
  for (std::size_t k = 0; k < 3; ++k) {
    rays[k] = matches.first(three[k]);
    if (!family.inverseDepth(rays[k], matches.second(three[k]), depths[k])) return fit;
  }
  if (!solvePlane(rays, depths, fit.plane)) return fit;
  fit.homography = family.homography(fit.plane);
  fit.is_found = invert(fit.homography, fit.inverse);
  return fit;
}

PlaneFit fitPlane(const EpipolarMatches& matches, const HomographyFamily& family,
                  const std::vector<std::uint32_t>& indices, double largest) {
  PlaneFit best;
  const auto count = static_cast<std::uint32_t>(indices.size());
  if (count < 3) return best;
  RandomBits bits(count, 0x706c616e65);
  // The robust loop's order is a random one, so the first matches stand for all.
  const std::size_t tested = std::min<std::size_t>(count, kTested);
  for (std::size_t sample = 0; sample < kSamples; ++sample) {
    std::uint32_t three[3];
    for (std::uint32_t& i : three) i = indices[bits.below(count)];
    PlaneFit fit = planeOf(matches, family, three);
    if (!fit.is_found) continue;
    for (std::size_t j = 0; j < tested; ++j) {
      fit.on_plane += matches.transferSquared(fit.homography, fit.inverse, indices[j]) <= largest;
    }
    if (fit.on_plane > best.on_plane) best = fit;
  }
  if (!best.is_found) return best;
  best.on_plane = 0;
  for (const std::uint32_t i : indices) {
    best.on_plane += matches.transferSquared(best.homography, best.inverse, i) <= largest;
  }
  for (int round = 0; round < 2; ++round) polish(matches, family, indices, largest, best);
  return best;
}

std::size_t countOnPlane(const EpipolarMatches& matches, const Mat3d& homography,
                         const Mat3d& inverse, double largest) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    count += matches.transferSquared(homography, inverse, i) <= largest;
  }
  return count;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
