// A room of 9 to 10.5 by 10 to 12 m, with furniture along its walls, a table in its middle, and a
// way around the table.
#include <algorithm>
#include <cmath>

#include "builder.h"
#include "world.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr float kRoomHeight = 2.9F;
constexpr float kRoomExtent = 2.2F;  // of the textures of things
constexpr float kRoomTexel = 0.004F;

// One of the four walls: along it, and into the room.
struct Side {
  Vec3f from, along, inwards;
  float length;
  float yaw;
};

class Room {
 public:
  Room(std::uint64_t seed, float detail, Scene& scene)
      : build_(scene, seed, detail),
        x_(build_.random.uniform(4.5F, 5.25F)),
        y_(build_.random.uniform(5, 6)),
        phase_(build_.random.uniform(0, 6.28F)) {}

  void make() {
    makeShell();
    things_ = {build_.paintMany(Material::crate, 3, kRoomExtent, kRoomExtent, kRoomTexel),
               build_.paintMany(Material::fabric, 2, kRoomExtent, kRoomExtent, kRoomTexel),
               build_.paintMany(Material::metal, 2, kRoomExtent, kRoomExtent, kRoomTexel)};
    books_ = build_.paintMany(Material::books, 3, kRoomExtent, kRoomExtent, kRoomTexel);
    wood_ = build_.paint(Material::planks, kRoomExtent, kRoomExtent, kRoomTexel);
    const Side sides[4] = {{{{x_, y_, 0}}, {{0, -1, 0}}, {{-1, 0, 0}}, 2 * y_, 0},
                           {{{x_, -y_, 0}}, {{-1, 0, 0}}, {{0, 1, 0}}, 2 * x_, 1.5707963F},
                           {{{-x_, -y_, 0}}, {{0, 1, 0}}, {{1, 0, 0}}, 2 * y_, 0},
                           {{{-x_, y_, 0}}, {{1, 0, 0}}, {{0, -1, 0}}, 2 * x_, 1.5707963F}};
    for (const Side& side : sides) furnish(side);
    makeTable();
  }

  void addMovers(Scene& scene, int count) {
    for (int i = 0; i < count; ++i) {
      // Between the table and the way, above the table.
      Mover mover;
      mover.centre = {{0, 0, 1.15F + 0.5F * build_.random.uniform(0, 1)}};
      mover.reach_x = build_.random.uniform(0.3F, 0.9F);
      mover.reach_y = build_.random.uniform(0.3F, 0.9F);
      mover.rate = build_.random.uniform(0.05F, 0.15F);
      mover.phase = build_.random.uniform(0, 1);
      scene.movers.push_back(mover);
      const int place = static_cast<int>(scene.movers.size()) - 1;
      const Surface& surface = build_.any(things_[static_cast<unsigned>(i) % 3U]);
      if (i % 2 == 0) {
        build_.sphere({{0, 0, 0}}, build_.random.uniform(0.16F, 0.28F), surface, place);
      } else {
        build_.box({{0, 0, -0.2F}}, {{0.4F, 0.4F, 0.4F}}, 0.4F, surface, surface, kRoomExtent,
                   place, true);
      }
    }
  }

  float x() const { return x_; }
  float y() const { return y_; }
  float phase() const { return phase_; }

 private:
  void makeShell() {
    build_.floor(-x_, -y_, 0, 2 * x_, 2 * y_,
                 build_.paint(build_.random.below(2) == 0 ? Material::planks : Material::tiles,
                              2 * x_, 2 * y_, kRoomTexel));
    build_.floor(-1.8F, -2.4F, 0.004F, 3.6F, 4.8F,
                 build_.paint(Material::carpet, 3.6F, 4.8F, kRoomTexel));
    build_.ceiling(-x_, -y_, kRoomHeight, 2 * x_, 2 * y_,
                   build_.paint(Material::ceiling, 2 * y_, 2 * x_, 0.006F));
    const Vec3f corners[4] = {{{x_, y_, 0}}, {{x_, -y_, 0}}, {{-x_, -y_, 0}}, {{-x_, y_, 0}}};
    const Material materials[3] = {Material::wallpaper, Material::bricks, Material::plaster};
    const int first = build_.random.below(3);
    for (int i = 0; i < 4; ++i) {
      const Vec3f& from = corners[i];
      const Vec3f& to = corners[(i + 1) % 4];
      build_.wall(
          from, to, kRoomHeight,
          build_.paint(materials[(first + i) % 3], (to - from).norm(), kRoomHeight, kRoomTexel));
    }
  }

  // From one end of a wall to the other: something stands there, or something hangs there.
  void furnish(const Side& side) {
    float at = build_.random.uniform(0.8F, 1.2F);
    while (at < side.length - 2) {
      const float width = build_.random.uniform(0.8F, 1.7F);
      switch (build_.random.below(5)) {
        case 0:
          addShelf(side, at, width);
          break;
        case 1:
          addCabinet(side, at, width);
          break;
        case 2:
          addColumn(side, at + 0.3F);
          addPicture(side, at + 0.75F, 0.9F);
          break;
        default:
          addPicture(side, at, width);
          break;
      }
      at += width + build_.random.uniform(0.15F, 0.7F);
    }
  }

