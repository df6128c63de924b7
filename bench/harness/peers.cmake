# gslam_add_peer_bench(<target> SOURCES ... LINK GSLAM::...): our side, and peers that need nothing.
function(gslam_add_peer_bench target)
  gslam_add_bench(${target} STANDARD 17 ${ARGN})
endfunction()

# gslam_add_peer(<target> <peer> PACKAGE name [version] LINK ... SOURCES ...)
# Adds the peer's part where find_package finds it; says aloud when it is skipped. Nothing of other
# projects is copied or downloaded.
function(gslam_add_peer target peer)
  cmake_parse_arguments(ARG "" "" "PACKAGE;LINK;SOURCES" ${ARGN})
  find_package(${ARG_PACKAGE} QUIET)
  list(GET ARG_PACKAGE 0 package)
  if(NOT ${package}_FOUND)
    message(STATUS "${target}: peer ${peer} skipped, find_package(${package}) found nothing")
    return()
  endif()
  message(STATUS "${target}: peer ${peer} found, ${package} ${${package}_VERSION}")
  # An object library of its own, so that a peer's flags do not change how we are compiled.
  add_library(${target}_${peer} OBJECT ${ARG_SOURCES})
  set_target_properties(${target}_${peer} PROPERTIES CXX_STANDARD 17 CXX_EXTENSIONS OFF)
  target_link_libraries(${target}_${peer} PRIVATE gslam_bench_main ${ARG_LINK})
  target_link_libraries(${target} PRIVATE ${target}_${peer} ${ARG_LINK})
endfunction()
