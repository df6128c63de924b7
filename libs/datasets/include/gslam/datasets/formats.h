#ifndef GSLAM_DATASETS_FORMATS_H
#define GSLAM_DATASETS_FORMATS_H

#include <gslam/core/registry.h>
#include <gslam/datasets/export.h>

#include <memory>
#include <string>
#include <vector>

/// @file
/// Datasets as they are on disk after unpacking: the formats of public datasets, and users' own.
///
/// Each is a folder, or a zip archive, which is read without unpacking. Nothing is written. What a
/// format needs and a dataset lacks is an error that names file, line and what was expected; what
/// was skipped, assumed or looks wrong is in DatasetInfo::remarks.
///
/// All have the parameters `threads` (that decode images ahead; 0: none) and `ahead` (most frames
/// that are decoded and not taken). Their own stand in DatasetFactory::parameters, and are said
/// below. `camera` is a camera in one line, "pinhole 640x480 525 525 319.5 239.5"; `calibration` a
/// file that readCalibration() reads, of which the first camera is taken.

namespace gslam {
inline namespace v1 {

/// The name of the format that a folder or file has, such as "euroc"; empty where none of
/// datasetFormats() has it. Looks at names of files and the heads of a few, reads no image. Of a
/// broken archive it is "cvmono", which says what is wrong when it is opened.
GSLAM_DATASETS_EXPORT std::string datasetFormatOf(const std::string& path);

/// All formats below.
GSLAM_DATASETS_EXPORT std::vector<DatasetFactory> datasetFormats();

/// Opens a dataset of one of these formats, without any plugin.
/// @param path        a folder or file; "kitti:PATH" where the format is not to be found out
/// @param parameters  an object with those that are not as DatasetFactory::parameters has them
/// @throws FileError when no format is recognized, and what opening it throws; SvarError for a
///   parameter that the format does not have
GSLAM_DATASETS_EXPORT std::unique_ptr<Dataset> openDataset(const std::string& path,
                                                           const Svar& parameters = Svar());

/// `kitti`: KITTI odometry. The path is the folder of a sequence, one around several, or an
/// archive.
///
/// Body: the left grey camera (P0). Cameras `left`, `right`, `colour_left`, `colour_right`. Poses
/// are in `poses/NN.txt` beside `sequences`, also where the path is `sequences/NN`, or in
/// `poses.txt` or `NN.txt` in the sequence. Where there are not as many times or poses as images,
/// the number in an image's name is that of its line, from 0 on. Without times.txt it is 10 frames
/// a second.
///
/// * `sequence`: which one, such as "06" or 6; null: the only one
/// * `cameras`: grey, colour, all, or auto: grey where it is there
/// * `stereo`: both of a pair, where they are there
GSLAM_DATASETS_EXPORT DatasetFactory kittiFactory();
/// `kittiraw`: KITTI raw, drives that end in _sync (rectified) or _extract (as they were taken;
/// S_xx and S_rect_xx tell which). The path is a drive, the folder of its date, or an archive.
///
/// Body: the inertial unit, where calib_velo_to_cam.txt and calib_imu_to_velo.txt say where it is,
/// else the left grey camera (rectified or not as the images are), without ground truth, inertial
/// samples and satellite positions. World: x east, y north, z up from the first position on, in the
/// devkit's Mercator projection. All of oxts/data is read when it is opened.
///
/// * `sequence`: the drive, such as 5 or "2011_09_26_drive_0005_sync"; null: the only one
/// * `cameras`, `stereo`: as of `kitti`
/// * `tolerance`: most seconds between images of a frame in an _extract drive
GSLAM_DATASETS_EXPORT DatasetFactory kittiRawFactory();
/// `tum`: TUM RGB-D. Body: the colour camera. Without depth.txt it has one camera.
///
/// The calibration is, in this order, what the user wants, that of calibration.txt (fx fy cx cy k1
/// k2 p1 p2 k3, as exportDataset() and ETH3D write it), the published one of freiburg1, 2 or 3, by
/// the name in rgb.txt or else that of the folder, or ROS's default. accelerometer.txt is counted
/// and not delivered: nobody measured angular velocities.
///
/// * `depth`: whether there shall be depth
/// * `tolerance`: most seconds between colour and depth, see associate()
/// * `depth_factor`: units of a pixel of depth in a metre
/// * `camera`: such as "pinhole 640x480 525 525 319.5 239.5"
/// * `calibration`: a file, see readCalibration()
GSLAM_DATASETS_EXPORT DatasetFactory tumFactory();
/// `icl`: ICL-NUIM, in the form that is like TUM's (associations.txt, or else rgb.txt and
/// depth.txt;
/// *.gt.freiburg, or else groundtruth.txt) and that of POV-Ray (scene_00_0000.png, .depth, .txt,
/// whose distances along rays become depth along the axis).
///
/// Body: the camera. In the files y points up in the camera and the world, both left-handed, and fy
/// is -480. Here y points down in both: fy is 480, images are as they are, and a pose (R, t)
/// becomes (S R S, S t) with S = diag(1, -1, 1). A calibration.txt with a positive fy says that
/// poses have been mirrored already. Numbers of frames are 1/30 s each.
///
/// * `depth`, `depth_factor`, `camera`, `calibration`: as of `tum`
/// * `mirror`: false where poses have been mirrored already
/// * `unit`: metres that 1 stands for in POV-Ray's files; 0: 1 for scene_00_0000, the living room,
///   0.01 for scene_000, the office
GSLAM_DATASETS_EXPORT DatasetFactory iclFactory();
/// `tummono`: TUM monoVO. images/ or images.zip, times.txt with exposures, camera.txt, poses at the
/// begin and the end. `photometric`: "none"; "u8" or "f32", whose pixels are the irradiance times
/// exposure, by pcalib.txt and vignette.png, as 8-bit numbers or floats (0 to 255 without
/// vignette). `camera`, `calibration`: in place of camera.txt, see cvMonoFactory().
GSLAM_DATASETS_EXPORT DatasetFactory tumMonoFactory();
/// `euroc`: EuRoC MAV and others in the ASL layout: the folder around mav0, or mav0. `cameras`:
/// numbers of those to read, "0" or "0,1"; "": all. `list`: the file of each camera that names its
/// images, "data.csv". `tolerance`: most seconds between the images of a frame, 0. `calibration`: a
/// file that readCalibration() reads, in place of the models that sensor.yaml has; where cameras
/// are is taken from it as far as it says that. `truth`: the folder of the ground truth; "": the
/// first of state_groundtruth_estimate0, mocap0, vicon0; leica0 has positions only.
GSLAM_DATASETS_EXPORT DatasetFactory eurocFactory();
/// `tumvi`: TUM VI, the archives of EuRoC and DSO layout, 512 or 1024, 8 or 16 bits: mav0/ and, for
/// exposures and calibration, dso/. The parameters are those of eurocFactory().
GSLAM_DATASETS_EXPORT DatasetFactory tumViFactory();
/// `dronemap`: NPU DroneMap. `config.cfg` with `trajectory.txt` and `rgb/` (keyframes with poses),
/// or with `frames.txt` and `gps.txt` (frames with positions); NAME.npudronemap stands for its
/// folder, without positions where NAME has "mono". Parameters: `camera`, `calibration`.
GSLAM_DATASETS_EXPORT DatasetFactory droneMapFactory();
/// `photos`: a folder of photos with EXIF positions: GNSS samples, and priors where a DJI's gimbal
/// angles are known. Parameters: `camera`, `calibration`; else the camera is guessed from EXIF.
GSLAM_DATASETS_EXPORT DatasetFactory photosFactory();
/// `7scenes`: Microsoft 7-Scenes. The path is the folder of a sequence, that of a scene, or an
/// archive. Body: the depth camera. Colour has its calibration and pose, too, which is wrong by a
/// few pixels: nobody calibrated it. Depth of 65535 becomes 0. Frames are 1/30 s apart. All poses
/// are read when it is opened; those that are not finite, or none, are skipped.
///
/// * `sequence`: which one, such as "chess/seq-01", "seq-01" or 1; null: the only one
/// * `depth`, `depth_factor`, `camera`, `calibration`: as of `tum`; else
///   camera-intrinsics.txt in or around the sequence, or 585 585 320 240
GSLAM_DATASETS_EXPORT DatasetFactory sevenScenesFactory();
/// `strecha`: Strecha's multi-view benchmark: photos, in the folder or in `images`, and a .camera
/// file of each, beside it or in gt_dense_cameras. Body: the camera. It is that of the first image,
/// scaled to the size of the images, or images/K.txt. Images are 1 s apart, by name.
GSLAM_DATASETS_EXPORT DatasetFactory strechaFactory();
/// `folder`: users' own cameras, as a file `dataset.yaml` describes them; the README explains it.
GSLAM_DATASETS_EXPORT DatasetFactory folderFactory();
/// `cvmono`: what OpenCV opens. Folders, archives and patterns (`cvmono:/data/f*.png`) of images in
/// natural order, videos, devices (`cvmono:0`) and addresses (`cvmono:rtsp://...`). Parameters:
/// `rate` (images a second; 0: as the video says, else 30), `every` (takes each such frame),
/// `camera`, `calibration`.
GSLAM_DATASETS_EXPORT DatasetFactory cvMonoFactory();

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_FORMATS_H
