# SPDX-License-Identifier: Apache-2.0
# The library: every module of src/piola. Files named backend.cpp are compiled by PiolaBackends.cmake, which comes first
# so that they do too: they take longest.

set(PIOLA_MODULES base math exec kernels materials particles geometry neighbours domain mechanics formulations setup
                  input output model drawing observers guards measures pictures simulation estimates study verification
                  bench report)
set(_patterns "")
foreach(module IN LISTS PIOLA_MODULES)
  list(APPEND _patterns "${PROJECT_SOURCE_DIR}/src/piola/${module}/*.cpp")
endforeach()
foreach(module IN ITEMS materials mechanics formulations)
  list(APPEND _patterns "${PROJECT_SOURCE_DIR}/src/piola/${module}/*/*.cpp")
endforeach()
file(GLOB _sources CONFIGURE_DEPENDS ${_patterns})
include(PiolaEmbeddedFiles)
list(APPEND _sources ${PIOLA_EMBEDDED_SOURCES})
list(FILTER _sources EXCLUDE REGEX "/backend\\.cpp$")
if(PIOLA_MESH)
  list(FILTER _sources EXCLUDE REGEX "/geometry/mesh_absent\\.cpp$")
else()
  list(FILTER _sources EXCLUDE REGEX "/geometry/mesh(_[b-z][a-z]*)?\\.cpp$")
endif()
if(PIOLA_MPI)
  list(FILTER _sources EXCLUDE REGEX "/domain/communicator_serial\\.cpp$")
else()
  list(FILTER _sources EXCLUDE REGEX "/domain/communicator_mpi\\.cpp$")
  set_source_files_properties("${PROJECT_SOURCE_DIR}/src/piola/domain/communicator_serial.cpp" PROPERTIES
    SKIP_UNITY_BUILD_INCLUSION ON)  # programs may bring communicator_mpi.cpp in its place: PiolaProgram.cmake
endif()
set(_cold input model observers guards measures pictures simulation estimates study verification bench report)
list(JOIN _cold "|" _cold)
set(_cold "/src/piola/(${_cold})/")
set(_cold_sources ${_sources})
list(FILTER _cold_sources INCLUDE REGEX "${_cold}")
list(FILTER _sources EXCLUDE REGEX "${_cold}")

set(_outside Piola::cairo Piola::webpmux Piola::webp Piola::hdf5 PNG::PNG Piola::libdeflate Piola::qhull
             Piola::udunits2 muparser::muparser nlohmann_json::nlohmann_json)
if(PIOLA_MESH)
  list(APPEND _outside Piola::assimp Piola::embree)
endif()

if(PIOLA_MPI)
  list(APPEND _outside Piola::mpi)
endif()

# A library of object files that become part of piola. It does not wait for the backends, which take longest.
function(piola_add_modules target)
  add_library(${target} OBJECT ${ARGN})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  target_include_directories(${target} SYSTEM PRIVATE "${PIOLA_TOML_INCLUDE}")
  target_compile_definitions(${target} PRIVATE PIOLA_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${target} PRIVATE piola_options piola_warnings piola_host piola_hardened ${_outside})
  target_sources(piola PRIVATE $<TARGET_OBJECTS:${target}>)
  # Files of one folder read the same headers: up to 16 of them as one take a third of the time. Names in unnamed
  # namespaces must differ within a folder, which tools/test sees, because it builds so.
  if(PIOLA_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    foreach(source IN LISTS ARGN)
      get_filename_component(folder "${source}" DIRECTORY)
      get_filename_component(name "${folder}" NAME)
      list(APPEND _names ${name})
      list(APPEND _files_${name} "${source}")
    endforeach()
    list(REMOVE_DUPLICATES _names)
    foreach(name IN LISTS _names)
      list(LENGTH _files_${name} count)
      math(EXPR objects "(${count} + 15) / 16" OUTPUT_FORMAT DECIMAL)
      set(index 0)
      foreach(source IN LISTS _files_${name})
        math(EXPR object "${index} * ${objects} / ${count} + 1" OUTPUT_FORMAT DECIMAL)
        math(EXPR index "${index} + 1" OUTPUT_FORMAT DECIMAL)
        set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${name}_${object}")
      endforeach()
    endforeach()
    # The headers that most files read, compiled once per target. ccache would miss then: see its manual, "pch".
    if(NOT CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
      target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory>
                                                  <numeric> <optional> <set> <span> <string> <vector> <fmt/format.h>)
    endif()
  endif()
endfunction()

add_library(piola STATIC ${PIOLA_BACKEND_OBJECTS})
add_library(Piola::piola ALIAS piola)
set_target_properties(piola PROPERTIES LINKER_LANGUAGE CXX)
target_include_directories(piola PUBLIC
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>" "$<INSTALL_INTERFACE:include>")
target_link_libraries(piola
  PUBLIC piola_options
  PRIVATE $<BUILD_INTERFACE:piola_hardened> ${_outside})
piola_add_modules(piola_modules ${_sources})

# Modules without hot loops compile a third faster with little optimisation.
piola_add_modules(piola_cold ${_cold_sources})
target_compile_options(piola_cold PRIVATE $<$<CONFIG:Release>:-O1>)
