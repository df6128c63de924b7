// Files of other projects: calibrations, data sets, bags.
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <string>

#include "test_data.h"

namespace {

using gslam::loadYaml;
using gslam::parseJson;
using gslam::Svar;

Svar load(const std::string& name) {
  return loadYaml(test_data::folder() + name);
}

// Every file must come back from what is printed of it, in both formats.
const char* const kFiles[] = {
    "bags/ros2/talker/metadata.yaml",
    "bags/ros2/wbag/metadata.yaml",
    "bags/ros2_mcap/talker/metadata.yaml",
    "bags/ros2_mcap/wbag/metadata.yaml",
    "calibrations/equidistant/ORB_SLAM3_TUM-VI_KB8.yaml",
    "calibrations/kalibr/euroc_mav/estimator_config.yaml",
    "calibrations/kalibr/euroc_mav/kalibr_imu_chain.yaml",
    "calibrations/kalibr/euroc_mav/kalibr_imucam_chain.yaml",
    "calibrations/kalibr/rs_d455/estimator_config.yaml",
    "calibrations/kalibr/rs_d455/kalibr_imu_chain.yaml",
    "calibrations/kalibr/rs_d455/kalibr_imucam_chain.yaml",
    "calibrations/kalibr/tum_vi/estimator_config.yaml",
    "calibrations/kalibr/tum_vi/kalibr_imu_chain.yaml",
    "calibrations/kalibr/tum_vi/kalibr_imucam_chain.yaml",
    "calibrations/rpg_svo_camera_atan.yaml",
    "calibrations/stella_vslam/aist/equirectangular.yaml",
    "calibrations/stella_vslam/aist/fisheye.yaml",
    "calibrations/stella_vslam/euroc/EuRoC_mono.yaml",
    "calibrations/stella_vslam/euroc/EuRoC_stereo.yaml",
    "calibrations/stella_vslam/kitti/KITTI_mono_00-02.yaml",
    "calibrations/stella_vslam/kitti/KITTI_mono_03.yaml",
    "calibrations/stella_vslam/kitti/KITTI_mono_04-12.yaml",
    "calibrations/stella_vslam/kitti/KITTI_stereo_00-02.yaml",
    "calibrations/stella_vslam/kitti/KITTI_stereo_03.yaml",
    "calibrations/stella_vslam/kitti/KITTI_stereo_04-12.yaml",
    "calibrations/stella_vslam/tum_rgbd/TUM_RGBD_mono_1.yaml",
    "calibrations/stella_vslam/tum_rgbd/TUM_RGBD_mono_2.yaml",
    "calibrations/stella_vslam/tum_rgbd/TUM_RGBD_mono_3.yaml",
    "calibrations/stella_vslam/tum_rgbd/TUM_RGBD_rgbd_1.yaml",
    "calibrations/stella_vslam/tum_rgbd/TUM_RGBD_rgbd_2.yaml",
    "calibrations/stella_vslam/tum_rgbd/TUM_RGBD_rgbd_3.yaml",
    "calibrations/stella_vslam/tum_vi/TUM_VI_mono.yaml",
    "calibrations/stella_vslam/tum_vi/TUM_VI_stereo.yaml",
    "sequences/euroc_V1_01_easy/mav0/body.yaml",
    "sequences/euroc_V1_01_easy/mav0/cam0/sensor.yaml",
    "sequences/euroc_V1_01_easy/mav0/cam1/sensor.yaml",
    "sequences/euroc_V1_01_easy/mav0/imu0/sensor.yaml",
    "sequences/euroc_V1_01_easy/mav0/state_groundtruth_estimate0/sensor.yaml"};

TEST(RealFiles, ComeBackFromWhatIsPrinted) {
  NEEDS_TEST_DATA();
  for (const char* const name : kFiles) {
    SCOPED_TRACE(name);
    const Svar value = load(name);
    EXPECT_EQ(value.type(), gslam::SvarType::object);
    EXPECT_GT(value.size(), 0u);
    EXPECT_EQ(gslam::parseYaml(gslam::printYaml(value)), value);
    EXPECT_EQ(gslam::parseXml(gslam::printXml(value)), value);
  }
}

TEST(RealFiles, OrbSlam) {
  NEEDS_TEST_DATA();
  const Svar file = load("calibrations/equidistant/ORB_SLAM3_TUM-VI_KB8.yaml");
  EXPECT_EQ(file["File.version"], Svar("1.0"));
  EXPECT_EQ(file["Camera.type"], Svar("KannalaBrandt8"));
  EXPECT_EQ(file["Camera1.fx"], Svar(190.97847715128717));
  EXPECT_EQ(file["Camera1.k3"], Svar(-0.0020532361418706202));
  EXPECT_EQ(file["Camera.width"], Svar(512));
}

TEST(RealFiles, Kalibr) {
  NEEDS_TEST_DATA();
  const Svar chain = load("calibrations/kalibr/euroc_mav/kalibr_imucam_chain.yaml");
  EXPECT_EQ(chain["cam0"]["T_imu_cam"][1],
            Svar::array({0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768}));
  EXPECT_EQ(chain["cam1"]["distortion_coeffs"],
            Svar::array({-0.28368365, 0.07451284, -0.00010473, -3.55590700e-05}));
  EXPECT_EQ(chain["cam1"]["resolution"], Svar::array({752, 480}));
  EXPECT_EQ(chain["cam1"]["rostopic"], Svar("/cam1/image_raw"));
  const Svar config = load("calibrations/kalibr/euroc_mav/estimator_config.yaml");
  EXPECT_EQ(config["use_fej"], Svar(true));
  EXPECT_EQ(config["integration"], Svar("rk4"));
  EXPECT_EQ(config["init_dyn_min_rec_cond"], Svar(1e-12));
  EXPECT_EQ(config["init_dyn_bias_g"], Svar::array({0.0, 0.0, 0.0}));
}

TEST(RealFiles, StellaVslam) {
  NEEDS_TEST_DATA();
  const Svar stereo = load("calibrations/stella_vslam/euroc/EuRoC_stereo.yaml");
  EXPECT_EQ(stereo["Camera"]["name"], Svar("EuRoC stereo"));
  EXPECT_EQ(stereo["Camera"]["fps"], Svar(20.0));
  EXPECT_EQ(stereo["Camera"]["cols"], Svar(752));
  EXPECT_EQ(stereo["StereoRectifier"]["R_left"].size(), 9u);
  EXPECT_EQ(stereo["StereoRectifier"]["R_left"][8], Svar(0.9999424675829176));
  EXPECT_EQ(stereo["StereoRectifier"]["K_right"][8], Svar(1));
  EXPECT_EQ(stereo["Mapping"]["erase_temporal_keyframes"], Svar(false));
  const Svar sphere = load("calibrations/stella_vslam/aist/equirectangular.yaml");
  EXPECT_EQ(sphere["Preprocessing"]["mask_rectangles"][1], Svar::array({0.0, 1.0, 0.84, 1.0}));
  const Svar depth = load("calibrations/stella_vslam/tum_rgbd/TUM_RGBD_rgbd_3.yaml");
  EXPECT_EQ(depth["Preprocessing"]["depthmap_factor"], Svar(5000.0));
}

TEST(RealFiles, Euroc) {
  NEEDS_TEST_DATA();
  EXPECT_EQ(load("sequences/euroc_V1_01_easy/mav0/body.yaml"),
            Svar::object({{"comment", "Asctec Firefly MAV"}}));
  const Svar camera = load("sequences/euroc_V1_01_easy/mav0/cam0/sensor.yaml");
  EXPECT_EQ(camera["T_BS"]["data"].size(), 16u);
  EXPECT_EQ(camera["T_BS"]["data"][11], Svar(0.00981073058949));
  EXPECT_EQ(camera["intrinsics"], Svar::array({458.654, 457.296, 367.215, 248.375}));
  EXPECT_EQ(camera["comment"], Svar("VI-Sensor cam0 (MT9M034)"));
}

TEST(RealFiles, RosBags) {
  NEEDS_TEST_DATA();
  const Svar bag = load("bags/ros2/talker/metadata.yaml")["rosbag2_bagfile_information"];
  EXPECT_EQ(bag["starting_time"]["nanoseconds_since_epoch"],
            Svar(std::int64_t(1585866235112411371)));
  EXPECT_EQ(bag["relative_file_paths"], Svar::array({"talker.db3"}));
  EXPECT_EQ(bag["topics_with_message_count"].size(), 3u);
  EXPECT_EQ(bag["compression_format"], Svar(""));
  // Two writers, one with the profile on one line, one with it broken over several.
  const auto profile = [](const Svar& information) {
    return information["topics_with_message_count"][0]["topic_metadata"]["offered_qos_profiles"];
  };
  const Svar other = load("bags/ros2_mcap/talker/metadata.yaml")["rosbag2_bagfile_information"];
  EXPECT_EQ(profile(bag), profile(other));
  EXPECT_EQ(profile(bag).as<std::string>().substr(0, 24), "- history: 3\n  depth: 0\n");
}

}  // namespace
