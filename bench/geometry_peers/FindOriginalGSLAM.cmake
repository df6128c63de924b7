# The GSLAM of 2019, of which three headers are used. Makes OriginalGSLAM_FOUND and
# OriginalGSLAM::OriginalGSLAM; -DOriginalGSLAM_INCLUDE_DIR=<its checkout> says where it is.
include(FindPackageHandleStandardArgs)
find_path(OriginalGSLAM_INCLUDE_DIR GSLAM/core/SIM3.h)
mark_as_advanced(OriginalGSLAM_INCLUDE_DIR)
find_package_handle_standard_args(OriginalGSLAM REQUIRED_VARS OriginalGSLAM_INCLUDE_DIR)
if(OriginalGSLAM_FOUND AND NOT TARGET OriginalGSLAM::OriginalGSLAM)
  add_library(OriginalGSLAM::OriginalGSLAM INTERFACE IMPORTED)
  set_target_properties(OriginalGSLAM::OriginalGSLAM PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${OriginalGSLAM_INCLUDE_DIR}")
endif()
