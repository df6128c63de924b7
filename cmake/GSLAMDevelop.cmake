# What only the developers of GSLAM compile: tests, benchmarks, examples, warnings, sanitizers.
# Nothing in this file reaches an installed package.

if(CMAKE_SOURCE_DIR STREQUAL GSLAM_SOURCE_ROOT)
  set(GSLAM_IS_WHOLE ON)   # the whole house is built
else()
  set(GSLAM_IS_WHOLE OFF)  # one library alone, or GSLAM inside somebody's project
endif()
string(FIND "${CMAKE_SOURCE_DIR}/" "${GSLAM_SOURCE_ROOT}/" position)
if(position EQUAL 0)
  set(ours ON)
else()
  set(ours OFF)
endif()
option(GSLAM_BUILD_TESTS "Build the tests (needs GoogleTest)" ${ours})
option(GSLAM_BUILD_EXAMPLES "Build the examples, and run them as tests" ${ours})
option(GSLAM_BUILD_BENCH "Build the benchmarks (needs Google Benchmark)" OFF)
option(GSLAM_INSTALL "Make install rules and packages" ${ours})
set(GSLAM_SANITIZE "" CACHE STRING "Sanitizers for everything that is built, e.g. address,undefined")
set(GSLAM_TEST_STANDARD "" CACHE STRING "C++ standard of the tests; default: what the library asks for")

if(GSLAM_SANITIZE)
  add_compile_options(-fsanitize=${GSLAM_SANITIZE} -fno-sanitize-recover=all
    -fno-omit-frame-pointer -g)
  add_link_options(-fsanitize=${GSLAM_SANITIZE})
endif()
if(GSLAM_BUILD_TESTS OR GSLAM_BUILD_EXAMPLES)
  enable_testing()
endif()

# The warnings under which all code of ours compiles.
function(gslam_strict target)
  if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(${target} PRIVATE
      -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
  endif()
endfunction()

# One test program from tests/*.cpp, one benchmark from bench/*.cpp, one program an example.
function(_gslam_add_programs name standard)
  if(GSLAM_TEST_STANDARD)
    set(standard ${GSLAM_TEST_STANDARD})
  endif()
  file(GLOB tests CONFIGURE_DEPENDS tests/*.cpp)
  file(GLOB benches CONFIGURE_DEPENDS bench/*.cpp)
  file(GLOB examples CONFIGURE_DEPENDS examples/*.cpp)
  if(GSLAM_BUILD_TESTS AND tests)
    _gslam_find_gtest()
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE GSLAM::${name} GTest::gmock GTest::gtest_main)
    _gslam_set_up_program(${name}_test ${standard})
    gtest_discover_tests(${name}_test TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST
      PROPERTIES LABELS ${name})
  endif()
  if(GSLAM_BUILD_BENCH AND benches)
    gslam_add_bench(${name}_bench SOURCES ${benches} LINK GSLAM::${name} STANDARD ${standard})
  endif()
  if(GSLAM_BUILD_EXAMPLES)
    foreach(source IN LISTS examples)
      get_filename_component(example ${source} NAME_WE)
      set(target ${name}_example_${example})
      add_executable(${target} ${source})
      target_link_libraries(${target} PRIVATE GSLAM::${name})
      _gslam_set_up_program(${target} ${standard})
      add_test(NAME ${name}.example.${example} COMMAND ${target})
      set_tests_properties(${name}.example.${example} PROPERTIES LABELS ${name})
    endforeach()
  endif()
endfunction()

# gslam_add_bench(<target> SOURCES ... [LINK ...] [STANDARD 11]): a Google Benchmark program.
function(gslam_add_bench target)
  cmake_parse_arguments(ARG "" "STANDARD" "SOURCES;LINK" ${ARGN})
  find_package(benchmark REQUIRED)
  if(NOT TARGET gslam_bench_main)
    add_library(gslam_bench_main STATIC "${GSLAM_SOURCE_ROOT}/bench/harness/main.cpp"
      "${GSLAM_SOURCE_ROOT}/bench/harness/allocations.cpp")
    target_include_directories(gslam_bench_main PUBLIC "${GSLAM_SOURCE_ROOT}/bench/harness")
    target_link_libraries(gslam_bench_main PUBLIC benchmark::benchmark)
    _gslam_set_up_program(gslam_bench_main 11)
  endif()
  add_executable(${target} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE gslam_bench_main ${ARG_LINK})
  _gslam_set_up_program(${target} ${ARG_STANDARD})
endfunction()

function(_gslam_set_up_program target standard)
  set_target_properties(${target} PROPERTIES
    CXX_STANDARD ${standard} CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  gslam_strict(${target})
endfunction()

# GoogleTest of the system; cross builds compile Debian's copy of its sources.
macro(_gslam_find_gtest)
  include(GoogleTest)
  if(CMAKE_CROSSCOMPILING AND NOT TARGET GTest::gtest_main)
    set(INSTALL_GTEST OFF CACHE BOOL "" FORCE)
    add_subdirectory(/usr/src/googletest "${CMAKE_BINARY_DIR}/googletest" EXCLUDE_FROM_ALL)
  elseif(NOT TARGET GTest::gtest_main)
    find_package(GTest REQUIRED)
  endif()
endmacro()
