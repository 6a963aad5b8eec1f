# SPDX-License-Identifier: Apache-2.0
# What every source file of Piola is compiled with.

set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "Flags of a release" FORCE)
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g" CACHE STRING "Flags of a build for development" FORCE)

# piola_options: what users of the library must share with it.
add_library(piola_options INTERFACE)
target_compile_features(piola_options INTERFACE cxx_std_20)
target_compile_definitions(piola_options INTERFACE PIOLA_CONTRACTS=$<BOOL:${PIOLA_CONTRACTS}>)
target_link_libraries(piola_options INTERFACE OpenMP::OpenMP_CXX Threads::Threads fmt::fmt)

# piola_warnings: only for our own files. Sign conversions are left out on purpose: clang counts them under
# -Wconversion, g++ does not, and an index type with a sign makes every subscript of a standard container one.
add_library(piola_warnings INTERFACE)
target_compile_options(piola_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=  # messages name files as in the repository
  $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>
  $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>
  $<$<BOOL:${PIOLA_WERROR}>:-Werror>)

# piola_host: files that are compiled once, for the baseline of the processor family.
add_library(piola_host INTERFACE)
target_compile_definitions(piola_host INTERFACE PIOLA_MACHINE=host PIOLA_MACHINE_IS_HOST=1)
