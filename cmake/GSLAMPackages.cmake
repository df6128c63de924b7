# `cpack -G DEB`: one .deb a component, each with its own version and dependencies, and the umbrella
# as libgslam-cmake-dev, on which every other one depends.

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
set(CPACK_COMPONENTS_ALL cmake ${components})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_STRIP_FILES OFF)
set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_BINARY_DIR}/GSLAMDebVersions.cmake")

set(CPACK_DEBIAN_CMAKE_PACKAGE_NAME libgslam-cmake-dev)
set(CPACK_DEBIAN_CMAKE_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_CMAKE_DESCRIPTION "find_package(GSLAM): the umbrella over its components")

# CPack knows no version for a single component: the file made here hands it one, when CPack says
# which component it is at.
set(GSLAM_DEB_VERSIONS "cmake;${umbrella_version}")
foreach(name IN LISTS components)
  foreach(field IN ITEMS VERSION KIND SUMMARY DEPENDS DEBIAN)
    get_property(${field} GLOBAL PROPERTY GSLAM_${name}_${field})
  endforeach()
  list(APPEND GSLAM_DEB_VERSIONS ${name} ${VERSION})
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
  set(CPACK_COMPONENT_${NAME}_DESCRIPTION "${SUMMARY}")
  if(KIND STREQUAL headers)
    set(CPACK_DEBIAN_${NAME}_PACKAGE_ARCHITECTURE all)
  else()
    set(CPACK_DEBIAN_${NAME}_PACKAGE_SHLIBDEPS ON)
  endif()
endforeach()

configure_file("${GSLAM_CMAKE_DIR}/GSLAMDebVersions.cmake.in"
  "${CMAKE_BINARY_DIR}/GSLAMDebVersions.cmake" @ONLY)
include(CPack)
