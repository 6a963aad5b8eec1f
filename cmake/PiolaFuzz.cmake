# SPDX-License-Identifier: Apache-2.0
# Fuzz targets: one program per tests/fuzz/NAME_fuzz.cpp, linked with libFuzzer (clang); their corpora are in
# tests/fuzz/corpus/NAME.

if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  message(FATAL_ERROR "PIOLA_FUZZ needs clang (the compiler here is ${CMAKE_CXX_COMPILER_ID}) - use the preset 'fuzz'")
endif()
file(GLOB _sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/fuzz/*_fuzz.cpp")
foreach(source IN LISTS _sources)
  get_filename_component(name "${source}" NAME_WE)
  add_executable(${name} "${source}")
  target_link_libraries(${name} PRIVATE piola piola_warnings piola_host Piola::hdf5)
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
endforeach()
