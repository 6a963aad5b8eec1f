# SPDX-License-Identifier: Apache-2.0
# Tests: tests/**/*_test.cpp become one program; *_test.sh and *_test.py run as they are.

include(GoogleTest)
find_package(GTest REQUIRED)
find_library(PIOLA_WEBPDEMUX_LIBRARY webpdemux REQUIRED)  # films are read back; comes with libwebp-dev
find_package(rapidcheck REQUIRED)

file(GLOB_RECURSE _sources CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/tests/*_test.cpp" "${PROJECT_SOURCE_DIR}/tests/support/*.cpp")
if(NOT PIOLA_MESH)
  list(FILTER _sources EXCLUDE REGEX "/geometry/mesh(_[b-z][a-z]*)?_test\\.cpp$")
endif()
if(_sources)
  add_executable(piola_tests ${_sources})
  target_include_directories(piola_tests PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  # A quarter less to compile; what is hot is in the library.
  target_compile_options(piola_tests PRIVATE $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(piola_tests PRIVATE
    PIOLA_VERSION="${PROJECT_VERSION}" $<$<TARGET_EXISTS:piola_app>:PIOLA_HAS_PROGRAM>)
  # Only there: all other files are compiled alike in every folder.
  set_property(SOURCE "${PROJECT_SOURCE_DIR}/tests/support/places.cpp" PROPERTY COMPILE_DEFINITIONS
    PIOLA_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    PIOLA_PROGRAM="$<$<TARGET_EXISTS:piola_app>:$<TARGET_FILE:piola_app>>")
  # Laws that users compile with the header alone.
  set_property(SOURCE "${PROJECT_SOURCE_DIR}/tests/support/library_laws.cpp" PROPERTY INCLUDE_DIRECTORIES
    "${PROJECT_SOURCE_DIR}/src/piola/materials")
  target_link_libraries(piola_tests PRIVATE
    piola piola_warnings piola_host GTest::gtest GTest::gtest_main rapidcheck ${PIOLA_WEBPDEMUX_LIBRARY}
    Piola::hdf5 PNG::PNG nlohmann_json::nlohmann_json)
  if(TARGET piola_app)
    add_dependencies(piola_tests piola_app)
  endif()
  # Values of parameters are left out of the names: some would print addresses, which change from build to build.
  gtest_discover_tests(piola_tests DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES PROPERTIES TIMEOUT 300)
endif()

set(PIOLA_TEST_PYTHON "/usr/bin/python3" CACHE FILEPATH "Python that sees Debian's packages (numpy, h5py)")
file(GLOB_RECURSE _scripts CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/tests/*_test.sh" "${PROJECT_SOURCE_DIR}/tests/*_test.py")
if(NOT PIOLA_PYTHON)
  list(FILTER _scripts EXCLUDE REGEX "/tests/python/")
endif()
# Tests of ranks: all that there are in builds for MPI; else a few, if there is a program for ranks beside.
set(_ranks_program "")
if(PIOLA_MPI AND TARGET piola_app)
  set(_ranks_program "$<TARGET_FILE:piola_app>")
elseif(TARGET piola_mpi_app)
  set(_ranks_program "$<TARGET_FILE:piola_mpi_app>")
endif()
set(_environment
  "PIOLA_SOURCE_DIR=${PROJECT_SOURCE_DIR}"
  "PIOLA_PROGRAM=$<$<TARGET_EXISTS:piola_app>:$<TARGET_FILE:piola_app>>"
  "PIOLA_RANKS_PROGRAM=${_ranks_program}"
  "PIOLA_RANKS_TESTS=$<IF:$<BOOL:${PIOLA_MPI}>,all,quick>"
  "PIOLA_HARDENED=$<AND:$<BOOL:${PIOLA_HARDENING}>,$<CONFIG:Release>>")
foreach(script IN LISTS _scripts)
  file(RELATIVE_PATH name "${PROJECT_SOURCE_DIR}/tests" "${script}")
  if(script MATCHES "\\.py$")
    add_test(NAME "${name}" COMMAND "${PIOLA_TEST_PYTHON}" "${script}")
  else()
    add_test(NAME "${name}" COMMAND bash "${script}")
  endif()
  set_tests_properties("${name}" PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77 ENVIRONMENT
    "${_environment};PYTHONPATH=${PROJECT_BINARY_DIR}/python")
endforeach()

# They load all cores, and what waits for others would wait longer beside other tests.
set(_ranks_timeout 300)
if(PIOLA_MPI)
  set(_ranks_timeout 3600)
endif()
foreach(script IN LISTS _scripts)
  if(script MATCHES "/domain/ranks[a-z_]*_test\\.py$" AND _ranks_program)
    file(RELATIVE_PATH name "${PROJECT_SOURCE_DIR}/tests" "${script}")
    set_tests_properties("${name}" PROPERTIES TIMEOUT ${_ranks_timeout} RUN_SERIAL ON)
  endif()
endforeach()

# The stored inputs of every fuzz target are ordinary tests; finding new ones needs clang (PiolaFuzz.cmake).
file(GLOB _fuzz CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/fuzz/*_fuzz.cpp")
foreach(source IN LISTS _fuzz)
  get_filename_component(name "${source}" NAME_WE)
  add_executable(${name}_replay "${source}" "${PROJECT_SOURCE_DIR}/tests/fuzz/replay.cpp")
  target_link_libraries(${name}_replay PRIVATE piola piola_warnings piola_host Piola::hdf5)
  string(REGEX REPLACE "_fuzz$" "" corpus "${name}")
  add_test(NAME fuzz/${name} COMMAND ${name}_replay "${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${corpus}")
  set_tests_properties(fuzz/${name} PROPERTIES TIMEOUT 300)
endforeach()

# Every header compiles alone.
file(GLOB_RECURSE _headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/piola/*.hpp")
set(_alone "")
foreach(header IN LISTS _headers)
  file(RELATIVE_PATH path "${PROJECT_SOURCE_DIR}/src" "${header}")
  string(REGEX REPLACE "\\.hpp$" ".cpp" name "${path}")
  set(file "${PROJECT_BINARY_DIR}/header_check/${name}")
  file(CONFIGURE OUTPUT "${file}" CONTENT "#include \"@path@\"\n" @ONLY)
  list(APPEND _alone "${file}")
endforeach()
if(_alone)
  add_library(header_check OBJECT EXCLUDE_FROM_ALL ${_alone})
  target_include_directories(header_check PRIVATE "${PROJECT_SOURCE_DIR}/src")
  target_compile_options(header_check PRIVATE -O0 -g0)
  target_link_libraries(header_check PRIVATE piola piola_warnings piola_host Piola::hdf5 PNG::PNG)
endif()
