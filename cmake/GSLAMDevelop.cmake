# What only the developers of GSLAM compile: tests, benchmarks, examples, warnings, sanitizers.
# Nothing in this file reaches an installed package.

if(CMAKE_SOURCE_DIR STREQUAL GSLAM_SOURCE_ROOT)
  set(GSLAM_IS_WHOLE ON)   # the whole house is built
  set(GSLAM_BINARY_ROOT "${CMAKE_BINARY_DIR}")
else()
  set(GSLAM_IS_WHOLE OFF)  # one library alone, or GSLAM inside somebody's project
  set(GSLAM_BINARY_ROOT "${CMAKE_BINARY_DIR}/gslam-house")
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
option(GSLAM_BUILD_FUZZ "Build the fuzz targets (needs clang's libFuzzer)" OFF)
option(GSLAM_INSTALL "Make install rules and packages" ${ours})
option(GSLAM_WERROR "Treat warnings in GSLAM's own sources as errors" ${ours})
set(GSLAM_SANITIZE "" CACHE STRING "Sanitizers for everything that is built, e.g. address,undefined")
set(GSLAM_TEST_SHARDS 0 CACHE STRING "Processes that share the tests of a program; 0: one for each test")
set(GSLAM_TESTED_ELSEWHERE "" CACHE STRING "Libraries whose tests and examples another build has, e.g. base;core")
set(GSLAM_TEST_STANDARD "" CACHE STRING "C++ standard of the tests; default: what the library asks for")

if(GSLAM_SANITIZE)
  add_compile_options(-fsanitize=${GSLAM_SANITIZE} -fno-sanitize-recover=all
    -fno-omit-frame-pointer -g1)
  # GCC's sanitizers make it warn of its own intrinsics (PR 105593); the other builds keep the warning.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  add_link_options(-fsanitize=${GSLAM_SANITIZE})
endif()
if(CMAKE_UNITY_BUILD)
  # A class of an unnamed namespace may be a member of a class of its source; joined, GCC takes the
  # source for a header.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(GSLAM_BUILD_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)  # the fuzzer sees into compiled libraries, too
  add_link_options(-fsanitize=fuzzer-no-link)
endif()
if(GSLAM_BUILD_TESTS OR GSLAM_BUILD_EXAMPLES OR GSLAM_BUILD_FUZZ)
  enable_testing()
endif()

# The warnings under which all code of ours compiles.
function(gslam_strict target)
  if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(${target} PRIVATE
      -Wall -Wextra -Wpedantic -Wconversion -Wshadow $<$<BOOL:${GSLAM_WERROR}>:-Werror>)
  endif()
endfunction()

