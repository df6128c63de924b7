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
/// datasetFormats() has it. Looks at names of files and the heads of a few, reads no image.
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

GSLAM_DATASETS_EXPORT DatasetFactory kittiFactory();     ///< `kitti`: KITTI odometry
GSLAM_DATASETS_EXPORT DatasetFactory kittiRawFactory();  ///< `kittiraw`: KITTI raw
GSLAM_DATASETS_EXPORT DatasetFactory tumFactory();       ///< `tum`: TUM RGB-D
GSLAM_DATASETS_EXPORT DatasetFactory iclFactory();       ///< `icl`: ICL-NUIM
/// `tummono`: TUM monoVO. images/ or images.zip, times.txt with exposures, camera.txt, poses at the
/// begin and the end. `photometric`: "none"; "u8" or "f32", whose pixels are the irradiance times
/// exposure, by pcalib.txt and vignette.png, as 8-bit numbers or floats (0 to 255 without
/// vignette). `camera`, `calibration`: in place of camera.txt, see cvMonoFactory().
GSLAM_DATASETS_EXPORT DatasetFactory tumMonoFactory();
/// `euroc`: EuRoC MAV and others in the ASL layout: the folder around mav0, or mav0. `cameras`:
/// numbers of those to read, "0" or "0,1"; "": all. `list`: the file of each camera that names its
/// images, "data.csv". `tolerance`: most seconds between the images of a frame, 0. `calibration`: a
/// file that readCalibration() reads, in place of what sensor.yaml says. `truth`: the folder of the
/// ground truth; "": the first of state_groundtruth_estimate0, mocap0, vicon0; leica0 has positions
/// only.
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
GSLAM_DATASETS_EXPORT DatasetFactory sevenScenesFactory();  ///< `7scenes`: Microsoft 7-Scenes
GSLAM_DATASETS_EXPORT DatasetFactory strechaFactory();      ///< `strecha`: Strecha multi-view
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
