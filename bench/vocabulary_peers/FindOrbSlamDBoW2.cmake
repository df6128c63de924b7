# The copy of DBoW2 inside ORB-SLAM2, which is never installed: its sources are compiled here, with
# another name for its namespace. Makes OrbSlamDBoW2_FOUND and OrbSlamDBoW2::DBoW2;
# -DOrbSlamDBoW2_INCLUDE_DIR=<a checkout of ORB-SLAM2>/Thirdparty/DBoW2 says where it is.
include(FindPackageHandleStandardArgs)
find_path(OrbSlamDBoW2_INCLUDE_DIR DUtils/Timestamp.cpp)
mark_as_advanced(OrbSlamDBoW2_INCLUDE_DIR)
find_package_handle_standard_args(OrbSlamDBoW2 REQUIRED_VARS OrbSlamDBoW2_INCLUDE_DIR)
if(OrbSlamDBoW2_FOUND AND NOT TARGET OrbSlamDBoW2::DBoW2)
  set(sources DBoW2/BowVector.cpp DBoW2/FORB.cpp DBoW2/FeatureVector.cpp DBoW2/ScoringObject.cpp
    DUtils/Random.cpp DUtils/Timestamp.cpp)
  list(TRANSFORM sources PREPEND "${OrbSlamDBoW2_INCLUDE_DIR}/")
  add_library(orb_slam_dbow2 STATIC ${sources})
  set_target_properties(orb_slam_dbow2 PROPERTIES CXX_STANDARD 14)
  target_compile_definitions(orb_slam_dbow2 PRIVATE DBoW2=OrbSlamDBoW2)
  target_compile_options(orb_slam_dbow2 PRIVATE -O3 -w)
  target_include_directories(orb_slam_dbow2 SYSTEM PUBLIC "${OrbSlamDBoW2_INCLUDE_DIR}")
  target_link_libraries(orb_slam_dbow2 PRIVATE opencv_core)
  add_library(OrbSlamDBoW2::DBoW2 ALIAS orb_slam_dbow2)
endif()
