// A drive around a block of houses, with houses on the other side, cars, trees and lamps.
#include <cmath>

#include "builder.h"
#include "world.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr float kRoad = 4.6F;        // from the middle of the road to its kerb
constexpr float kHouse = 8.5F;       // and to the houses
constexpr float kFacadeExtent = 24;  // of facades
constexpr float kStreetTexel = 0.02F;

class Street {
 public:
  Street(std::uint64_t seed, float detail, Scene& scene)
      : build_(scene, seed, detail),
        scene_(scene),
        x_(build_.random.uniform(32, 40)),
        y_(build_.random.uniform(24, 30)) {}

  void make() {
    scene_.clouds.reset(new NoiseField(build_.random(), 2, 7, 0.55F));
    facades_ = build_.paintMany(Material::facade, 4, kFacadeExtent, 13, kStreetTexel);
    shops_ = build_.paintMany(Material::shop, 3, kFacadeExtent, 13, kStreetTexel);
    cars_ = build_.paintMany(Material::car, 4, 6, 2, 0.01F);
    leaves_ = build_.paintMany(Material::leaves, 2, 8, 8, 0.02F);
    bark_ = build_.paint(Material::bark, 2, 3.5F, 0.01F);
    roof_ = build_.paint(Material::roof, kFacadeExtent, kFacadeExtent, 0.1F);
    metal_ = build_.paint(Material::metal, 2, 5, 0.01F);
    for (int side = 0; side < 4; ++side) {
      makeGround(side);
      makeHouses(side, 1);
      makeHouses(side, -1);
      makeKerb(side, 1);
      makeKerb(side, -1);
    }
  }

  void addMovers(int count) {
    for (int i = 0; i < count; ++i) {  // cars on the other lane, to and fro
      Mover mover;
      const bool is_right = i % 2 == 0;
      mover.centre = {{is_right ? x_ - 2.4F : -x_ + 2.4F, 0, 0}};
      mover.reach_y = build_.random.uniform(0.4F, 0.75F) * (y_ - 6);
      mover.rate = build_.random.uniform(0.01F, 0.03F);
      mover.phase = build_.random.uniform(0, 1);
      scene_.movers.push_back(mover);
      addCar({{0, 0, 0}}, 1.5707963F, static_cast<int>(scene_.movers.size()) - 1);
    }
  }

  float x() const { return x_; }
  float y() const { return y_; }

 private:
  struct Axes {
    Vec3f out, along;
    float far, half;
  };

  Axes axes(int side) const {
    const float c = side % 2 == 0 ? (side == 0 ? 1.0F : -1.0F) : 0;
    const float s = side % 2 == 1 ? (side == 1 ? 1.0F : -1.0F) : 0;
    return {{{c, s, 0}}, {{-s, c, 0}}, side % 2 == 0 ? x_ : y_, side % 2 == 0 ? y_ : x_};
  }

  void strip(const Axes& a, float from, float width, float before, float length, float height,
             Material material, float texel) {
    const Vec3f corner = (a.far + from) * a.out + before * a.along + height * kUp;
    build_.rectangle(corner, a.out, a.along, width, length,
                     build_.paint(material, width, length, texel));
  }

  void makeGround(int side) {
    const Axes a = axes(side);
    strip(a, -kRoad, 2 * kRoad, -a.half + kRoad, 2 * a.half, 0, Material::asphalt, kStreetTexel);
    // Of the pavements that meet at a corner only one has it.
    const bool has_corner = side % 2 == 0;
    const float inner = a.half - (has_corner ? kRoad : kHouse);
    const float outer = a.half + (has_corner ? kHouse : kRoad);
    strip(a, -kHouse, kHouse - kRoad, -inner, 2 * inner, 0.12F, Material::pavement, 0.025F);
    strip(a, kRoad, kHouse - kRoad, -outer, 2 * outer, 0.12F, Material::pavement, 0.025F);
  }