  void addShelf(const Side& side, float at, float width) {
    const Vec3f base = side.from + (at + width / 2) * side.along + 0.21F * side.inwards;
    build_.box(base, {{0.4F, width, build_.random.uniform(1.7F, 2.15F)}}, side.yaw,
               build_.any(books_), wood_, kRoomExtent);
  }

  void addCabinet(const Side& side, float at, float width) {
    const Vec3f base = side.from + (at + width / 2) * side.along + 0.31F * side.inwards;
    const float height = build_.random.uniform(0.6F, 1);
    build_.box(base, {{0.55F, width, height}}, side.yaw, build_.any(things_[0]), wood_,
               kRoomExtent);
    const float radius = build_.random.uniform(0.13F, 0.22F);
    const Vec3f above = base + Vec3f{{0, 0, height}};
    build_.sphere(above + Vec3f{{0, 0, radius}} + (0.25F * width) * side.along, radius,
                  build_.any(things_[1]));
    build_.box(above - (0.22F * width) * side.along, {{0.3F, 0.35F, 0.3F}},
               build_.random.uniform(0, 1.5F), build_.any(things_[0]), wood_, kRoomExtent);
    addPicture(side, at, width, 1.6F);
  }

  void addColumn(const Side& side, float at) {
    const float radius = build_.random.uniform(0.14F, 0.26F);
    const Vec3f base = side.from + at * side.along + (radius + 0.05F) * side.inwards;
    build_.cylinder(base, radius, build_.random.uniform(0.6F, 2.2F), build_.any(things_[2]), wood_);
  }

  void addPicture(const Side& side, float at, float width, float low = 0) {
    if (low <= 0) low = build_.random.uniform(1, 1.25F);
    const float height = build_.random.uniform(0.8F, 1.2F);
    const Material material = build_.random.below(3) == 0 ? Material::notices : Material::poster;
    build_.wall(side.from + at * side.along + 0.012F * side.inwards + Vec3f{{0, 0, low}},
                side.from + (at + width) * side.along + 0.012F * side.inwards + Vec3f{{0, 0, low}},
                height, build_.paint(material, width, height, kRoomTexel));
  }

  void makeTable() {
    const Vec3f size = {{1.1F, 1.8F, 0.06F}};
    const float yaw = build_.random.uniform(-0.3F, 0.3F);
    build_.box({{0, 0, 0.7F}}, size, yaw, wood_, wood_, kRoomExtent, -1, true);
    const float c = std::cos(yaw), s = std::sin(yaw);
    for (int i = 0; i < 4; ++i) {
      const float x = i % 2 == 0 ? 0.48F : -0.48F, y = i / 2 == 0 ? 0.82F : -0.82F;
      build_.box({{c * x - s * y, s * x + c * y, 0}}, {{0.07F, 0.07F, 0.7F}}, yaw, wood_, wood_,
                 kRoomExtent);
    }
    for (int i = 0; i < 5; ++i) {
      const float x = build_.random.uniform(-0.3F, 0.3F), y = 0.32F * static_cast<float>(i - 2);
      const Vec3f base = {{c * x - s * y, s * x + c * y, 0.76F}};
      const float size_of_it = build_.random.uniform(0.12F, 0.2F);
      const Surface& surface = build_.any(things_[static_cast<unsigned>(i) % 3U]);
      if (i % 3 == 0) {
        build_.box(base, {{1.5F * size_of_it, size_of_it, 1.6F * size_of_it}},
                   build_.random.uniform(0, 3), surface, surface, kRoomExtent);
      } else if (i % 3 == 1) {
        build_.sphere(base + Vec3f{{0, 0, size_of_it}}, size_of_it, surface);
      } else {
        build_.cylinder(base, 0.6F * size_of_it, 2 * size_of_it, surface, surface);
      }
    }
  }

  Builder build_;
  float x_, y_;  // half edges
  float phase_;  // of the waves of the way, which things that move do not change
  std::vector<std::vector<Surface>> things_;
  std::vector<Surface> books_;
  Surface wood_;
};

}  // namespace

void makeRoom(std::uint64_t seed, float detail, int movers, World& world) {
  Room room(seed, detail, world.scene);
  room.make();
  room.addMovers(world.scene, movers);
  Route& route = world.route;
  setRoundedRectangle(route, double(room.x()) - 1.75, double(room.y()) - 1.75, 2.3, 1.5, 0.2,
                      double(room.phase()));
  route.look_ahead = 1.6;
  route.look_left = 0.25;  // where the table is
  route.swing = 0.55;
  route.shake_place = 0.012;
  route.shake_angle = 0.015;
  route.most_speed = 2.5;
  route.control_step = 0.45;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
