#include "builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

// Light comes from above and one side.
float lightOn(const Vec3f& normal) {
  return 0.76F + 0.24F * (0.36F * normal[0] + 0.48F * normal[1] + 0.8F * normal[2]);
}

// Dark and bright of what people paint and print.
constexpr int kPairCount = 12;
const std::pair<Colour, Colour> kPairs[kPairCount] = {
    {{34, 26, 22}, {232, 220, 196}}, {{22, 34, 52}, {208, 226, 238}},
    {{52, 18, 16}, {244, 208, 190}}, {{18, 46, 30}, {222, 238, 190}},
    {{44, 30, 58}, {240, 220, 232}}, {{40, 38, 36}, {236, 234, 228}},
    {{66, 40, 8}, {250, 232, 160}},  {{10, 48, 56}, {196, 244, 240}},
    {{56, 30, 14}, {226, 184, 132}}, {{28, 28, 34}, {226, 228, 236}},
    {{70, 14, 30}, {250, 214, 170}}, {{16, 30, 16}, {240, 236, 214}}};

bool isOneOf(Material material, std::initializer_list<Material> list) {
  return std::find(list.begin(), list.end(), material) != list.end();
}

}  // namespace

Builder::Builder(Scene& scene, std::uint64_t seed, float detail)
    : random(keyOf(seed, 10)), scene_(scene), painter_(keyOf(seed, 11)), detail_(detail) {}

Surface Builder::paint(Material material, float width, float height, float texel) {
  scene_.textures.push_back(painter_.paint(material, width, height, texel * detail_));
  Surface surface;
  surface.texture = &scene_.textures.back();
  const std::pair<Colour, Colour>& pair = kPairs[random.below(kPairCount)];
  surface.dark = pair.first;
  surface.bright = pair.second;
  if (isOneOf(material, {Material::asphalt, Material::pavement, Material::concrete,
                         Material::ceiling, Material::metal})) {
    surface.dark = {18, 18, 20};
    surface.bright = {238, 238, 234};
  } else if (isOneOf(material, {Material::planks, Material::crate, Material::bark})) {
    surface.dark = {30, 18, 10};
    surface.bright = {240, 200, 150};
  } else if (isOneOf(material, {Material::bricks, Material::roof})) {
    surface.dark = {48, 16, 10};
    surface.bright = {236, 196, 168};
  } else if (isOneOf(material, {Material::leaves})) {
    surface.dark = {8, 24, 6};
    surface.bright = {170, 214, 110};
  } else if (isOneOf(material, {Material::land})) {
    surface.dark = {26, 34, 12};
    surface.bright = {232, 226, 170};
  }
  return surface;
}

std::vector<Surface> Builder::paintMany(Material material, int count, float width, float height,
                                        float texel) {
  std::vector<Surface> surfaces;
  for (int i = 0; i < count; ++i) surfaces.push_back(paint(material, width, height, texel));
  return surfaces;
}

const Surface& Builder::any(const std::vector<Surface>& surfaces) {
  return surfaces[static_cast<std::size_t>(random.below(static_cast<int>(surfaces.size())))];
}

Primitive& Builder::add(Shape shape, const Surface& surface, int mover) {
  Primitive primitive;
  primitive.shape = shape;
  primitive.surface = surface;
  primitive.mover = mover;
  scene_.primitives.push_back(primitive);
  return scene_.primitives.back();
}

void Builder::rectangle(const Vec3f& corner, const Vec3f& u, const Vec3f& v, float a, float b,
                        const Surface& surface) {
  Primitive& p = add(Shape::rectangle, surface, -1);
  p.origin = corner;
  p.u = u;
  p.v = v;
  p.n = u.cross(v);
  p.a = a;
  p.b = b;
  p.light = lightOn(p.n);
}

void Builder::wall(const Vec3f& from, const Vec3f& to, float height, const Surface& surface) {
  const Vec3f way = to - from;
  rectangle(from, way.normalized(), kUp, way.norm(), height, surface);
}

void Builder::floor(float x, float y, float z, float width, float length, const Surface& surface) {
  rectangle({{x, y, z}}, {{1, 0, 0}}, {{0, 1, 0}}, width, length, surface);
}

void Builder::ceiling(float x, float y, float z, float width, float length,
                      const Surface& surface) {
  rectangle({{x, y, z}}, {{0, 1, 0}}, {{1, 0, 0}}, length, width, surface);
  scene_.primitives.back().light = 0.88F;
}

void Builder::face(const Vec3f& middle, const Vec3f& u, const Vec3f& v, float a, float b,
                   const Surface& surface, float extent, int mover) {
  rectangle(middle - (a / 2) * u - (b / 2) * v, u, v, a, b, surface);
  Primitive& p = scene_.primitives.back();
  p.mover = mover;
  p.shift_s = random.uniform(0, std::max(0.0F, extent - a));
  if (std::fabs(v[2]) < 0.5F) p.shift_t = random.uniform(0, std::max(0.0F, extent - b));
}

void Builder::box(const Vec3f& base, const Vec3f& size, float yaw, const Surface& sides,
                  const Surface& top, float extent, int mover, bool has_bottom) {
  const Vec3f x = {{std::cos(yaw), std::sin(yaw), 0}}, y = {{-x[1], x[0], 0}};
  const Vec3f middle = base + Vec3f{{0, 0, size[2] / 2}};
  face(middle + (size[0] / 2) * x, y, kUp, size[1], size[2], sides, extent, mover);
  face(middle - (size[0] / 2) * x, -y, kUp, size[1], size[2], sides, extent, mover);
  face(middle + (size[1] / 2) * y, -x, kUp, size[0], size[2], sides, extent, mover);
  face(middle - (size[1] / 2) * y, x, kUp, size[0], size[2], sides, extent, mover);
  face(base + size[2] * kUp, x, y, size[0], size[1], top, extent, mover);
  if (has_bottom) face(base, y, x, size[1], size[0], top, extent, mover);
}

void Builder::cylinder(const Vec3f& base, float radius, float height, const Surface& side,
                       const Surface& top, int mover) {
  Primitive& p = add(Shape::cylinder, side, mover);
  const float turn = random.uniform(0, 6.28F);
  p.origin = base;
  p.u = {{std::cos(turn), std::sin(turn), 0}};
  p.v = {{-std::sin(turn), std::cos(turn), 0}};
  p.n = kUp;
  p.a = radius;
  p.b = height;
  Primitive cap = p;
  cap.shape = Shape::disc;
  cap.surface = top;
  cap.origin += height * kUp;
  cap.light = lightOn(kUp);
  scene_.primitives.push_back(cap);
}

void Builder::sphere(const Vec3f& middle, float radius, const Surface& surface, int mover) {
  Primitive& p = add(Shape::sphere, surface, mover);
  p.origin = middle;
  p.u = {{1, 0, 0}};
  p.v = {{0, 1, 0}};
  p.n = kUp;
  p.a = radius;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
