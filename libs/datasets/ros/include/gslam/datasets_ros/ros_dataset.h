#ifndef GSLAM_DATASETS_ROS_ROS_DATASET_H
#define GSLAM_DATASETS_ROS_ROS_DATASET_H

#include <gslam/core/registry.h>
#include <gslam/datasets_ros/export.h>

/// @file
/// Recordings of ROS as datasets.

namespace gslam {
inline namespace v1 {

/// `ros`: recordings of ROS 1 and ROS 2, see Recording.
///
/// Topics are found by their types, unless parameters name them; "none" is none:
///
/// | parameter | what |
/// | --- | --- |
/// | `images` | topics of images, an array or with commas between; default: all. Of one camera that
/// is there raw and compressed, raw | | `camera_info` | topics of calibrations, one an image topic;
/// default: the one beside it | | `imu`, `gnss` | default: the first sensor_msgs/Imu and NavSatFix
/// | | `ground_truth` | poses as readTrajectory() has them; default: the first topic whose name
/// says so (`groundtruth`, `gt`, `vicon`, `optitrack`, `mocap`, `leica` and others) | | `odometry`
/// | poses for Frame::prior; default: none, in recordings without images the first
/// nav_msgs/Odometry | | `tolerance` | seconds between the images of a frame; default 0.01 | |
/// `complete` | only frames with an image of each camera; default false | | `frame_every` |
/// recordings without images: seconds between frames, at least; default 0: each stamp, but of an
/// IMU 0.1 | | `stamps` | "header": when it was measured; "received" opens compressed recordings
/// faster |
///
/// Images are mono8, mono16, 8UC1, 8UC3, 8UC4, 16UC1, 32FC1, rgb8, bgr8, rgba8, bgra8 and bayer
/// ones, or JPEG and PNG, with compressed depth. 16UC1 is depth in millimetres, 32FC1 in metres.
/// `plumb_bob`, `rational_polynomial`, `equidistant` and `fisheye` are the camera models; K of
/// zeros means not calibrated. Poses of cameras come from the static transforms (`/tf_static`)
/// where these link the frames of the messages. The body is the inertial unit where there is one,
/// else the first camera.
///
/// In a recording without images, frames have none: there is one at each stamp of the odometry,
/// else the ground truth, the satellite positions, or the inertial unit. That is said.
///
/// A topic of images that cannot be read is left out, which is said, unless `images` names it. P
/// counts where the last part of a topic's name has the word `rect` or `rectified`. Its fourth
/// column places the right camera of a rectified pair, whose messages name the frame of the left
/// one. Of calibrations the first counts, of a static transform the last; that they change is said.
///
/// Opening reads the head of each image message, for its stamp, and all of the other topics that
/// are used, one topic after another: a compressed recording is unpacked about once for each.
GSLAM_DATASETS_ROS_EXPORT DatasetFactory rosFactory();

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_ROS_DATASET_H
