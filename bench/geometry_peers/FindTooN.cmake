# Debian's libtoon-dev comes without a package for CMake. Makes TooN_FOUND and TooN::TooN.
include(FindPackageHandleStandardArgs)
find_path(TooN_INCLUDE_DIR TooN/sim3.h)
mark_as_advanced(TooN_INCLUDE_DIR)
find_package_handle_standard_args(TooN REQUIRED_VARS TooN_INCLUDE_DIR)
if(TooN_FOUND AND NOT TARGET TooN::TooN)
  add_library(TooN::TooN INTERFACE IMPORTED)
  set_target_properties(TooN::TooN PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${TooN_INCLUDE_DIR}")
endif()
