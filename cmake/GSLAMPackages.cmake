# `cpack -G DEB`: one .deb a component, each with its own version and dependencies, and the umbrella
# as libgslam-cmake-dev, on which every other one depends. The command and the plugins are the
# package gslam.

get_property(components GLOBAL PROPERTY GSLAM_COMPONENTS)
_gslam_read_version("${GSLAM_SOURCE_ROOT}" umbrella_version)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gslam)
set(CPACK_PACKAGE_VERSION ${umbrella_version})
set(CPACK_PACKAGE_CONTACT "GSLAM maintainers <gslam@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${GSLAM_SOURCE_ROOT}/LICENSE")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
get_property(programs GLOBAL PROPERTY GSLAM_PROGRAMS)
set(CPACK_COMPONENTS_ALL cmake ${programs} ${components})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_STRIP_FILES OFF)
set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_BINARY_DIR}/GSLAMDebFacts.cmake")

set(CPACK_DEBIAN_CMAKE_PACKAGE_NAME libgslam-cmake-dev)
set(CPACK_DEBIAN_CMAKE_PACKAGE_ARCHITECTURE all)

# CPack knows no version and no summary of a single component: the file made here hands it these,
# when CPack says which component it is at.
set(GSLAM_DEB_FACTS "set(_gslam_version_of_cmake ${umbrella_version})
set(_gslam_summary_of_cmake \"GSLAM: find_package(GSLAM), the umbrella over its components\")
")
foreach(name IN LISTS components)
  foreach(field IN ITEMS VERSION KIND SUMMARY DEPENDS DEBIAN BINARY)
    get_property(${field} GLOBAL PROPERTY GSLAM_${name}_${field})
  endforeach()
  string(APPEND GSLAM_DEB_FACTS "set(_gslam_version_of_${name} ${VERSION})
set(_gslam_summary_of_${name} \"GSLAM ${name}: ${SUMMARY}\")
")
  set(needs "libgslam-cmake-dev" ${DEBIAN})
  while(DEPENDS)
    list(POP_FRONT DEPENDS dependency least)
    _gslam_deb_name(${dependency} deb)
    list(APPEND needs "${deb} (>= ${least})")
  endwhile()
  string(REPLACE ";" ", " needs "${needs}")
  string(TOUPPER ${name} NAME)
  _gslam_deb_name(${name} CPACK_DEBIAN_${NAME}_PACKAGE_NAME)
  set(CPACK_DEBIAN_${NAME}_PACKAGE_DEPENDS "${needs}")
  if(KIND STREQUAL headers)
    set(CPACK_DEBIAN_${NAME}_PACKAGE_ARCHITECTURE all)
  else()
    set(CPACK_DEBIAN_${NAME}_PACKAGE_SHLIBDEPS ON)
    list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${BINARY}")
  endif()
endforeach()

foreach(name IN LISTS programs)  # what is run, not linked
  string(TOUPPER ${name} NAME)
  string(APPEND GSLAM_DEB_FACTS "set(_gslam_version_of_${name} ${umbrella_version})
set(_gslam_summary_of_${name} \"${PROJECT_DESCRIPTION}: the command\")
")
  set(CPACK_DEBIAN_${NAME}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${NAME}_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_${NAME}_PACKAGE_SHLIBDEPS ON)
endforeach()

configure_file("${GSLAM_CMAKE_DIR}/GSLAMDebFacts.cmake.in"
  "${CMAKE_BINARY_DIR}/GSLAMDebFacts.cmake" @ONLY)
include(CPack)
