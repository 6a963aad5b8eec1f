# SPDX-License-Identifier: Apache-2.0
# Files that become texts inside the program: the sources of the report's page (web/) and the materials of the library
# (data/materials/).

set(_web "${PROJECT_SOURCE_DIR}/web")
set(_scripts frames.js colours.js view.js balls.js surface.js scene.js panels.js verification.js main.js)
set(PIOLA_WEB_SCRIPT "")
foreach(script IN LISTS _scripts)
  file(READ "${_web}/${script}" text)
  string(APPEND PIOLA_WEB_SCRIPT "${text}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${_web}/${script}")
endforeach()
file(READ "${_web}/report.css" PIOLA_WEB_STYLE)
file(READ "${_web}/report.html" PIOLA_WEB_BODY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${_web}/report.css" "${_web}/report.html")
configure_file("${PROJECT_SOURCE_DIR}/cmake/web.cpp.in" "${PROJECT_BINARY_DIR}/web/web.cpp" @ONLY)

# Sources come first, because materials name them; lists of materials have this order.
set(PIOLA_MATERIAL_FILES "")
foreach(name IN ITEMS sources steels aluminium_alloys other_metals high_rate_metals non_metals brittle explosives)
  set(_file "data/materials/${name}.toml")
  file(READ "${PROJECT_SOURCE_DIR}/${_file}" text)
  string(APPEND PIOLA_MATERIAL_FILES "    BuiltInLibraryFile{\"${_file}\", R\"~~~(${text})~~~\"},\n")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${_file}")
endforeach()
configure_file("${PROJECT_SOURCE_DIR}/cmake/materials.cpp.in" "${PROJECT_BINARY_DIR}/data/materials.cpp" @ONLY)
set(PIOLA_EMBEDDED_SOURCES "${PROJECT_BINARY_DIR}/web/web.cpp" "${PROJECT_BINARY_DIR}/data/materials.cpp")
