# SPDX-License-Identifier: Apache-2.0
# Language, warnings and the flags that were found necessary (each with its reason).
option(NAVCAL_TESTS "build the tests" ON)
# functions: call functions of the libraries. daemon: navcald on pseudo-terminals and under faults. programs: run the programs, or
# check what would be installed. nightly: what takes longest, where a shorter test of its kind is among the others.
# tools/test runs each kind in the build where it finds most (docs/building.md).
set(NAVCAL_TEST_KINDS functions daemon programs CACHE STRING "kinds of tests to build: functions, daemon, programs, nightly")
option(NAVCAL_BENCH "build the benchmarks" OFF)
option(NAVCAL_ROS2 "build navcal-ros2, where Cyclone DDS is installed (package cyclonedds-dev)" ON)
option(NAVCAL_FUZZ "build the libFuzzer targets (needs clang)" OFF)
option(NAVCAL_PRECOMPILE "precompile the large headers of libraries; off in the fuzz build, where a missing include shows" ON)
option(NAVCAL_UNITY "compile the sources of a room in batches; off in the presets debug and fuzz, where a missing include shows" ON)
set(NAVCAL_SANITIZE "" CACHE STRING "sanitizers to build with, e.g. address,undefined")
# Rooms that compute are watched by the assertions of Eigen and of the standard library instead (docs/building.md says what each
# finds): sanitized, they took most of the time of that build. Mixed objects are safe, because containers have no annotations here.
set(NAVCAL_SANITIZED_ROOMS "" CACHE STRING "rooms that are compiled with the sanitizers, with their tests; all if empty")
# The preset "check" leaves out those of pointers, which doubled the time to build and to run and which the address
# sanitizer mostly makes again at the access itself; the preset "fuzz" has them all.
set(NAVCAL_SANITIZE_WITHOUT "" CACHE STRING "checks of theirs to leave out")
# Rooms that compute need not be compiled a second time for the preset "check": they are linked as another build has made them.
set(NAVCAL_COMPUTING_FROM "" CACHE PATH "build folder whose libraries are linked for the rooms that are not in NAVCAL_SANITIZED_ROOMS")
# Rooms that compute little, and wait for bytes or people: -O2 instead of -O1 is a quarter more of their compilation. With
# sanitizers, optimising takes half of it, and more rooms are tested sooner without.
set(NAVCAL_MORE_LIGHT_ROOMS "" CACHE STRING "rooms that are compiled like those that compute little")
set(NAVCAL_LIGHT_ROOMS config devices control ports link runs emulation report fleet share web daemon cli/live cli ros2 ${NAVCAL_MORE_LIGHT_ROOMS})
set(NAVCAL_LIGHT_OPTIMISATION "$<$<CONFIG:Release>:-O1>" CACHE STRING "optimisation of these rooms and of the programs")
# Each test is compiled as often as it is run. Not -O0 beside optimised libraries: of a template that a test and a library both
# instantiate the linker keeps one copy, and the library would run at the test's speed.
set(NAVCAL_TEST_OPTIMISATION -O1 CACHE STRING "optimisation of tests")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# -O2 as Debian builds: -O3 made the daemon a third larger in memory and no faster. What nobody calls is left out.
# The assertions of the standard library stay in: on a vehicle a wrong index is to end the program, not to go on.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG -D_GLIBCXX_ASSERTIONS")
add_compile_options(-ffunction-sections -fdata-sections)
add_link_options(-Wl,--gc-sections -Wl,--as-needed)

add_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wshadow)
# A newer compiler warns of more: that is no reason not to build.
if("${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" MATCHES "^(GNU 12|Clang 14)[.]")
  set(warns_as_tested ON)