# One test program from tests/*.cpp, one benchmark from bench/*.cpp, one program an example, one
# fuzz target from each fuzz/*.cpp with its seeds in fuzz/corpus/<target>/.
function(_gslam_add_programs name standard)
  if(GSLAM_TEST_STANDARD)
    set(standard ${GSLAM_TEST_STANDARD})
  endif()
  file(GLOB tests CONFIGURE_DEPENDS tests/*.cpp)
  file(GLOB benches CONFIGURE_DEPENDS bench/*.cpp)
  file(GLOB examples CONFIGURE_DEPENDS examples/*.cpp)
  if(GSLAM_SANITIZE STREQUAL "thread")
    _gslam_keep_threaded(tests)
  endif()
  if(GSLAM_BUILD_TESTS AND tests AND NOT name IN_LIST GSLAM_TESTED_ELSEWHERE)
    _gslam_find_gtest()
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE GSLAM::${name} GTest::gmock GTest::gtest_main)
    target_include_directories(${name}_test PRIVATE "${GSLAM_SOURCE_ROOT}/tests/harness")
    _gslam_set_up_program(${name}_test ${standard})
    _gslam_compile_tests_fast(${name})
    _gslam_add_tests(${name})
  endif()
  if(GSLAM_BUILD_BENCH AND benches)
    gslam_add_bench(${name}_bench SOURCES ${benches} LINK GSLAM::${name} STANDARD ${standard})
  endif()
  file(GLOB fuzz_targets CONFIGURE_DEPENDS fuzz/*.cpp)
  foreach(source IN LISTS fuzz_targets)
    get_filename_component(fuzz_target ${source} NAME_WE)
    if(GSLAM_BUILD_FUZZ)
      _gslam_add_fuzz(${name} ${fuzz_target} ${source} ${standard})
    elseif(GSLAM_BUILD_TESTS AND NOT name IN_LIST GSLAM_TESTED_ELSEWHERE
           AND NOT GSLAM_SANITIZE STREQUAL "thread")
      _gslam_add_replay(${name} ${fuzz_target} ${source})
    endif()
  endforeach()
  if(GSLAM_BUILD_EXAMPLES AND NOT name IN_LIST GSLAM_TESTED_ELSEWHERE)
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

# What a compiled library does is optimised by its own flags, so that its tests need not be; headers
# are tested at -O1, a third cheaper than -O2.
function(_gslam_compile_tests_fast name)
  if(GSLAM_SANITIZE)
    return()
  endif()
  get_target_property(type gslam_${name} TYPE)
  set(level -O0)
  if(type STREQUAL INTERFACE_LIBRARY)
    set(level -O1)
  endif()
  target_compile_options(${name}_test PRIVATE
    "$<$<AND:$<CXX_COMPILER_ID:GNU,Clang>,$<CONFIG:RelWithDebInfo>>:${level}>")
endfunction()

# A process for each test, so that none leans on another one; or a few that share them, where to start
# one takes as long as the test: with sanitizers, and with what OpenCV links.
function(_gslam_add_tests name)
  if(NOT GSLAM_TEST_SHARDS)
    gtest_discover_tests(${name}_test TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST
      PROPERTIES LABELS ${name})
    return()
  endif()
  math(EXPR last "${GSLAM_TEST_SHARDS} - 1")
  foreach(shard RANGE ${last})
    set(test ${name}.shard_${shard})
    add_test(NAME ${test} COMMAND ${name}_test)
    # tests/tally.py counts what is written there.
    set_tests_properties(${test} PROPERTIES LABELS ${name} TIMEOUT 3000 ENVIRONMENT
      "GTEST_TOTAL_SHARDS=${GSLAM_TEST_SHARDS};GTEST_SHARD_INDEX=${shard};GTEST_OUTPUT=xml:${CMAKE_BINARY_DIR}/gtest/${test}.xml")
  endforeach()
endfunction()

# Of a list of sources those that have to do with threads: the thread sanitizer has nothing to say of
# the others.
function(_gslam_keep_threaded sources)
  set(kept "")
  foreach(source IN LISTS ${sources})
    file(STRINGS "${source}" words REGEX "[Tt]hread|[Pp]arallel|async|atomic|Workers" LIMIT_COUNT 1)
    if(words)
      list(APPEND kept "${source}")
    endif()
  endforeach()
  set(${sources} "${kept}" PARENT_SCOPE)
endfunction()

# The seeds of a fuzz target, fed to it in every build that has tests.
function(_gslam_add_replay name target source)
  set(program ${name}_replay_${target})
  add_executable(${program} ${source} "${GSLAM_SOURCE_ROOT}/tests/harness/replay.cpp")
  target_link_libraries(${program} PRIVATE GSLAM::${name})
  _gslam_set_up_program(${program} 17)
  add_test(NAME ${name}.replay.${target}
    COMMAND ${program} "${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus/${target}")
  set_tests_properties(${name}.replay.${target} PROPERTIES LABELS ${name})
endfunction()

# Fuzzes for a minute, from the seeds on. What is found stays in the build folder.
function(_gslam_add_fuzz name target source standard)
  set(program ${name}_fuzz_${target})
  set(seeds "${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus/${target}")
  set(found "${CMAKE_CURRENT_BINARY_DIR}/fuzz/${target}")
  file(MAKE_DIRECTORY "${found}")
  add_executable(${program} ${source})
  target_link_libraries(${program} PRIVATE GSLAM::${name})
  target_compile_options(${program} PRIVATE -fsanitize=fuzzer)
  target_link_options(${program} PRIVATE -fsanitize=fuzzer)
  _gslam_set_up_program(${program} ${standard})
  set(fuzz ${program} -artifact_prefix=${found}/ -print_final_stats=1 -timeout=10)
  add_test(NAME ${name}.fuzz.${target}.60s COMMAND ${fuzz} -max_total_time=60 ${found} ${seeds})
  set_tests_properties(${name}.fuzz.${target}.60s PROPERTIES LABELS "fuzz;${name}")
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
    _gslam_set_bench_level(gslam_bench_main)
  endif()
  add_executable(${target} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE gslam_bench_main ${ARG_LINK})
  _gslam_set_up_program(${target} ${ARG_STANDARD})
  _gslam_set_bench_level(${target})
endfunction()

# Beside tests a benchmark is only seen to compile, and says "debug" where it is run nevertheless; the
# preset `bench` makes what is measured.
function(_gslam_set_bench_level target)
  if(GSLAM_BUILD_TESTS)
    target_compile_options(${target} PRIVATE
      "$<$<AND:$<CXX_COMPILER_ID:GNU,Clang>,$<CONFIG:RelWithDebInfo>>:-O0>")
  endif()
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
