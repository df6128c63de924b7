# DBoW3, whose own package for CMake has no target.
# Makes DBoW3_FOUND and DBoW3::DBoW3; its prefix is in CMAKE_PREFIX_PATH.
include(FindPackageHandleStandardArgs)
find_path(DBoW3_INCLUDE_DIR DBoW3/Vocabulary.h)
find_library(DBoW3_LIBRARY DBoW3)
mark_as_advanced(DBoW3_INCLUDE_DIR DBoW3_LIBRARY)
find_package_handle_standard_args(DBoW3 REQUIRED_VARS DBoW3_LIBRARY DBoW3_INCLUDE_DIR)
if(DBoW3_FOUND AND NOT TARGET DBoW3::DBoW3)
  add_library(DBoW3::DBoW3 UNKNOWN IMPORTED)
  set_target_properties(DBoW3::DBoW3 PROPERTIES
    IMPORTED_LOCATION "${DBoW3_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${DBoW3_INCLUDE_DIR}")
endif()
