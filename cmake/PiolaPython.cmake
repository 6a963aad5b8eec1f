# SPDX-License-Identifier: Apache-2.0
# The Python module: build/PRESET/python/piola, ready for PYTHONPATH; installed beside Debian's own modules.

if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)  # Debian's, for which its numpy and h5py are
endif()
# Before pybind11, which else takes another Python.
find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 REQUIRED)

set(PIOLA_PYTHON_FOLDER "${PROJECT_BINARY_DIR}/python/piola")
file(GLOB _module_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/python/module/*.cpp")
pybind11_add_module(piola_python MODULE NO_EXTRAS ${_module_sources})
set_target_properties(piola_python PROPERTIES OUTPUT_NAME _piola LIBRARY_OUTPUT_DIRECTORY "${PIOLA_PYTHON_FOLDER}"
                                              UNITY_BUILD ${PIOLA_TOGETHER})
target_compile_options(piola_python PRIVATE $<$<CONFIG:Release>:-O1>)  # no hot loops here
target_link_libraries(piola_python PRIVATE piola piola_warnings piola_host)

file(GLOB _python_files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/python/piola/*.py"
                                          "${PROJECT_SOURCE_DIR}/python/piola/*.pyi"
                                          "${PROJECT_SOURCE_DIR}/python/piola/py.typed")
set(_copied "")
foreach(file IN LISTS _python_files)
  get_filename_component(name "${file}" NAME)
  add_custom_command(OUTPUT "${PIOLA_PYTHON_FOLDER}/${name}" DEPENDS "${file}"
    COMMAND "${CMAKE_COMMAND}" -E copy "${file}" "${PIOLA_PYTHON_FOLDER}/${name}")
  list(APPEND _copied "${PIOLA_PYTHON_FOLDER}/${name}")
endforeach()
add_custom_target(piola_python_files ALL DEPENDS ${_copied})

set(PIOLA_PYTHON_INSTALL "lib/python3/dist-packages" CACHE STRING "Where the module is installed, below the prefix")
if(PROJECT_IS_TOP_LEVEL)
  install(TARGETS piola_python LIBRARY DESTINATION "${PIOLA_PYTHON_INSTALL}/piola" COMPONENT python)
  install(FILES ${_python_files} DESTINATION "${PIOLA_PYTHON_INSTALL}/piola" COMPONENT python)
  foreach(package IN LISTS PIOLA_PYTHON_PROGRAMS)
    install(FILES ${PIOLA_FILES_OF_${package}} DESTINATION "${PIOLA_PYTHON_INSTALL}/${package}" COMPONENT python)
  endforeach()
endif()
