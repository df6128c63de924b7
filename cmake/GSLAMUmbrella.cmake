# The umbrella package: find_package(GSLAM [COMPONENTS ...]), install component "cmake".
# Its content depends on the checkout alone, so it is the same from whichever build it comes.

# The tested set, as "name;version;name;version": every gslam_component() of the checkout.
function(_gslam_tested_set out)
  set(tested "")
  file(GLOB lists LIST_DIRECTORIES OFF CONFIGURE_DEPENDS
    "${GSLAM_SOURCE_ROOT}/libs/*/CMakeLists.txt" "${GSLAM_SOURCE_ROOT}/libs/*/*/CMakeLists.txt")
  foreach(list IN LISTS lists)
    file(STRINGS "${list}" calls REGEX "^gslam_component\\(")
    get_filename_component(folder "${list}" DIRECTORY)
    foreach(call IN LISTS calls)
      if(NOT call MATCHES "^gslam_component\\( *([a-z0-9_]+)")
        message(FATAL_ERROR "${list}: the name must follow gslam_component( on the same line")
      endif()
      set(name "${CMAKE_MATCH_1}")
      _gslam_read_version("${folder}" version)
      list(APPEND tested ${name} ${version})
    endforeach()
  endforeach()
  set(${out} "${tested}" PARENT_SCOPE)
endfunction()

function(gslam_umbrella)
  get_property(done GLOBAL PROPERTY GSLAM_UMBRELLA_DONE)
  if(done)
    return()
  endif()
  set_property(GLOBAL PROPERTY GSLAM_UMBRELLA_DONE ON)
  _gslam_read_version("${GSLAM_SOURCE_ROOT}" GSLAM_UMBRELLA_VERSION)
  _gslam_tested_set(GSLAM_TESTED_SET)
  set(folder "${GSLAM_BINARY_ROOT}/umbrella")
  configure_file("${GSLAM_CMAKE_DIR}/GSLAMConfig.cmake.in" "${folder}/GSLAMConfig.cmake" @ONLY)
  write_basic_package_version_file("${folder}/GSLAMConfigVersion.cmake"
    VERSION ${GSLAM_UMBRELLA_VERSION} COMPATIBILITY SameMajorVersion ARCH_INDEPENDENT)
  install(FILES "${folder}/GSLAMConfig.cmake" "${folder}/GSLAMConfigVersion.cmake"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/cmake/GSLAM" COMPONENT cmake)
endfunction()
