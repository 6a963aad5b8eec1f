# SPDX-License-Identifier: Apache-2.0
# The program `piola`: the command line over the library.

file(GLOB _sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/app/*.cpp")
if(NOT _sources)
  message(STATUS "app/ holds no sources: the program is not built")
  return()
endif()
find_package(CLI11 REQUIRED)
add_executable(piola_app ${_sources})
set_target_properties(piola_app PROPERTIES UNITY_BUILD ${PIOLA_TOGETHER})  # reads the large header of CLI11 once
target_compile_options(piola_app PRIVATE $<$<CONFIG:Release>:-O1>)  # no hot loops here
set_target_properties(piola_app PROPERTIES OUTPUT_NAME piola)
target_compile_definitions(piola_app PRIVATE PIOLA_VERSION="${PROJECT_VERSION}")
target_link_libraries(piola_app PRIVATE piola piola_warnings piola_host piola_hardened
                                        CLI11::CLI11 nlohmann_json::nlohmann_json)
