# SPDX-License-Identifier: Apache-2.0
# The libraries that Piola stands on. All are Debian packages; nothing is fetched. This file is installed and read
# again by find_package(Piola), so it must not depend on anything of this build.

set(_piola_install_hint "run tools/install_dependencies")

find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(PNG REQUIRED)
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(muparser REQUIRED)
find_package(nlohmann_json REQUIRED)

# Libraries without a CMake description of their own, and HDF5, whose description wants a C compiler to be enabled.
function(piola_find_plain_library name header)
  string(TOUPPER ${name} upper)
  find_path(PIOLA_${upper}_INCLUDE ${header} PATH_SUFFIXES hdf5/serial)
  find_library(PIOLA_${upper}_LIBRARY NAMES ${ARGN} PATH_SUFFIXES hdf5/serial)
  if(NOT PIOLA_${upper}_INCLUDE OR NOT PIOLA_${upper}_LIBRARY)
    message(FATAL_ERROR "Piola needs ${name} (header ${header}, library ${ARGN}) - ${_piola_install_hint}")
  endif()
  if(NOT TARGET Piola::${name})
    add_library(Piola::${name} UNKNOWN IMPORTED)
    set_target_properties(Piola::${name} PROPERTIES
      IMPORTED_LOCATION "${PIOLA_${upper}_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${PIOLA_${upper}_INCLUDE}")
  endif()
endfunction()
piola_find_plain_library(hdf5 hdf5.h hdf5_serial hdf5)
piola_find_plain_library(libdeflate libdeflate.h deflate)
piola_find_plain_library(qhull libqhull_r/qhull_ra.h qhull_r)
piola_find_plain_library(cairo cairo/cairo.h cairo)
piola_find_plain_library(webp webp/encode.h webp)
piola_find_plain_library(webpmux webp/mux.h webpmux)
piola_find_plain_library(udunits2 udunits2.h udunits2)
if(PIOLA_MESH)
  piola_find_plain_library(assimp assimp/Importer.hpp assimp)
  piola_find_plain_library(embree embree3/rtcore.h embree3)
endif()

# The C interface alone: Open MPI's headers would bring a C++ one that is long gone from the standard.
if(PIOLA_MPI OR PIOLA_MPI_BESIDE)
  find_path(PIOLA_MPI_INCLUDE mpi.h PATH_SUFFIXES openmpi/include
            PATHS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/openmpi/include)
  find_library(PIOLA_MPI_LIBRARY NAMES mpi PATH_SUFFIXES openmpi/lib)
  if(PIOLA_MPI_INCLUDE AND PIOLA_MPI_LIBRARY AND NOT TARGET Piola::mpi)
    add_library(Piola::mpi UNKNOWN IMPORTED)
    set_target_properties(Piola::mpi PROPERTIES
      IMPORTED_LOCATION "${PIOLA_MPI_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${PIOLA_MPI_INCLUDE}"
      INTERFACE_COMPILE_DEFINITIONS OMPI_SKIP_MPICXX=1)
  elseif(PIOLA_MPI AND NOT TARGET Piola::mpi)
    message(FATAL_ERROR "PIOLA_MPI needs Open MPI (header mpi.h, library mpi) - ${_piola_install_hint} --mpi")
  endif()
endif()

# toml++ is used as headers only: the compiled Debian library aborts on some malformed files, while the headers let the
# reader turn such an assertion into an error message.
find_path(PIOLA_TOML_INCLUDE toml++/toml.h)
if(NOT PIOLA_TOML_INCLUDE)
  message(FATAL_ERROR "Piola needs toml++ (header toml++/toml.h) - ${_piola_install_hint}")
endif()
