// A flight over hills with fields, woods and villages.
#include <cmath>

#include "builder.h"
#include "world.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr float kHalf = 300;  // half the edge of the land
constexpr int kCells = 60;
constexpr float kRelief = 9;   // metres up and down
constexpr float kFlight = 72;  // metres above the mean

class Countryside {
 public:
  Countryside(std::uint64_t seed, float detail, Scene& scene)
      : build_(scene, seed, detail), scene_(scene), hills_(build_.random(), 2, 5, 0.45F) {}

  void make() {
    scene_.clouds.reset(new NoiseField(build_.random(), 2, 7, 0.55F));
    scene_.terrain.reset(new Terrain(kHalf, kCells, [this](float x, float y) {
      return kRelief * hills_.at(x / (3 * kHalf) + 0.5F, y / (3 * kHalf) + 0.5F);
    }));
    Primitive land;
    land.shape = Shape::terrain;
    land.surface = build_.paint(Material::land, 2 * kHalf, 2 * kHalf, 0.22F);
    scene_.primitives.push_back(land);
    facades_ = build_.paintMany(Material::facade, 3, 24, 12, 0.1F);
    roofs_ = build_.paintMany(Material::roof, 3, 24, 24, 0.1F);
    leaves_ = build_.paintMany(Material::leaves, 3, 16, 16, 0.1F);
    for (int i = 0; i < 9; ++i) addVillage();
    for (int i = 0; i < 14; ++i) addWood();
  }

  void addMovers(int count) {
    for (int i = 0; i < count; ++i) {  // lorries, going round on the land
      Mover mover;
      mover.centre = {{build_.random.uniform(-110, 110), build_.random.uniform(-110, 110), 0}};
      mover.reach_x = build_.random.uniform(4, 20);
      mover.rate = build_.random.uniform(0.02F, 0.06F);
      mover.phase = build_.random.uniform(0, 1);
      scene_.movers.push_back(mover);
      const int place = static_cast<int>(scene_.movers.size()) - 1;
      const float ground = scene_.terrain->height(mover.centre[0], mover.centre[1]);
      build_.box({{0, 0, ground - 2}}, {{8, 3, 6}}, 0, build_.any(facades_), build_.any(roofs_), 24,
                 place);
    }
  }

 private:
  void addVillage() {
    const float x = build_.random.uniform(-190, 190), y = build_.random.uniform(-190, 190);
    for (int i = 0; i < 7; ++i) {
      const float hx = x + build_.random.uniform(-32, 32), hy = y + build_.random.uniform(-32, 32);
      const Vec3f size = {{build_.random.uniform(8, 16), build_.random.uniform(7, 12),
                           build_.random.uniform(7, 12)}};
      build_.box({{hx, hy, scene_.terrain->height(hx, hy) - 2.5F}}, size,
                 build_.random.uniform(0, 1.57F), build_.any(facades_), build_.any(roofs_), 24);
    }
  }

  void addWood() {
    const float x = build_.random.uniform(-200, 200), y = build_.random.uniform(-200, 200);
    for (int i = 0; i < 9; ++i) {
      const float tx = x + build_.random.uniform(-22, 22), ty = y + build_.random.uniform(-22, 22);
      const float radius = build_.random.uniform(2, 4.2F);
      build_.sphere({{tx, ty, scene_.terrain->height(tx, ty) + 0.7F * radius}}, radius,
                    build_.any(leaves_));
    }
  }

  Builder build_;
  Scene& scene_;
  NoiseField hills_;
  std::vector<Surface> facades_, roofs_, leaves_;
};

}  // namespace

void makeAerial(std::uint64_t seed, float detail, int movers, World& world) {
  Countryside land(seed, detail, world.scene);
  land.make();
  land.addMovers(movers);
  Route& route = world.route;
  setRoundedRectangle(route, 95, 80, 55, double(kFlight), 6, double(seed % 7));
  route.look_ahead = 20;
  route.swing = 0.05;
  route.shake_place = 0.1;
  route.shake_angle = 0.012;
  route.most_speed = 40;
  route.control_step = 8;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
