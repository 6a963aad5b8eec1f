# SPDX-License-Identifier: Apache-2.0
# Micro benchmarks: bench/*.cpp become one program.

find_package(benchmark)
file(GLOB _sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/bench/*.cpp")
if(NOT benchmark_FOUND)
  message(STATUS "Google Benchmark not found: the micro benchmarks are not built")
elseif(_sources)
  add_executable(piola_bench ${_sources})
  target_link_libraries(piola_bench PRIVATE
    piola piola_warnings piola_host benchmark::benchmark benchmark::benchmark_main)
endif()
