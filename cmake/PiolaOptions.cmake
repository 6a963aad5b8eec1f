# SPDX-License-Identifier: Apache-2.0
# What every source file of Piola is compiled with.

include(CheckCXXSourceCompiles)

set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "Flags of a release" FORCE)
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g" CACHE STRING "Flags of a build for development" FORCE)

option(PIOLA_TOGETHER "Compile several files as one: quicker from scratch, slower after a change" OFF)
# g++ collects garbage from 128 MB on, which takes 7 % of the time of large files. They need 200 to 600 MB in any case.
if(PIOLA_TOGETHER AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(--param=ggc-min-heapsize=500000)
endif()

# piola_options: what users of the library must share with it.
add_library(piola_options INTERFACE)
target_compile_features(piola_options INTERFACE cxx_std_20)
target_compile_definitions(piola_options INTERFACE PIOLA_CONTRACTS=$<BOOL:${PIOLA_CONTRACTS}>)
target_link_libraries(piola_options INTERFACE OpenMP::OpenMP_CXX Threads::Threads fmt::fmt)

# piola_warnings: only for our own files. Sign conversions are left out on purpose: clang counts them under
# -Wconversion, g++ does not, and an index type with a sign makes every subscript of a standard container one.
add_library(piola_warnings INTERFACE)
target_compile_options(piola_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion
  $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow>  # else names of files beside would count as shadowed
  -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=  # messages name files as in the repository
  $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>
  $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>
  $<$<BOOL:${PIOLA_WERROR}>:-Werror>)

# piola_hardened: what makes mistakes harder to abuse, in release builds: a guard before return addresses, checked
# copies, code at random places (piola_pie), and tables of addresses that are read-only once the program runs. The hot
# files of the backends take piola_pie alone: the guard costs 2 % there (piola bench, regular lattice). With a Python
# module the library is position independent, too; without semantic interposition its functions are inlined as before.
# Sanitizers bring guards of their own.
option(PIOLA_HARDENING "Harden release builds (stack protector, checked copies, PIE, full RELRO)" ON)
add_library(piola_pie INTERFACE)
target_link_options(piola_pie INTERFACE LINKER:--build-id=sha1)  # by which results know the program (base/version.hpp)
if(PIOLA_PYTHON)
  target_compile_options(piola_pie INTERFACE -fPIC -fno-semantic-interposition)
endif()
add_library(piola_hardened INTERFACE)
target_link_libraries(piola_hardened INTERFACE piola_pie)
if(PIOLA_HARDENING AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  check_cxx_source_compiles("#ifndef __PIE__\n#error not by itself\n#endif\nint main() {}" PIOLA_PIE_BY_ITSELF)
  if(NOT PIOLA_PIE_BY_ITSELF AND NOT PIOLA_PYTHON)
    target_compile_options(piola_pie INTERFACE $<$<CONFIG:Release>:-fPIE>)
  endif()
  target_link_options(piola_pie INTERFACE $<$<CONFIG:Release>:-pie LINKER:-z,relro LINKER:-z,now>)
  target_compile_options(piola_hardened INTERFACE
    $<$<CONFIG:Release>:-fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2>)
endif()

# piola_host: files that are compiled once, for the baseline of the processor family.
add_library(piola_host INTERFACE)
target_compile_definitions(piola_host INTERFACE PIOLA_BACKEND=host PIOLA_BACKEND_IS_HOST=1)
