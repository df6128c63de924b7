#include <gslam/geometry.h>
#include <gslam/geometry/undistort.h>

#include <cstdint>
#include <iostream>
#include <vector>

int main() {
  // fx fy cx cy k1 k2 k3 k4, as Kalibr prints them for an equidistant camera
  const gslam::Camera fisheye = gslam::Camera::fromParameters(
      "kannala_brandt", 512, 512, {190.98, 190.97, 254.93, 256.90, 0.0034, 0.0007, -0.002, 0.0002});

  gslam::Vec2d pixel;
  if (fisheye.project({1, 0, 0.5}, pixel)) std::cout << "seen at " << pixel << "\n";
  gslam::Vec3d bearing;
  if (fisheye.unproject(pixel, bearing)) std::cout << "along " << bearing << "\n";
  if (!fisheye.project({0, 0, -1}, pixel)) std::cout << "behind: not seen\n";

  // Its images as a pinhole camera would have taken them.
  const gslam::Camera pinhole =
      gslam::Camera::fromParameters("pinhole", 640, 480, {250, 250, 319.5, 239.5});
  const gslam::Undistorter undistorter(fisheye, pinhole);
  const std::vector<std::uint8_t> image(std::size_t(512) * 512, 100);
  std::vector<std::uint8_t> straight(std::size_t(640) * 480);
  undistorter.apply(gslam::ImageSpan<const std::uint8_t>::dense(image.data(), 512, 512),
                    gslam::ImageSpan<std::uint8_t>::dense(straight.data(), 640, 480));
  std::cout << "the middle is " << int(straight[240 * 640 + 320]) << "\n";
  return straight[240 * 640 + 320] == 100 ? 0 : 1;
}
