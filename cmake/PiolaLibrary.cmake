# SPDX-License-Identifier: Apache-2.0
# The library: every room of src/piola. Files named machine.cpp are compiled by PiolaMachines.cmake.

set(PIOLA_ROOMS base math exec kernels materials particles neighbours parallel mechanics formulations setup input output
                simulation)
set(_patterns "")
foreach(room IN LISTS PIOLA_ROOMS)
  list(APPEND _patterns "${PROJECT_SOURCE_DIR}/src/piola/${room}/*.cpp")
endforeach()
foreach(room IN ITEMS materials formulations)
  list(APPEND _patterns "${PROJECT_SOURCE_DIR}/src/piola/${room}/*/*.cpp")
endforeach()
file(GLOB _sources CONFIGURE_DEPENDS ${_patterns})
list(FILTER _sources EXCLUDE REGEX "/machine\\.cpp$")
if(NOT _sources)
  set(_empty "${PROJECT_BINARY_DIR}/empty.cpp")
  file(WRITE "${_empty}" "")
  set(_sources "${_empty}")
endif()

add_library(piola STATIC ${_sources})
add_library(Piola::piola ALIAS piola)
target_include_directories(piola PUBLIC
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>" "$<INSTALL_INTERFACE:include>")
target_include_directories(piola SYSTEM PRIVATE "${PIOLA_TOML_INCLUDE}")
target_compile_definitions(piola PRIVATE PIOLA_VERSION="${PROJECT_VERSION}")
target_link_libraries(piola
  PUBLIC piola_options
  PRIVATE $<BUILD_INTERFACE:piola_warnings> $<BUILD_INTERFACE:piola_host> $<BUILD_INTERFACE:piola_hardened>
          Piola::hdf5 PNG::PNG Piola::libdeflate Piola::qhull Piola::udunits2
          muparser::muparser nlohmann_json::nlohmann_json)

# Files of one room read the same headers: a few of them as one take half the time. Names in unnamed namespaces must
# differ within a room, which tools/test sees, because it builds so.
if(PIOLA_TOGETHER)
  set_target_properties(piola PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS _sources)
    get_filename_component(folder "${source}" DIRECTORY)
    get_filename_component(room "${folder}" NAME)
    math(EXPR _count_${room} "${_count_${room}} + 1" OUTPUT_FORMAT DECIMAL)
    math(EXPR _batch "(${_count_${room}} + 7) / 8")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${room}_${_batch}")
  endforeach()
else()
  # Reading a case is no hot loop, and compiles a third faster with little optimisation.
  foreach(source IN LISTS _sources)
    if(source MATCHES "/src/piola/input/")
      set_source_files_properties("${source}" PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
    endif()
  endforeach()
endif()
