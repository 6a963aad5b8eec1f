# SPDX-License-Identifier: Apache-2.0
# The finite elements of bench/finite_elements/ that references come from: a program of its own, no part of the library.

include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-march=native PIOLA_HAS_MARCH_NATIVE)
file(GLOB _sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/bench/finite_elements/*.cpp")
add_executable(piola_finite_elements ${_sources})
target_compile_features(piola_finite_elements PRIVATE cxx_std_20)
target_link_libraries(piola_finite_elements PRIVATE piola_warnings OpenMP::OpenMP_CXX)
# It runs where it was built: all that this processor has, and fused sums.
target_compile_options(piola_finite_elements PRIVATE
  -O3 -ffp-contract=fast $<$<BOOL:${PIOLA_HAS_MARCH_NATIVE}>:-march=native>)
