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

# What `piola import` and `piola identify` are written in, beside the program as it is found in a build folder.
set(PIOLA_PYTHON_PROGRAMS piola_import piola_identify)
set(_copied "")
foreach(package IN LISTS PIOLA_PYTHON_PROGRAMS)
  file(GLOB PIOLA_FILES_OF_${package} CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/python/${package}/*.py")
  foreach(file IN LISTS PIOLA_FILES_OF_${package})
    get_filename_component(name "${file}" NAME)
    set(_copy "${PROJECT_BINARY_DIR}/python/${package}/${name}")
    add_custom_command(OUTPUT "${_copy}" DEPENDS "${file}" COMMAND "${CMAKE_COMMAND}" -E copy "${file}" "${_copy}")
    list(APPEND _copied "${_copy}")
  endforeach()
endforeach()
add_custom_target(piola_python_programs ALL DEPENDS ${_copied})
add_dependencies(piola_app piola_python_programs)

# The same program for ranks: the same objects, with MPI where the library has one rank. The linker takes nothing out of
# the library that is there already, so domain/communicator_serial.cpp stays out, as long as it is an object of its own.
if(TARGET Piola::mpi AND PIOLA_MPI_BESIDE AND NOT PIOLA_MPI)
  add_executable(piola_mpi_app
    $<TARGET_OBJECTS:piola_app> "${PROJECT_SOURCE_DIR}/src/piola/domain/communicator_mpi.cpp")
  set_target_properties(piola_mpi_app PROPERTIES OUTPUT_NAME piola-mpi)
  target_link_libraries(piola_mpi_app PRIVATE piola piola_warnings piola_host piola_hardened Piola::mpi)
elseif(PIOLA_MPI_BESIDE AND NOT PIOLA_MPI)
  message(STATUS "Open MPI not found: the program for ranks is not built - run tools/install_dependencies --mpi")
endif()
