# gslam_component(): from a dozen lines in a library's CMakeLists.txt to a package.
#
#   gslam_component(estimator
#     SUMMARY  "Minimal solvers and a robust loop"
#     KIND     compiled                # or: headers
#     STANDARD 17                      # C++ standard its users need; default 11
#     DEPENDS  base 1.0  geometry 1.2  # other components, each with the least version
#     SOURCES  src/p3p.cpp             # compiled only
#     PACKAGES Threads                 # packages that users of the component must find, too
#     LINK     Threads::Threads        # ... and what it links from them
#     PRIVATE_PACKAGES "ZLIB 1.2"      # the same for what only its .cpp files see: users of the
#     PRIVATE_LINK     ZLIB::ZLIB      #     static library still need it to link
#     PKGCONFIG -lz                    # the linker's words for what is linked, but Threads::Threads
#     DEBIAN   zlib1g-dev              # Debian packages that hold those packages
#     COMMANDS GSLAMPlugin)            # files of cmake/ whose commands its users get, too
#
# makes, from the folder it is called in (include/ src/ tests/ bench/ examples/ VERSION README.md):
#   target gslam_<name>, alias GSLAM::<name>; generated header gslam/<name>/version.h and, for a
#   compiled one, gslam/<name>/export.h; the package GSLAM_<name> with config, version and
#   pkg-config files, all in the install component <name>; one test program, one benchmark program
#   and one program for each example. A package inside another library's folder (svar_formats) is a
#   sub-folder of the same shape that has no VERSION of its own, which the library adds by
#
#   gslam_package_inside(formats NEEDS yaml-cpp pugixml)
#
#   and which is left out, aloud, where what it needs is not installed. Asked for by its name, it
#   is not.

include_guard(DIRECTORY)  # each folder that a foreign project adds needs these variables anew
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(GenerateExportHeader)

