# SPDX-License-Identifier: Apache-2.0
# Install rules, find_package(Piola), and the Debian package.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(_config_folder "${CMAKE_INSTALL_LIBDIR}/cmake/Piola")

if(TARGET piola_app)
  install(TARGETS piola_app RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
install(TARGETS piola piola_options EXPORT PiolaTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/src/piola" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/cases" DESTINATION "${CMAKE_INSTALL_DATADIR}/piola")
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(EXPORT PiolaTargets NAMESPACE Piola:: DESTINATION "${_config_folder}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/PiolaConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/PiolaConfig.cmake" INSTALL_DESTINATION "${_config_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/PiolaConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/PiolaConfig.cmake" "${PROJECT_BINARY_DIR}/PiolaConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/PiolaDependencies.cmake" DESTINATION "${_config_folder}")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME piola)
set(CPACK_PACKAGE_CONTACT "The Piola developers <piola@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_STRIP_FILES ON)
include(CPack)
