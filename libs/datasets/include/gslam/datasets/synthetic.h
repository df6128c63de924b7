#ifndef GSLAM_DATASETS_SYNTHETIC_H
#define GSLAM_DATASETS_SYNTHETIC_H

#include <gslam/core/dataset.h>
#include <gslam/core/registry.h>
#include <gslam/datasets/export.h>
#include <gslam/datasets/frame_ranges.h>
#include <gslam/svar/fields.h>
#include <gslam/svar/svar.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// @file
/// Worlds that are computed, with exact truth: the dataset that needs no download.

namespace gslam {
inline namespace v1 {

/// What is rendered. Two datasets with equal options have the same bytes, on any number of threads.
///
/// **Frames of reference.** World: x east, y north, z up, metres. Body: x forward, y left, z up;
/// the inertial unit and the satellite antenna are at its origin. Cameras of the rigs look forward,
/// in the aerial world 56 degrees down. Stamps begin at one second; the stamp of a frame is the
/// middle of its exposure.
///
/// **Light.** What is seen is as bright from wherever it is seen, and all the time.
///
/// The names are those of the parameters, too: `synthetic://corridor?seed=7&sensors=stereo`.
struct SyntheticOptions {
  /// @name World
  /// @{
  /// * room: 9 to 10.5 by 10 to 12 m, furniture along its walls, once around a table, 20 to 26 m
  /// * corridor: around a block of offices, 38 to 52 m, much alike on all sides
  /// * street: by car around a block of houses, 230 to 281 m, with trees and a sky
  /// * aerial: 72 m above hills with fields and villages, cameras look down, about 610 m
  std::string world = "room";
  std::uint64_t seed = 1;  ///< of everything: the things, the way, the errors of the sensors
  int frames = 600;        ///< 1 to 100000, with those that are dropped
  double rate = 20;        ///< frames a second, 0.1 to 1000
  /// Speed along the way, 0.01 to 1000 m/s. 0: as fast as it takes to come around in all frames, so
  /// that the last frame sees what the first did, but no faster than somebody would go: 2.5 in room
  /// and corridor, 15 in the street, 40 in the air.
  double speed = 0;
  int movers = 0;  ///< things that move by themselves, 0 to 50
  /// @}

  /// @name Cameras
  /// @{
  std::string sensors = "rgbd";   ///< mono, stereo, rgbd, or multi: front, left, back, right
  std::string model = "pinhole";  ///< a name of Camera::modelNames()
  int width = 640;                ///< pixels
  int height = 480;               ///< pixels
  std::vector<double> lens;       ///< parameters of the model; none: some that are usual for it
  double baseline = 0;            ///< of stereo, metres; 0: 0.11, street 0.54, aerial 2
  bool colour = false;            ///< rgb instead of grey
  /// Cameras of your own, in place of all of the above: kinds grey, rgb, bgr, depth. Those that
  /// have the same model and place share their noise-free picture. Not a parameter.
  std::vector<CameraSensor> cameras;
  /// @}

  /// @name Errors of cameras
  /// Defaults are those of a cheap camera, so that nothing is tuned to a clean world.
  /// @{
  double noise = 1;             ///< factor on all noise and biases, of all sensors; 0: none
  double image_noise = 2;       ///< standard deviation of each pixel and channel, grey levels
  bool blur = true;             ///< smears what moves while the shutter is open
  double exposure = 0.008;      ///< how long it is, seconds, 0 to 1 / rate
  double exposure_change = 0;   ///< brightness swings by this part of it, 0 to 0.9, in 7 s
  double vignette = 0;          ///< part of the brightness that the corners lack, 0 to 1
  double depth_noise = 0.0015;  ///< standard deviation at 1 m; it grows with depth squared
  double depth_max = 0;         ///< farthest depth, metres; 0: whatever the numbers can hold
  bool depth_float = false;     ///< depth as f32 in metres; else u16 in 1 mm, street 2, aerial 5
  /// @}

  /// @name Other sensors
  /// @{
  bool imu = true;                ///< an inertial unit
  double imu_rate = 200;          ///< samples a second, 1 to 10000
  double gyro_noise = 1.7e-4;     ///< rad/s/sqrt(Hz), as EuRoC's
  double accel_noise = 2e-3;      ///< m/s^2/sqrt(Hz)
  double gyro_bias_walk = 2e-5;   ///< rad/s^2/sqrt(Hz)
  double accel_bias_walk = 3e-3;  ///< m/s^3/sqrt(Hz)
  double gyro_bias = 0.01;        ///< standard deviation of the bias at first, rad/s
  double accel_bias = 0.05;       ///< and of this one, m/s^2
  bool gnss = false;              ///< a satellite receiver, near 47.4 N 8.5 E
  double gnss_rate = 5;           ///< positions a second, 0.1 to 100
  double gnss_noise = 0.5;        ///< standard deviation east and north, metres; twice of it up
  /// @}

  /// @name Degradations, at these frames
  /// @{
  FrameRanges pure_rotation;  ///< the body stays where it is and looks to and fro
  FrameRanges low_texture;    ///< contrast falls to 6 %, as before a white wall
  FrameRanges dropped;        ///< frames are lost: stamps jump, ids do not
  FrameRanges occlusion;      ///< something dark is before the lens, over half of the image
  /// @}

  int threads = 0;  ///< that render, 0: all; makes no difference to what comes out
};

/// All options but `cameras`, each by its name.
template <>
struct SvarTraits<SyntheticOptions> : SvarFields<SyntheticOptions> {
  /// Visits each.
  template <class Visit>
  static void fields(Visit& visit) {
    using O = SyntheticOptions;
    visit("world", &O::world);
    visit("seed", &O::seed);
    visit("frames", &O::frames);
    visit("rate", &O::rate);
    visit("speed", &O::speed);
    visit("movers", &O::movers);
    visit("sensors", &O::sensors);
    visit("model", &O::model);
    visit("width", &O::width);
    visit("height", &O::height);
    visit("lens", &O::lens);
    visit("baseline", &O::baseline);
    visit("colour", &O::colour);
    visit("noise", &O::noise);
    visit("image_noise", &O::image_noise);
    visit("blur", &O::blur);
    visit("exposure", &O::exposure);
    visit("exposure_change", &O::exposure_change);
    visit("vignette", &O::vignette);
    visit("depth_noise", &O::depth_noise);
    visit("depth_max", &O::depth_max);
    visit("depth_float", &O::depth_float);
    visit("imu", &O::imu);
    visit("imu_rate", &O::imu_rate);
    visit("gyro_noise", &O::gyro_noise);
    visit("accel_noise", &O::accel_noise);
    visit("gyro_bias_walk", &O::gyro_bias_walk);
    visit("accel_bias_walk", &O::accel_bias_walk);
    visit("gyro_bias", &O::gyro_bias);
    visit("accel_bias", &O::accel_bias);
    visit("gnss", &O::gnss);
    visit("gnss_rate", &O::gnss_rate);
    visit("gnss_noise", &O::gnss_noise);
    visit("pure_rotation", &O::pure_rotation);
    visit("low_texture", &O::low_texture);
    visit("dropped", &O::dropped);
    visit("occlusion", &O::occlusion);
    visit("threads", &O::threads);
  }
};

/// The options that a name such as `synthetic://room?seed=1&frames=300&noise=1` stands for.
/// @param name        `synthetic`, `synthetic://WORLD`, or that with `?name=value&...`; lists and
///   ranges have commas in them
/// @param parameters  an object with options, over which those of the name are laid; null: none
/// @throws ArgumentError for another name, and for an option that there is not, with the name that
///   is near; SvarError for a value of another type
GSLAM_DATASETS_EXPORT SyntheticOptions syntheticOptions(const std::string& name,
                                                        const Svar& parameters = Svar());

/// Makes a world. Its frames are rendered when they are asked for, each the same whatever was asked
/// for before.
/// @throws ArgumentError that names the option that is out of its range
GSLAM_DATASETS_EXPORT std::unique_ptr<Dataset> openSynthetic(const SyntheticOptions& options);

/// The factory `synthetic`, whose open() takes what syntheticOptions() does. It recognizes no file.
GSLAM_DATASETS_EXPORT DatasetFactory syntheticFactory();

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SYNTHETIC_H