endif()
option(NAVCAL_WARNINGS_AS_ERRORS "stop at a warning; ON with the compilers of Debian 12, with which tools/test runs" ${warns_as_tested})
if(NAVCAL_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()
# Machines are to agree: no fused multiply-add behind our back, no -march=native. (The C library and Eigen have their own on
# arm64; docs/install.md has what differs.)
add_compile_options(-ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 sees a mismatch of new and delete in every coroutine frame at -O1 and under sanitizers.
  add_compile_options(-Wno-mismatched-new-delete)
  # g++ 12 sees overlapping copies in "text" + std::string at -O2 and above (GCC bug 105651).
  add_compile_options(-Wno-restrict)
  # A fifth of the time of a large source goes into g++'s garbage collection of its own memory; without it a source needs up to
  # a quarter more memory (1.5 GB for the largest).
  add_compile_options(--param=ggc-min-expand=1000 --param=ggc-min-heapsize=4000000)
  # g++ 12 warns of a coroutine's lambda in a source that a batch includes, as if it stood in a header.
  if(NAVCAL_UNITY)
    add_compile_options(-Wno-subobject-linkage)
  endif()
endif()

if(NAVCAL_SANITIZE)
  set(NAVCAL_SANITIZE_OPTIONS -fsanitize=${NAVCAL_SANITIZE} -fno-sanitize-recover=all)
  if(NAVCAL_SANITIZE_WITHOUT)
    list(APPEND NAVCAL_SANITIZE_OPTIONS -fno-sanitize=${NAVCAL_SANITIZE_WITHOUT})
  endif()
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # clang's check of function pointer types does not know Asio's type-erased handlers.
    list(APPEND NAVCAL_SANITIZE_OPTIONS -fno-sanitize=function)
  endif()
  if(NAVCAL_SANITIZE MATCHES "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Fences of Asio's, which g++ cannot show to the sanitizer.
    list(APPEND NAVCAL_SANITIZE_OPTIONS -Wno-tsan)
  endif()
  add_compile_options(-fno-omit-frame-pointer)
  add_link_options(-fsanitize=${NAVCAL_SANITIZE})
endif()

# navcal_add_folder(FOLDER): add_subdirectory of a room or of its tests, compiled as the room is to be: with the sanitizers or
# without.
macro(navcal_add_folder folder)
  get_directory_property(options_of_all COMPILE_OPTIONS)
  if(NOT NAVCAL_SANITIZED_ROOMS OR ${folder} IN_LIST NAVCAL_SANITIZED_ROOMS)
    add_compile_options(${NAVCAL_SANITIZE_OPTIONS})
  endif()
  add_subdirectory(${folder})
  set_directory_properties(PROPERTIES COMPILE_OPTIONS "${options_of_all}")
endmacro()

# Coverage of these libraries too: without it the fuzzer sees nothing of what it feeds.
set(NAVCAL_FUZZED_ROOMS protocols config instruments calib nav pipeline record link autopilot sim gap report runs daemon web
  CACHE STRING "rooms that tell the fuzzer what was reached")

# navcal_batches(TARGET SIZE): compiles the sources of a target in batches of that size, in the order in which they are listed.
# Most of the time of a build is spent on headers, which a batch reads once (docs/building.md). Names in anonymous namespaces
# must be unique within a batch; the compiler says so where they are not.
function(navcal_batches target size)
  if(NAVCAL_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
  endif()
endfunction()

# navcal_room(NAME [FOLDER room] [BATCH size] [COMPUTES] SOURCES... USES...): the library of one folder, linked as navcal::NAME
# (a slash in the name becomes an underscore). USES are libraries of
# others; the rooms that it links are those that it may include (cmake/rooms.cmake). BATCH: sources compiled together, 32 unless given.
# COMPUTES: not sanitized, though the room is.
function(navcal_room name)
  cmake_parse_arguments(ROOM "COMPUTES" "FOLDER;BATCH" "SOURCES;USES" ${ARGN})
  if(NOT ROOM_FOLDER)
    set(ROOM_FOLDER ${name})
  endif()
  if(NOT ROOM_BATCH)
    set(ROOM_BATCH 32)
  endif()
  string(REPLACE / _ target navcal_${name})
  string(REPLACE / _ alias navcal::${name})
  if(NAVCAL_COMPUTING_FROM AND NAVCAL_SANITIZED_ROOMS AND (ROOM_COMPUTES OR NOT ROOM_FOLDER IN_LIST NAVCAL_SANITIZED_ROOMS))
    file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/no_sources.cpp CONTENT "")
    set(ROOM_SOURCES ${CMAKE_CURRENT_BINARY_DIR}/no_sources.cpp)
    add_library(${target} STATIC ${ROOM_SOURCES})
    target_link_libraries(${target} INTERFACE ${CMAKE_BINARY_DIR}/computing/lib${target}.a)
    add_dependencies(${target} navcal_computing)
    set_property(GLOBAL APPEND PROPERTY NAVCAL_COMPUTING_TARGETS ${target})
    set_property(GLOBAL APPEND PROPERTY NAVCAL_COMPUTING_FILES ${NAVCAL_COMPUTING_FROM}/${ROOM_FOLDER}/lib${target}.a)
  else()
    add_library(${target} STATIC ${ROOM_SOURCES})
  endif()
  add_library(${alias} ALIAS ${target})
  navcal_batches(${target} ${ROOM_BATCH})
  navcal_include_rooms(${target} ${ROOM_FOLDER})
  list(TRANSFORM NAVCAL_MAY_INCLUDE_${ROOM_FOLDER} REPLACE / _ OUTPUT_VARIABLE rooms)
  list(TRANSFORM rooms PREPEND navcal::)
  target_link_libraries(${target} PUBLIC ${rooms} ${ROOM_USES})
  if(ROOM_FOLDER IN_LIST NAVCAL_LIBRARY_ROOMS)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
  if(NAVCAL_FUZZ AND name IN_LIST NAVCAL_FUZZED_ROOMS)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
  if(ROOM_FOLDER IN_LIST NAVCAL_LIGHT_ROOMS)
    target_compile_options(${target} PRIVATE ${NAVCAL_LIGHT_OPTIMISATION})
  endif()
endfunction()

# navcal_text(TARGET FILE NAMESPACE FUNCTION): a file of text becomes part of the program. FUNCTION in NAMESPACE returns it as
# const char*; who calls it declares it.
function(navcal_text target file text_namespace text_function)
  set(text_file ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${text_file})
  file(READ ${text_file} text_content)
  file(RELATIVE_PATH text_file ${CMAKE_SOURCE_DIR} ${text_file})
  configure_file(${CMAKE_SOURCE_DIR}/cmake/text.in ${CMAKE_CURRENT_BINARY_DIR}/${text_function}.cpp @ONLY)
  target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${text_function}.cpp)
endfunction()

# navcal_computing_target(): brings the libraries of the other build up to date before they are linked, and copies them.
function(navcal_computing_target)
  get_property(targets GLOBAL PROPERTY NAVCAL_COMPUTING_TARGETS)
  get_property(files GLOBAL PROPERTY NAVCAL_COMPUTING_FILES)
  if(targets)
    if(NOT EXISTS ${NAVCAL_COMPUTING_FROM}/CMakeCache.txt)
      message(FATAL_ERROR "this build links libraries of ${NAVCAL_COMPUTING_FROM}: configure that one first (cmake --preset release)")
    endif()
    list(TRANSFORM files REPLACE ".*/" ${CMAKE_BINARY_DIR}/computing/ OUTPUT_VARIABLE copies)
    add_custom_target(navcal_computing COMMAND ${CMAKE_COMMAND} --build ${NAVCAL_COMPUTING_FROM} --target ${targets}
      COMMAND ${CMAKE_SOURCE_DIR}/cmake/separate_computing ${CMAKE_BINARY_DIR}/computing ${files}
      BYPRODUCTS ${copies} USES_TERMINAL VERBATIM)
  endif()
endfunction()

# navcal_precompile(TARGET <header>...): half of the time of a build is spent on reading such headers. Only where all sources
# need them: with those of cli/, each source took twice as long as without.
function(navcal_precompile target)
  if(NAVCAL_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# navcal_test(NAME [KIND kind] [TIMEOUT s] SOURCES... USES... [RUNS program...]): one GoogleTest program, each suite a ctest of its own
# with that many seconds (300 unless given) on a machine that does nothing else: the slowest begin first, and what takes three times
# as long hangs. Its sources are compiled in batches, so names in anonymous namespaces must be unique
# within a program. A room has one program of each kind ("functions" unless given): a program of its own costs a batch and a link.
# RUNS: programs whose paths the test finds in NAVCAL_PROGRAM and NAVCALD.
function(navcal_test name)
  cmake_parse_arguments(TEST "" "KIND;TIMEOUT" "SOURCES;USES;RUNS" ${ARGN})
  if(NOT TEST_KIND)
    set(TEST_KIND functions)
  endif()
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 300)
  endif()
  if(NOT TEST_KIND IN_LIST NAVCAL_TEST_KINDS)
    return()
  endif()
  add_executable(${name} ${TEST_SOURCES})
  navcal_batches(${name} 16)
  target_link_libraries(${name} PRIVATE ${TEST_USES} GTest::gtest_main Eigen3::Eigen)
  if(NAVCAL_PRECOMPILE)
    get_directory_property(options COMPILE_OPTIONS)
    if(options MATCHES "-fsanitize=")
      target_precompile_headers(${name} REUSE_FROM navcal_sanitized_test_headers)
    else()
      target_precompile_headers(${name} REUSE_FROM navcal_test_headers)
    endif()
  endif()
  target_compile_definitions(${name} PRIVATE
    NAVCAL_SOURCE_DIR="${CMAKE_SOURCE_DIR}" NAVCAL_SHARED_DIR="${CMAKE_SOURCE_DIR}/../shared"
    NAVCAL_BINARY_DIR="${CMAKE_BINARY_DIR}")
  if(TEST_RUNS)
    add_dependencies(${name} ${TEST_RUNS})
    target_compile_definitions(${name} PRIVATE NAVCAL_PROGRAM="$<TARGET_FILE:navcal>" NAVCALD="$<TARGET_FILE:navcald>")
  endif()
  math(EXPR limit "3 * ${TEST_TIMEOUT}")
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  if(NOT EXISTS ${suites})
    file(WRITE ${suites} "add_test(${name}_is_not_built false)\n")
  endif()
  add_custom_command(TARGET ${name} POST_BUILD VERBATIM COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${name}> -D OUTPUT=${suites}
    -D "PROPERTIES=TIMEOUT ${limit} COST ${TEST_TIMEOUT}" -P ${CMAKE_SOURCE_DIR}/cmake/list_suites.cmake)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${suites})
endfunction()

# navcal_script_test(NAME [KIND kind] [TIMEOUT s] [LOCK resource] COMMAND... [ENVIRONMENT NAME=value...]): a test that is a script, of
# the kind "programs" unless given. It skips with status 77.
function(navcal_script_test name)
  cmake_parse_arguments(TEST "" "KIND;TIMEOUT;LOCK" "COMMAND;ENVIRONMENT" ${ARGN})
  if(NOT TEST_KIND)
    set(TEST_KIND programs)
  endif()
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 120)
  endif()
  if(NOT TEST_KIND IN_LIST NAVCAL_TEST_KINDS)
    return()
  endif()
  add_test(NAME ${name} COMMAND ${TEST_COMMAND})
  math(EXPR limit "3 * ${TEST_TIMEOUT}")
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT ${limit} COST ${TEST_TIMEOUT})
  if(TEST_LOCK)
    set_tests_properties(${name} PROPERTIES RESOURCE_LOCK ${TEST_LOCK})
  endif()
  if(TEST_ENVIRONMENT)
    set_tests_properties(${name} PROPERTIES ENVIRONMENT "${TEST_ENVIRONMENT}")
  endif()
endfunction()
