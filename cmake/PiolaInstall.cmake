# SPDX-License-Identifier: Apache-2.0
# Install rules, find_package(Piola), and the Debian packages: piola (program, cases, manual), libpiola-dev, and
# python3-piola if the module is built. cpack makes them: cd build/release && cpack

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(_config_folder "${CMAKE_INSTALL_LIBDIR}/cmake/Piola")
set(_doc "${CMAKE_INSTALL_DATADIR}/doc")

# The program, with pages that it writes itself.
if(TARGET piola_app)
  install(TARGETS piola_app RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
  find_program(PIOLA_GZIP gzip)
  set(_pages "${PROJECT_BINARY_DIR}/pages")
  add_custom_command(OUTPUT "${_pages}/piola.1.gz" "${_pages}/piola"
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${_pages}"
    COMMAND sh -c "$<TARGET_FILE:piola_app> describe man-page | ${PIOLA_GZIP} -9n > ${_pages}/piola.1.gz"
    COMMAND sh -c "$<TARGET_FILE:piola_app> describe completion > ${_pages}/piola"
    DEPENDS piola_app COMMENT "Writing the manual page and the completion" VERBATIM)
  add_custom_target(piola_pages ALL DEPENDS "${_pages}/piola.1.gz")
  foreach(package IN LISTS PIOLA_PYTHON_PROGRAMS)
    install(FILES ${PIOLA_FILES_OF_${package}} DESTINATION "${CMAKE_INSTALL_DATADIR}/piola/python/${package}"
            COMPONENT program)
  endforeach()
  install(FILES "${_pages}/piola.1.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program)
  install(FILES "${_pages}/piola" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT program)
endif()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/cases" DESTINATION "${CMAKE_INSTALL_DATADIR}/piola" COMPONENT program
        PATTERN "*.py" EXCLUDE PATTERN "make_meshes" EXCLUDE)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/bench/cases/" DESTINATION "${CMAKE_INSTALL_DATADIR}/piola/bench"
        COMPONENT program)
# What users compile their material laws with.
install(FILES "${PROJECT_SOURCE_DIR}/src/piola/materials/piola_material.h"
              "${PROJECT_SOURCE_DIR}/src/piola/materials/piola_strain.h"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT program)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples/user-materials" DESTINATION "${CMAKE_INSTALL_DATADIR}/piola"
        COMPONENT program)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/user" "${PROJECT_SOURCE_DIR}/docs/theory"
        DESTINATION "${_doc}/piola" COMPONENT program FILES_MATCHING PATTERN "*.md")

# The library.
install(TARGETS piola piola_options EXPORT PiolaTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/src/piola" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev
        FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
install(EXPORT PiolaTargets NAMESPACE Piola:: DESTINATION "${_config_folder}" COMPONENT dev)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/PiolaConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/PiolaConfig.cmake" INSTALL_DESTINATION "${_config_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/PiolaConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/PiolaConfig.cmake" "${PROJECT_BINARY_DIR}/PiolaConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/PiolaDependencies.cmake" DESTINATION "${_config_folder}" COMPONENT dev)

# What Debian wants to find in every package; changelog and page are made anew from the same text each time.
set(_packages piola:program libpiola-dev:dev)
if(PIOLA_PYTHON)
  list(APPEND _packages python3-piola:python)
endif()
find_program(PIOLA_GZIP gzip)
set(PIOLA_PACKAGE_DATE "Sun, 22 Nov 2026 12:00:00 +0000")
configure_file("${PROJECT_SOURCE_DIR}/packaging/changelog.in" "${PROJECT_BINARY_DIR}/packaging/changelog" @ONLY)
if(PIOLA_GZIP)
  foreach(file IN ITEMS "${PROJECT_BINARY_DIR}/packaging/changelog" "${PROJECT_SOURCE_DIR}/CHANGELOG.md")
    get_filename_component(name "${file}" NAME)
    execute_process(COMMAND "${PIOLA_GZIP}" -9nc "${file}"
                    OUTPUT_FILE "${PROJECT_BINARY_DIR}/packaging/${name}.gz" COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  foreach(package IN LISTS _packages)
    string(REPLACE ":" ";" package "${package}")
    list(GET package 0 name)
    list(GET package 1 component)
    install(FILES "${PROJECT_SOURCE_DIR}/packaging/copyright" "${PROJECT_BINARY_DIR}/packaging/changelog.gz"
            DESTINATION "${_doc}/${name}" COMPONENT ${component})
  endforeach()
  install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_BINARY_DIR}/packaging/CHANGELOG.md.gz"
          DESTINATION "${_doc}/piola" COMPONENT program)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME piola)
set(CPACK_PACKAGE_CONTACT "The Piola developers <piola@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${PROJECT_HOMEPAGE_URL}")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME piola)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-meshio, python3-scipy")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "gmsh, python3-h5py, python3-netcdf4")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Piola computes the fast motion of solids that deform, flow and break, with\nsmoothed particle \
hydrodynamics. Cases are text files; results open in\nParaView. This package has the program, its examples and its \
manual.")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libpiola-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
# The static library needs the libraries that it stands on.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libcairo2-dev, libhdf5-dev, libdeflate-dev, libfmt-dev, libmuparser-dev, \
libpng-dev, libqhull-dev, libtomlplusplus-dev, libudunits2-dev, libwebp-dev, nlohmann-json3-dev")
if(PIOLA_MESH)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libassimp-dev, libembree-dev")
endif()
set(CPACK_COMPONENT_DEV_DESCRIPTION
    "The library of Piola, a solver for the fast motion of solids with smoothed\nparticle hydrodynamics: headers, the \
static library, and what CMake needs\nfor find_package(Piola).")
if(PIOLA_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-piola)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  math(EXPR _next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${_next}), python3-numpy, python3-h5py")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "Piola from Python: cases, runs step by step with functions that look on,\nresults and studies.")
endif()
include(CPack)
