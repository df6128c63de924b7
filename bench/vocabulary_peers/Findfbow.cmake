# FBoW, whose own package for CMake has no target.
# Makes fbow_FOUND and fbow::fbow; its prefix is in CMAKE_PREFIX_PATH.
include(FindPackageHandleStandardArgs)
find_path(fbow_INCLUDE_DIR fbow/fbow.h)
find_library(fbow_LIBRARY fbow)
mark_as_advanced(fbow_INCLUDE_DIR fbow_LIBRARY)
find_package_handle_standard_args(fbow REQUIRED_VARS fbow_LIBRARY fbow_INCLUDE_DIR)
if(fbow_FOUND AND NOT TARGET fbow::fbow)
  add_library(fbow::fbow UNKNOWN IMPORTED)
  set_target_properties(fbow::fbow PROPERTIES
    IMPORTED_LOCATION "${fbow_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${fbow_INCLUDE_DIR}")
endif()
