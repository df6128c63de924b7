# Install rules of one component: headers, library, package config, pkg-config file, licence.
# Everything lands in the install component of the same name.

function(_gslam_install_component name version kind summary depends
         packages private_packages link pkgconfig commands)
  if(kind STREQUAL headers)
    set(data_dir "${CMAKE_INSTALL_DATADIR}")
    set(arch ARCH_INDEPENDENT)
  else()
    set(data_dir "${CMAKE_INSTALL_LIBDIR}")
    set(arch "")
  endif()
  set(config_dir "${data_dir}/cmake/GSLAM_${name}")

  install(DIRECTORY include/ "${CMAKE_CURRENT_BINARY_DIR}/include/"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT ${name} FILES_MATCHING PATTERN "*.h")
  install(TARGETS gslam_${name} EXPORT GSLAM_${name}Targets
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${name}
      NAMELINK_COMPONENT ${name}
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${name}
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT ${name})
  install(EXPORT GSLAM_${name}Targets NAMESPACE GSLAM::
    DESTINATION "${config_dir}" COMPONENT ${name})

  set(NAME ${name})
  set(VERSION ${version})
  get_target_property(type gslam_${name} TYPE)
  if(type STREQUAL STATIC_LIBRARY)
    list(APPEND packages ${private_packages})
  endif()
  _gslam_dependency_lines(${name} ${version} "${depends}" "${packages}" FIND_DEPENDENCIES)
  set(INCLUDE_COMMANDS "")
  foreach(file IN LISTS commands)
    install(FILES "${GSLAM_CMAKE_DIR}/${file}.cmake" DESTINATION "${config_dir}" COMPONENT ${name})
    string(APPEND INCLUDE_COMMANDS "include(\"\${CMAKE_CURRENT_LIST_DIR}/${file}.cmake\")\n")
  endforeach()
  configure_package_config_file("${GSLAM_CMAKE_DIR}/component-config.cmake.in"
    "${CMAKE_CURRENT_BINARY_DIR}/GSLAM_${name}Config.cmake"
    INSTALL_DESTINATION "${config_dir}" NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
  write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/GSLAM_${name}ConfigVersion.cmake"
    VERSION ${version} COMPATIBILITY SameMajorVersion ${arch})
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/GSLAM_${name}Config.cmake"
    "${CMAKE_CURRENT_BINARY_DIR}/GSLAM_${name}ConfigVersion.cmake"
    DESTINATION "${config_dir}" COMPONENT ${name})

  _gslam_deb_name(${name} deb)
  install(FILES "${GSLAM_SOURCE_ROOT}/LICENSE" RENAME copyright
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${deb}" COMPONENT ${name})
  _gslam_write_pkgconfig(${name} ${version} ${kind} "${summary}" "${depends}"
    "${link}" "${pkgconfig}")
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/gslam_${name}.pc"
    DESTINATION "${data_dir}/pkgconfig" COMPONENT ${name})
endfunction()

# What the package config must find before it may define its target.
function(_gslam_dependency_lines NAME VERSION depends packages out)
  file(READ "${GSLAM_CMAKE_DIR}/component-dependency.cmake.in" template)
  set(lines "")
  while(depends)
    list(POP_FRONT depends dependency least)
    _gslam_deb_name(${dependency} dependency_deb)
    string(CONFIGURE "${template}" block @ONLY)
    string(APPEND lines "${block}")
  endwhile()
  foreach(package IN LISTS packages)  # "OpenCV 4 COMPONENTS core" is one of them
    string(APPEND lines "find_dependency(${package})\n")
  endforeach()
  set(${out} "${lines}" PARENT_SCOPE)
endfunction()

# Debian's name of a component's package: no underscores there.
function(_gslam_deb_name name out)
  string(REPLACE "_" "-" name "${name}")
  set(${out} "libgslam-${name}-dev" PARENT_SCOPE)
endfunction()

function(_gslam_write_pkgconfig name version kind summary depends link pkgconfig)
  set(PC_REQUIRES "")
  while(depends)
    list(POP_FRONT depends dependency least)
    string(APPEND PC_REQUIRES " gslam_${dependency} >= ${least}")
  endwhile()
  set(PC_LIBS "")
  set(PC_CFLAGS "")
  set(PC_LIBS_PRIVATE "")
  set(data_dir "${CMAKE_INSTALL_DATADIR}")
  if(kind STREQUAL compiled)
    set(data_dir "${CMAKE_INSTALL_LIBDIR}")
    set(PC_LIBS " -L\${libdir} -lgslam_${name}")
    get_target_property(type gslam_${name} TYPE)
    if(type STREQUAL STATIC_LIBRARY)
      string(TOUPPER ${name} NAME)
      set(PC_CFLAGS " -DGSLAM_${NAME}_STATIC_DEFINE")
    endif()
  endif()
  # pkg-config has no target names: what CMake calls ZLIB::ZLIB, its users must call -lz.
  set(threads "${link}")
  list(FILTER threads INCLUDE REGEX "^Threads::Threads$")
  list(FILTER link EXCLUDE REGEX "^(Threads::Threads)?$")
  if(link AND NOT pkgconfig)
    message(FATAL_ERROR "gslam_component(${name}): links ${link}; say with PKGCONFIG what a linker "
      "is told for it, such as -lz")
  endif()
  if(threads)
    list(APPEND pkgconfig -pthread)
  endif()
  string(REPLACE ";" " " pkgconfig "${pkgconfig}")
  if(kind STREQUAL headers)
    string(APPEND PC_LIBS " ${pkgconfig}")
  else()
    set(PC_LIBS_PRIVATE " ${pkgconfig}")
  endif()
  set(PC_NAME ${name})
  set(PC_VERSION ${version})
  set(PC_SUMMARY "${summary}")
  file(RELATIVE_PATH PC_UP "/prefix/${data_dir}/pkgconfig" "/prefix")
  string(REGEX REPLACE "/$" "" PC_UP "${PC_UP}")
  configure_file("${GSLAM_CMAKE_DIR}/component.pc.in"
    "${CMAKE_CURRENT_BINARY_DIR}/gslam_${name}.pc" @ONLY)
endfunction()
