// A corridor around a block of offices: doors, notices, pipes, things along the walls.
#include <cmath>

#include "builder.h"
#include "world.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr float kCorridorHeight = 2.7F;
constexpr float kHalfWidth = 1.35F;
constexpr float kCorridorExtent = 2.2F;
constexpr float kCorridorTexel = 0.004F;

class Corridor {
 public:
  Corridor(std::uint64_t seed, float detail, Scene& scene)
      : build_(scene, seed, detail),
        x_(build_.random.uniform(5.5F, 7.5F)),
        y_(build_.random.uniform(4.5F, 6)),
        phase_(build_.random.uniform(0, 6.28F)) {}

  void make() {
    crates_ =
        build_.paintMany(Material::crate, 2, kCorridorExtent, kCorridorExtent, kCorridorTexel);
    metal_ = build_.paintMany(Material::metal, 2, kCorridorExtent, kCorridorExtent, kCorridorTexel);
    doors_ = build_.paintMany(Material::planks, 3, 1.1F, 2.1F, kCorridorTexel);
    for (int side = 0; side < 4; ++side) makeSide(side);
    for (int side = 0; side < 4; ++side) {
      makeWall(side, kHalfWidth, false);
      makeWall(side, -kHalfWidth, true);
    }
  }

  void addMovers(Scene& scene, int count) {
    for (int i = 0; i < count; ++i) {  // they slide along one side, at the wall
      Mover mover;
      const bool is_right = i % 2 == 0;
      mover.centre = {{(is_right ? x_ : -x_) + 1.05F, 0, 0.05F}};
      mover.reach_y = build_.random.uniform(0.3F, 0.7F) * y_;
      mover.rate = build_.random.uniform(0.02F, 0.05F);
      mover.phase = build_.random.uniform(0, 1);
      if (!is_right) mover.centre[0] -= 2.1F;
      scene.movers.push_back(mover);
      const int place = static_cast<int>(scene.movers.size()) - 1;
      const Surface& surface = build_.any(crates_);
      build_.box({{0, 0, 0}}, {{0.4F, 0.5F, 1.5F}}, 0, surface, surface, kCorridorExtent, place,
                 true);
    }
  }

  float x() const { return x_; }
  float y() const { return y_; }
  float phase() const { return phase_; }

 private:
  struct Axes {
    Vec3f out, along;  // away from the block, and counterclockwise around it
    float far, half;   // from the origin to the middle of the corridor, and half its length
  };

  Axes axes(int side) const {
    const float c = side % 2 == 0 ? (side == 0 ? 1.0F : -1.0F) : 0;
    const float s = side % 2 == 1 ? (side == 1 ? 1.0F : -1.0F) : 0;
    return {{{c, s, 0}}, {{-s, c, 0}}, side % 2 == 0 ? x_ : y_, side % 2 == 0 ? y_ : x_};
  }

  // Floor and ceiling of one side, from corner to corner, with the corner at its end.
  void makeSide(int side) {
    const Axes a = axes(side);
    const float length = 2 * a.half, width = 2 * kHalfWidth;
    const Vec3f corner = (a.far - kHalfWidth) * a.out - (a.half - kHalfWidth) * a.along;
    const Material ground = side % 2 == 0 ? Material::tiles : Material::concrete;
    build_.rectangle(corner, a.out, a.along, width, length,
                     build_.paint(ground, width, length, kCorridorTexel));
    build_.rectangle(corner + kCorridorHeight * kUp, a.along, a.out, length, width,
                     build_.paint(Material::ceiling, length, width, 0.005F));
  }

