# PBA, the multicore bundle adjustment of Wu et al., built for the CPU (PBA_NO_GPU); it has no
# package for CMake. Makes PBA_FOUND and PBA::PBA; its prefix is in CMAKE_PREFIX_PATH.
include(FindPackageHandleStandardArgs)
find_package(Threads QUIET)
find_path(PBA_INCLUDE_DIR pba/pba.h)
find_library(PBA_LIBRARY NAMES pba pba_no_gpu)
mark_as_advanced(PBA_INCLUDE_DIR PBA_LIBRARY)
find_package_handle_standard_args(PBA REQUIRED_VARS PBA_LIBRARY PBA_INCLUDE_DIR Threads_FOUND)
if(PBA_FOUND AND NOT TARGET PBA::PBA)
  add_library(PBA::PBA UNKNOWN IMPORTED)
  set_target_properties(PBA::PBA PROPERTIES
    IMPORTED_LOCATION "${PBA_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${PBA_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES Threads::Threads)
endif()
