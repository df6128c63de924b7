// The worlds: what stands there, and the way through it.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_WORLD_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_WORLD_H

#include <gslam/geometry/vec.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scene.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// A closed way that is free of things, and how somebody goes it.
struct Route {
  /// World coordinates of a part of the way, 0 to 1. Also outside of it: it is periodic.
  std::function<Vec3d(double part)> place;
  double length = 0;        ///< metres
  double look_ahead = 1;    ///< metres: heads for the place that much before it
  double look_left = 0;     ///< radians
  double swing = 0;         ///< radians: looks to both sides by that much
  double shake_place = 0;   ///< metres
  double shake_angle = 0;   ///< radians
  double most_speed = 1;    ///< m/s
  double control_step = 1;  ///< metres between the controls of the motion, at most
};

struct World {
  Scene scene;
  Route route;
};

/// What fits a world.
struct WorldFacts {
  std::string name;
  double camera_pitch;  ///< radians, downwards: how cameras are mounted
  double baseline;      ///< of stereo, metres
  double depth_unit;    ///< metres
};

/// All worlds.
const std::vector<WorldFacts>& worlds();
/// One of them; null for another name.
const WorldFacts* findWorld(const std::string& name);

/// @param name     of one of worlds()
/// @param detail   edge of texels: 1 for a camera of 640 pixels, 2 for half as many
/// @param movers   number of things that move
World makeWorld(const std::string& name, std::uint64_t seed, float detail, int movers);

/// @{
/// One of them each.
void makeRoom(std::uint64_t seed, float detail, int movers, World& world);
void makeCorridor(std::uint64_t seed, float detail, int movers, World& world);
void makeStreet(std::uint64_t seed, float detail, int movers, World& world);
void makeAerial(std::uint64_t seed, float detail, int movers, World& world);
/// @}

/// Sets place and length: a rectangle with round corners, left around the origin, and waves.
/// @param half_x, half_y  half edges
/// @param radius          of the corners
/// @param wave            metres to each side, and a third of it up and down
void setRoundedRectangle(Route& route, double half_x, double half_y, double radius, double height,
                         double wave, double phase);

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_WORLD_H