  // The wall `offset` outwards of the middle of a side.
  void makeWall(int side, float offset, bool is_inner) {
    const Axes a = axes(side);
    const float half = a.half + offset;
    const Vec3f middle = (a.far + offset) * a.out;
    const Vec3f way = is_inner ? -a.along : a.along;  // its right is where it is seen from
    const Vec3f from = middle - half * (-way), to = middle + half * (-way);
    const Material materials[3] = {Material::wallpaper, Material::plaster, Material::bricks};
    build_.wall(from, to, kCorridorHeight,
                build_.paint(materials[(side + (is_inner ? 1 : 0)) % 3], 2 * half, kCorridorHeight,
                             kCorridorTexel));
    const Vec3f inwards = is_inner ? a.out : -a.out;
    furnish(from, -way, inwards, 2 * half, is_inner);
    if (!is_inner) addPipe(middle + inwards * 0.16F, a.along, half);
  }

  void furnish(const Vec3f& from, const Vec3f& along, const Vec3f& inwards, float length,
               bool is_inner) {
    float at = build_.random.uniform(0.4F, 0.9F);
    while (at < length - 1.7F) {
      const int kind = build_.random.below(4);
      const float width = kind == 0 ? 1.1F : build_.random.uniform(0.6F, 1.4F);
      const Vec3f front = from + 0.012F * inwards;
      if (kind == 0) {
        build_.wall(front + at * along, front + (at + width) * along, 2.1F, build_.any(doors_));
        addSign(front + (at + width + 0.1F) * along, along, 0.35F, 0.3F);
      } else {
        const Vec3f low = front + build_.random.uniform(1, 1.3F) * kUp;
        const float height = build_.random.uniform(0.7F, 1.05F);
        const Material material = kind == 1 ? Material::notices : Material::poster;
        build_.wall(low + at * along, low + (at + width) * along, height,
                    build_.paint(material, width, height, kCorridorTexel));
        if (!is_inner && kind == 2 && at > 2 && at < length - 3.5F)
          addThing(from, along, inwards, at);
      }
      at += width + build_.random.uniform(0.25F, 0.9F);
    }
  }

  void addSign(const Vec3f& from, const Vec3f& along, float width, float height) {
    const Vec3f low = from + 1.45F * kUp;
    build_.wall(low, low + width * along, height,
                build_.paint(Material::poster, width, height, 0.003F));
  }

  void addThing(const Vec3f& from, const Vec3f& along, const Vec3f& inwards, float at) {
    const float size = build_.random.uniform(0.3F, 0.42F);
    const Vec3f base = from + (at + 0.4F) * along + (0.5F * size + 0.06F) * inwards;
    if (build_.random.below(2) == 0) {
      build_.cylinder(base, size / 2, build_.random.uniform(0.5F, 0.9F), build_.any(metal_),
                      build_.any(metal_));
    } else {
      const float yaw = std::atan2(along[1], along[0]);
      build_.box(base, {{1.5F * size, size, 1.2F * size}}, yaw, build_.any(crates_),
                 build_.any(crates_), kCorridorExtent);
    }
  }

  // Upright pipes here and there.
  void addPipe(const Vec3f& middle, const Vec3f& along, float half) {
    for (int i = 0; i < 2; ++i) {
      const float at = build_.random.uniform(-half + 2, half - 2);
      build_.cylinder(middle + at * along, 0.07F, kCorridorHeight, build_.any(metal_),
                      build_.any(metal_));
    }
  }

  Builder build_;
  float x_, y_;  // half edges of the way along the middle
  float phase_;  // of its waves, which things that move do not change
  std::vector<Surface> crates_, metal_, doors_;
};

}  // namespace

void makeCorridor(std::uint64_t seed, float detail, int movers, World& world) {
  Corridor corridor(seed, detail, world.scene);
  corridor.make();
  corridor.addMovers(world.scene, movers);
  Route& route = world.route;
  setRoundedRectangle(route, double(corridor.x()), double(corridor.y()), 1.2, 1.45, 0.12,
                      double(corridor.phase()));
  route.look_ahead = 1.5;
  route.swing = 0.2;
  route.shake_place = 0.012;
  route.shake_angle = 0.015;
  route.most_speed = 2.5;
  route.control_step = 0.45;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