  // The row of houses outside (1) or inside (-1) of the road.
  void makeHouses(int side, int sign) {
    const Axes a = axes(side);
    const float depth = 6;
    const float corner = sign < 0 && side % 2 == 1 ? depth : 0;  // another row has it
    const float half = a.half + static_cast<float>(sign) * kHouse - corner;
    float at = -half;
    while (at < half - 0.01F) {
      float width = build_.random.uniform(7, 14);
      if (half - at - width < 6) width = half - at;
      const float height = 3.1F * static_cast<float>(2 + build_.random.below(3)) + 0.4F;
      const Vec3f base = (a.far + static_cast<float>(sign) * (kHouse + depth / 2)) * a.out +
                         (at + width / 2) * a.along;
      const Surface& sides = build_.any(build_.random.below(2) == 0 ? shops_ : facades_);
      build_.box(base, {{depth, width, height}}, std::atan2(a.out[1], a.out[0]), sides, roof_,
                 kFacadeExtent);
      at += width;
    }
  }

  // Trees, lamps and cars along the kerb.
  void makeKerb(int side, int sign) {
    const Axes a = axes(side);
    const float half = a.half - 10;
    for (float at = -half; at < half; at += build_.random.uniform(4.5F, 8)) {
      const Vec3f kerb = a.far * a.out + at * a.along;
      const float s = static_cast<float>(sign);
      switch (build_.random.below(4)) {
        case 0:
          addTree(kerb + s * 6 * a.out);
          break;
        case 1:
          build_.cylinder(kerb + s * 5.3F * a.out, 0.09F, 4.8F, metal_, metal_);
          break;
        case 2:
          addCar(kerb + s * 5.6F * a.out, std::atan2(a.along[1], a.along[0]), -1);
          break;
        default:
          addKiosk(kerb + s * 6.6F * a.out, std::atan2(a.along[1], a.along[0]));
          break;
      }
    }
  }

  void addTree(const Vec3f& base) {
    const float trunk = build_.random.uniform(2, 2.8F);
    build_.cylinder(base, build_.random.uniform(0.14F, 0.24F), trunk, bark_, bark_);
    const float radius = build_.random.uniform(1.1F, 1.6F);
    build_.sphere(base + (trunk + 0.7F * radius) * kUp, radius, build_.any(leaves_));
    build_.sphere(base + (trunk + 1.6F * radius) * kUp + Vec3f{{0.4F, -0.3F, 0}}, 0.7F * radius,
                  build_.any(leaves_));
  }

  void addCar(const Vec3f& base, float yaw, int mover) {
    const Surface& paint = build_.any(cars_);
    const Vec3f along = {{std::cos(yaw), std::sin(yaw), 0}};
    build_.box(base + 0.15F * kUp, {{4.2F, 1.7F, 0.75F}}, yaw, paint, paint, 6, mover);
    build_.box(base + 0.9F * kUp - 0.2F * along, {{2.3F, 1.5F, 0.55F}}, yaw, paint, paint, 6,
               mover);
  }

  void addKiosk(const Vec3f& base, float yaw) {
    const Surface& sides = build_.any(shops_);
    build_.box(base, {{build_.random.uniform(1, 2), 1.1F, 2.3F}}, yaw, sides, roof_, kFacadeExtent);
  }

  Builder build_;
  Scene& scene_;
  float x_, y_;  // half edges of the way along the middle
  std::vector<Surface> facades_, shops_, cars_, leaves_;
  Surface bark_, roof_, metal_;
};

}  // namespace

void makeStreet(std::uint64_t seed, float detail, int movers, World& world) {
  Street street(seed, detail, world.scene);
  street.make();
  street.addMovers(movers);
  Route& route = world.route;
  // On the right lane; counterclockwise that is the outer one.
  setRoundedRectangle(route, double(street.x()) + 1.8, double(street.y()) + 1.8, 6, 1.65, 0.25,
                      double(seed % 7));
  route.look_ahead = 6;
  route.swing = 0.08;
  route.shake_place = 0.01;
  route.shake_angle = 0.004;
  route.most_speed = 15;
  route.control_step = 2.5;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