get_filename_component(GSLAM_SOURCE_ROOT "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)
set(GSLAM_CMAKE_DIR "${CMAKE_CURRENT_LIST_DIR}")

include("${GSLAM_CMAKE_DIR}/GSLAMDevelop.cmake")
include("${GSLAM_CMAKE_DIR}/GSLAMInstall.cmake")
include("${GSLAM_CMAKE_DIR}/GSLAMRooms.cmake")
include("${GSLAM_CMAKE_DIR}/GSLAMUmbrella.cmake")

function(gslam_component name)
  cmake_parse_arguments(ARG "" "SUMMARY;KIND;STANDARD"
    "DEPENDS;SOURCES;PACKAGES;LINK;PRIVATE_PACKAGES;PRIVATE_LINK;PKGCONFIG;DEBIAN;COMMANDS" ${ARGN})
  get_property(begun GLOBAL PROPERTY GSLAM_${name}_BEGUN)
  if(begun)
    return()  # somebody who needed it was added before it, or it needs the library around it
  endif()
  set_property(GLOBAL PROPERTY GSLAM_${name}_BEGUN ON)
  if(ARG_UNPARSED_ARGUMENTS OR NOT ARG_SUMMARY OR NOT ARG_KIND MATCHES "^(headers|compiled)$")
    message(FATAL_ERROR "gslam_component(${name}): SUMMARY and KIND headers|compiled are needed, "
      "and these words are not understood: '${ARG_UNPARSED_ARGUMENTS}'")
  endif()
  if(NOT ARG_STANDARD)
    set(ARG_STANDARD 11)
  endif()
  _gslam_read_version("${CMAKE_CURRENT_SOURCE_DIR}" version)
  _gslam_check_room(${name} "${ARG_DEPENDS}")
  _gslam_add_dependencies(${name} "${ARG_DEPENDS}" dependency_targets)
  foreach(package IN LISTS ARG_PACKAGES ARG_PRIVATE_PACKAGES)
    separate_arguments(words UNIX_COMMAND "${package}")
    find_package(${words} REQUIRED)
  endforeach()

  set(target gslam_${name})
  if(ARG_KIND STREQUAL headers)
    add_library(${target} INTERFACE)
    set(visibility INTERFACE)
  else()
    add_library(${target} ${ARG_SOURCES})
    set(visibility PUBLIC)
    _gslam_set_up_compiled(${name} ${version} "${ARG_PRIVATE_LINK}")
  endif()
  add_library(GSLAM::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} ${visibility} cxx_std_${ARG_STANDARD})
  target_include_directories(${target} ${visibility}
    "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>"
    "$<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}/include>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_link_libraries(${target} ${visibility} ${dependency_targets} ${ARG_LINK})

  _gslam_write_version_header(${name} ${version})
  foreach(file IN LISTS ARG_COMMANDS)
    include("${GSLAM_CMAKE_DIR}/${file}.cmake")
  endforeach()
  if(GSLAM_INSTALL)
    _gslam_install_component(${name} ${version} ${ARG_KIND} "${ARG_SUMMARY}" "${ARG_DEPENDS}"
      "${ARG_PACKAGES}" "${ARG_PRIVATE_PACKAGES}" "${ARG_LINK};${ARG_PRIVATE_LINK}"
      "${ARG_PKGCONFIG}" "${ARG_COMMANDS}")
    gslam_umbrella()
  endif()
  _gslam_record_component(${name} ${version} ${ARG_KIND} ${ARG_STANDARD} "${ARG_SUMMARY}"
    "${ARG_DEPENDS}" "${ARG_DEBIAN}")
  _gslam_add_programs(${name} ${ARG_STANDARD})
endfunction()

# Adds the package in a sub-folder of this library, unless it is what needs this library. In a foreign
# project it is built by whoever links it.
function(gslam_package_inside folder)
  cmake_parse_arguments(ARG "" "" "NEEDS" ${ARGN})
  get_filename_component(library "${CMAKE_CURRENT_SOURCE_DIR}" NAME)
  get_property(begun GLOBAL PROPERTY GSLAM_${library}_${folder}_BEGUN)
  foreach(package IN LISTS ARG_NEEDS)
    find_package(${package} QUIET)
    if(NOT ${package}_FOUND AND NOT begun)
      message(STATUS "${library}_${folder} is left out: ${package} is not installed")
      return()
    endif()
  endforeach()
  if(NOT begun AND GSLAM_INSTALL)
    add_subdirectory(${folder})
  elseif(NOT begun)
    add_subdirectory(${folder} EXCLUDE_FROM_ALL)
  endif()
endfunction()

# VERSION of the folder, or of the library folder around it.
function(_gslam_read_version folder out)
  if(NOT EXISTS "${folder}/VERSION")
    get_filename_component(folder "${folder}" DIRECTORY)
  endif()
  if(NOT EXISTS "${folder}/VERSION")
    message(FATAL_ERROR "${folder}: no VERSION file (one line, such as 1.0.0)")
  endif()
  file(STRINGS "${folder}/VERSION" version LIMIT_COUNT 1)
  if(NOT version MATCHES "^[0-9]+\\.[0-9]+\\.[0-9]+$")
    message(FATAL_ERROR "${folder}/VERSION says '${version}', expected MAJOR.MINOR.PATCH")
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${folder}/VERSION")
  set(${out} ${version} PARENT_SCOPE)
endfunction()

# Where a component is below libs/: <name>, or for svar_formats svar/formats; empty where it is not.
function(_gslam_find_folder name out)
  set(${out} "" PARENT_SCOPE)
  string(REGEX REPLACE "_" "/" nested "${name}")
  foreach(folder IN ITEMS ${nested} ${name})
    if(EXISTS "${GSLAM_SOURCE_ROOT}/libs/${folder}/CMakeLists.txt")
      set(${out} "${folder}" PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# Makes GSLAM::<dependency> exist: built beside us when the checkout has it, else as a package.
function(_gslam_add_dependencies name depends out)
  set(targets "")
  while(depends)
    list(POP_FRONT depends dependency least)
    if(NOT least MATCHES "^[0-9]+(\\.[0-9]+)*$")
      message(FATAL_ERROR "gslam_component(${name}): DEPENDS ${dependency} needs a version after it")
    endif()
    _gslam_find_folder(${dependency} folder)
    if(NOT TARGET GSLAM::${dependency} AND folder)
      if(NOT GSLAM_IS_WHOLE)
        set(GSLAM_BUILD_TESTS OFF)  # only what was asked for is tested
        set(GSLAM_BUILD_BENCH OFF)
        set(GSLAM_BUILD_EXAMPLES OFF)
      endif()
      add_subdirectory("${GSLAM_SOURCE_ROOT}/libs/${folder}" "${GSLAM_BINARY_ROOT}/libs/${folder}")
    elseif(NOT TARGET GSLAM::${dependency})
      find_package(GSLAM_${dependency} ${least} CONFIG REQUIRED)
    endif()
    get_property(version GLOBAL PROPERTY GSLAM_${dependency}_VERSION)
    string(REGEX MATCH "^[0-9]+" major "${least}")
    if(version AND (version VERSION_LESS least OR NOT version MATCHES "^${major}\\."))
      message(FATAL_ERROR "gslam_component(${name}): needs ${dependency} ${least} or a later "
        "${major}.x, but libs/${dependency} is version ${version}")
    endif()
    list(APPEND targets GSLAM::${dependency})
  endwhile()
  set(${out} "${targets}" PARENT_SCOPE)
endfunction()

function(_gslam_set_up_compiled name version private_link)
  string(REGEX MATCH "^[0-9]+" major ${version})
  string(TOUPPER ${name} NAME)
  set_target_properties(gslam_${name} PROPERTIES
    VERSION ${version} SOVERSION ${major}
    CXX_EXTENSIONS OFF
    POSITION_INDEPENDENT_CODE ON  # static ones end up in plugins
    INSTALL_RPATH "$ORIGIN"       # shared ones find each other wherever they were moved
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  generate_export_header(gslam_${name} BASE_NAME gslam_${name}
    EXPORT_MACRO_NAME GSLAM_${NAME}_EXPORT
    EXPORT_FILE_NAME include/gslam/${name}/export.h)
  get_target_property(type gslam_${name} TYPE)
  if(type STREQUAL STATIC_LIBRARY)
    target_compile_definitions(gslam_${name} PUBLIC GSLAM_${NAME}_STATIC_DEFINE)
  endif()
  target_link_libraries(gslam_${name} PRIVATE ${private_link})
  gslam_strict(gslam_${name})
endfunction()

function(_gslam_write_version_header name version)
  string(TOUPPER ${name} NAME)
  string(REPLACE "." ";" parts ${version})
  list(GET parts 0 VERSION_MAJOR)
  list(GET parts 1 VERSION_MINOR)
  list(GET parts 2 VERSION_PATCH)
  set(VERSION ${version})
  configure_file("${GSLAM_CMAKE_DIR}/version.h.in"
    "${CMAKE_CURRENT_BINARY_DIR}/include/gslam/${name}/version.h" @ONLY)
endfunction()

# What the umbrella, the packages, the docs and the tests at the top need to know.
function(_gslam_record_component name version kind standard summary depends debian)
  set_property(GLOBAL APPEND PROPERTY GSLAM_COMPONENTS ${name})
  set_property(GLOBAL PROPERTY GSLAM_${name}_VERSION ${version})
  set_property(GLOBAL PROPERTY GSLAM_${name}_KIND ${kind})
  set_property(GLOBAL PROPERTY GSLAM_${name}_STANDARD ${standard})
  set_property(GLOBAL PROPERTY GSLAM_${name}_SUMMARY "${summary}")
  set_property(GLOBAL PROPERTY GSLAM_${name}_DEPENDS "${depends}")
  set_property(GLOBAL PROPERTY GSLAM_${name}_DEBIAN "${debian}")
  set_property(GLOBAL PROPERTY GSLAM_${name}_FOLDER "${CMAKE_CURRENT_SOURCE_DIR}")
  set_property(GLOBAL PROPERTY GSLAM_${name}_BINARY "${CMAKE_CURRENT_BINARY_DIR}")
  set_property(GLOBAL PROPERTY GSLAM_${name}_GENERATED "${CMAKE_CURRENT_BINARY_DIR}/include")
endfunction()
