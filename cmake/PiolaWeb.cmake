# SPDX-License-Identifier: Apache-2.0
# The sources of the report's page (web/) become texts inside the program.

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
