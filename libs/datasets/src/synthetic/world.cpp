#include "world.h"

#include <algorithm>
#include <cmath>

#include "pi.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

// The way around a rectangle, counterclockwise, from the middle of its right edge.
Vec3d placeOnRectangle(double half_x, double half_y, double radius, double way, Vec3d& outwards) {
  const double edges[4] = {2 * (half_y - radius), 2 * (half_x - radius), 2 * (half_y - radius),
                           2 * (half_x - radius)};
  const double bend = kPi / 2 * radius;
  way += edges[0] / 2;  // begin at the corner before
  double angle = 0;
  Vec3d middle = {{half_x - radius, -(half_y - radius), 0}};  // of the corner, before the edge
  for (int side = 0;; side = (side + 1) % 4, angle += kPi / 2) {
    const Vec3d normal = {{std::cos(angle), std::sin(angle), 0}},
                along = {{-normal[1], normal[0], 0}};
    if (way <= edges[side]) {
      outwards = normal;
      return middle + radius * normal + way * along;
    }
    way -= edges[side];
    middle += edges[side] * along;
    if (way <= bend) {
      const double turned = angle + way / radius;
      outwards = {{std::cos(turned), std::sin(turned), 0}};
      return middle + radius * outwards;
    }
    way -= bend;
  }
}

}  // namespace

void setRoundedRectangle(Route& route, double half_x, double half_y, double radius, double height,
                         double wave, double phase) {
  const double length = 4 * (half_x + half_y - 2 * radius) + 2 * kPi * radius;
  route.length = length;
  route.place = [=](double part) {
    part -= std::floor(part);
    Vec3d outwards{};
    const Vec3d place = placeOnRectangle(half_x, half_y, radius, part * length, outwards);
    const double angle = 2 * kPi * part;
    Vec3d moved = place + wave * std::sin(3 * angle + phase) * outwards;
    moved[2] = height + wave / 3 * std::sin(5 * angle + 2 * phase);
    return moved;
  };
}

const std::vector<WorldFacts>& worlds() {
  static const std::vector<WorldFacts> all = {{"room", 0, 0.11, 0.001},
                                              {"corridor", 0, 0.11, 0.001},
                                              {"street", 0, 0.54, 0.002},
                                              {"aerial", 0.98, 2, 0.005}};
  return all;
}

const WorldFacts* findWorld(const std::string& name) {
  for (const WorldFacts& one : worlds()) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

World makeWorld(const std::string& name, std::uint64_t seed, float detail, int movers) {
  World world;
  if (name == "room") makeRoom(seed, detail, movers, world);
  if (name == "corridor") makeCorridor(seed, detail, movers, world);
  if (name == "street") makeStreet(seed, detail, movers, world);
  if (name == "aerial") makeAerial(seed, detail, movers, world);
  return world;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
