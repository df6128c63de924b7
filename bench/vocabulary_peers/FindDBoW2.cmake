# DBoW2, whose own package for CMake has no target.
# Makes DBoW2_FOUND and DBoW2::DBoW2; its prefix is in CMAKE_PREFIX_PATH.
include(FindPackageHandleStandardArgs)
find_path(DBoW2_INCLUDE_DIR DBoW2/TemplatedDatabase.h)
find_library(DBoW2_LIBRARY DBoW2)
mark_as_advanced(DBoW2_INCLUDE_DIR DBoW2_LIBRARY)
find_package_handle_standard_args(DBoW2 REQUIRED_VARS DBoW2_LIBRARY DBoW2_INCLUDE_DIR)
if(DBoW2_FOUND AND NOT TARGET DBoW2::DBoW2)
  add_library(DBoW2::DBoW2 UNKNOWN IMPORTED)
  set_target_properties(DBoW2::DBoW2 PROPERTIES
    IMPORTED_LOCATION "${DBoW2_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${DBoW2_INCLUDE_DIR}")
endif()
