# gslam_add_plugin(): a shared library that GSLAM loads while it runs. Comes with the package
# GSLAM_core.
#
#   find_package(GSLAM REQUIRED COMPONENTS core)
#   gslam_add_plugin(orb
#     SOURCES orb.cpp tracker.cpp  # one of them says GSLAM_PLUGIN(orb, ...)
#     LINK    Eigen3::Eigen        # beside GSLAM::core
#     STANDARD 17                  # of C++; default: 11
#     INSTALL                      # to lib/gslam/plugins, where programs in bin/ look for it
#     COMPONENT orb)               # install component; default: the target's name
#
# makes the target orb, libgslam_orb.so (with NAME x: libgslam_x.so), whose symbols are hidden but
# for `gslam_plugin`, and which finds libraries beside itself and, installed, in lib/.

function(gslam_add_plugin target)
  cmake_parse_arguments(ARG "INSTALL" "NAME;STANDARD;COMPONENT" "SOURCES;LINK" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS OR NOT ARG_SOURCES)
    message(FATAL_ERROR "gslam_add_plugin(${target}): SOURCES are needed, and these words are not "
      "understood: '${ARG_UNPARSED_ARGUMENTS}'")
  endif()
  if(NOT ARG_NAME)
    set(ARG_NAME ${target})
  endif()
  if(NOT ARG_STANDARD)
    set(ARG_STANDARD 11)
  endif()
  add_library(${target} MODULE ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE GSLAM::core ${ARG_LINK})
  set_target_properties(${target} PROPERTIES
    PREFIX "lib" OUTPUT_NAME gslam_${ARG_NAME} SUFFIX ".so"
    CXX_STANDARD ${ARG_STANDARD} CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    INSTALL_RPATH "$ORIGIN;$ORIGIN/../..")
  if(ARG_INSTALL)
    if(NOT ARG_COMPONENT)
      set(ARG_COMPONENT ${target})
    endif()
    include(GNUInstallDirs)
    install(TARGETS ${target} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/gslam/plugins"
      COMPONENT ${ARG_COMPONENT})
  endif()
endfunction()
