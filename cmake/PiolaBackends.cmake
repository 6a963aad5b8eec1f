# SPDX-License-Identifier: Apache-2.0
# Backends: the loops over particles, src/piola/formulations/*/backend.cpp, are compiled once per instruction set. The
# program chooses one of them when it starts. Everything they define lives in an inline namespace named PIOLA_BACKEND.

include(PiolaNativeBackend)
if(DEFINED PIOLA_MACHINES)
  message(WARNING "PIOLA_MACHINES is now PIOLA_INSTRUCTION_SETS")
  set(PIOLA_INSTRUCTION_SETS "${PIOLA_MACHINES}" CACHE STRING "" FORCE)
  unset(PIOLA_MACHINES CACHE)
endif()
set(PIOLA_INSTRUCTION_SETS "all" CACHE STRING
    "Instruction sets: all, quick (portable and SIMD), native (this processor's), two (portable and native), or a list")
set(PIOLA_BACKEND_OPTIMISATION "-O3" CACHE STRING "Optimisation level of the hot files")

set(_flags_scalar "-DPIOLA_SCALAR_LANES=1")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  set(_known scalar v3 v4)
  set(_quick scalar v3)
  list(APPEND _flags_scalar -march=x86-64)
  set(_flags_v3 -march=x86-64-v3)
  set(_flags_v4 -march=x86-64-v4 -mprefer-vector-width=512)
else()
  set(_known scalar native)
  set(_quick scalar native)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
    set(_flags_native -mcpu=native)
  else()
    set(_flags_native -march=native)
  endif()
endif()

if(PIOLA_INSTRUCTION_SETS STREQUAL "all")
  set(PIOLA_BACKENDS_BUILT ${_known})
elseif(PIOLA_INSTRUCTION_SETS STREQUAL "quick")
  set(PIOLA_BACKENDS_BUILT ${_quick})
elseif(PIOLA_INSTRUCTION_SETS STREQUAL "native" AND NOT "native" IN_LIST _known)
  piola_native_backend(PIOLA_BACKENDS_BUILT)
elseif(PIOLA_INSTRUCTION_SETS STREQUAL "two")
  set(PIOLA_BACKENDS_BUILT native)
  if(NOT "native" IN_LIST _known)
    piola_native_backend(PIOLA_BACKENDS_BUILT)
  endif()
  list(PREPEND PIOLA_BACKENDS_BUILT scalar)
  list(REMOVE_DUPLICATES PIOLA_BACKENDS_BUILT)
else()
  set(PIOLA_BACKENDS_BUILT ${PIOLA_INSTRUCTION_SETS})
  foreach(backend IN LISTS PIOLA_BACKENDS_BUILT)
    if(NOT backend IN_LIST _known)
      list(JOIN _known ", " _names)
      message(FATAL_ERROR
        "PIOLA_INSTRUCTION_SETS: unknown '${backend}' (known here: ${_names}, or all, quick, native, two)")
    endif()
  endforeach()
endif()

# Whether object files can be sealed (cmake/seal_backend.sh says why). Builds with sanitizers run where they were made.
set(PIOLA_SEAL FALSE)
if(CMAKE_OBJCOPY AND CMAKE_NM AND CMAKE_LINKER AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  execute_process(COMMAND "${CMAKE_LINKER}" --help OUTPUT_VARIABLE _help ERROR_QUIET)
  if(_help MATCHES "force-group-allocation")
    set(PIOLA_SEAL TRUE)
  else()
    message(STATUS "This linker cannot seal backends: run the program only on processors like this one")
  endif()
endif()
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/backends")

# One object file per formulation and backend, sealed and joined into the library piola (PIOLA_BACKEND_OBJECTS).
set(PIOLA_BACKEND_OBJECTS "")
function(piola_add_backend source backend)
  get_filename_component(folder "${source}" DIRECTORY)
  get_filename_component(formulation "${folder}" NAME)
  string(TOUPPER ${backend} upper)
  set(target piola_${formulation}_${backend})
  add_library(${target} OBJECT "${source}")
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  target_compile_definitions(${target} PRIVATE PIOLA_BACKEND=${backend} PIOLA_BACKEND_IS_${upper}=1)
  # Math functions need not set errno and nobody unmasks floating-point traps; without these two promises compilers do
  # not vectorise sqrt and conditional arithmetic. -ffast-math is never used: sums keep their order.
  target_compile_options(${target} PRIVATE
    ${PIOLA_BACKEND_OPTIMISATION} -fno-math-errno -fno-trapping-math ${_flags_${backend}})
  # A product and a sum become one instruction with every compiler, as g++ does by itself. And g++ 12 takes the
  # undefined operand of its own AVX-512 intrinsics for a mistake (GCC bug 105593), and packs filled lane by lane.
  target_compile_options(${target} PRIVATE -ffp-contract=fast $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized>
                                           $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_libraries(${target} PRIVATE piola_options piola_warnings piola_pie)
  if(NOT PIOLA_SEAL)
    set(PIOLA_BACKEND_OBJECTS ${PIOLA_BACKEND_OBJECTS} $<TARGET_OBJECTS:${target}> PARENT_SCOPE)
    return()
  endif()
  set(sealed "${PROJECT_BINARY_DIR}/backends/${formulation}.${backend}.o")
  add_custom_command(OUTPUT "${sealed}"
    COMMAND "${CMAKE_COMMAND}" -E env "LD=${CMAKE_LINKER}" "NM=${CMAKE_NM}" "OBJCOPY=${CMAKE_OBJCOPY}"
            bash "${PROJECT_SOURCE_DIR}/cmake/seal_backend.sh" ${backend} "${sealed}" $<TARGET_OBJECTS:${target}>
    DEPENDS $<TARGET_OBJECTS:${target}> "${PROJECT_SOURCE_DIR}/cmake/seal_backend.sh"
    COMMENT "Sealing ${formulation} for ${backend}" COMMAND_EXPAND_LISTS VERBATIM)
  set_source_files_properties("${sealed}" PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
  set(PIOLA_BACKEND_OBJECTS ${PIOLA_BACKEND_OBJECTS} "${sealed}" PARENT_SCOPE)
endfunction()

file(GLOB _backend_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/piola/formulations/*/backend.cpp")
foreach(backend IN LISTS PIOLA_BACKENDS_BUILT)
  string(TOUPPER ${backend} _upper)
  target_compile_definitions(piola_options INTERFACE PIOLA_HAS_BACKEND_${_upper}=1)
  foreach(source IN LISTS _backend_sources)
    piola_add_backend("${source}" ${backend})
  endforeach()
endforeach()
list(JOIN PIOLA_BACKENDS_BUILT ", " _names)
message(STATUS "Piola instruction sets: ${_names}")
