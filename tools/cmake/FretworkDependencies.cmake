# SPDX-License-Identifier: GPL-3.0-or-later
# Third-party libraries, all packages of Debian 12.
find_package(MPI REQUIRED COMPONENTS CXX)   # slepc.pc does not name the MPI include directory
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(PkgConfig REQUIRED)
pkg_search_module(SLEPC REQUIRED IMPORTED_TARGET slepc SLEPc)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-openmpi)   # the flavour PETSc uses: never two HDF5 in one process
# Debian's *.pc files carry flags its own packages were built with (-D_FORTIFY_SOURCE=2): not ours, and precompiled headers fit no others.
set_target_properties(PkgConfig::SLEPC PkgConfig::HDF5 PROPERTIES INTERFACE_COMPILE_OPTIONS "")
pkg_check_modules(CRYPTO REQUIRED IMPORTED_TARGET libcrypto)   # OpenSSL: SHA-256 by the instructions of the processor
pkg_check_modules(FFTW REQUIRED IMPORTED_TARGET fftw3)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
# FMT_SHARED only makes fmt's symbols visible, which they are here anyway; precompiled headers serve targets with and without fmt.
set_target_properties(fmt::fmt PROPERTIES INTERFACE_COMPILE_DEFINITIONS "")
find_package(Boost 1.74 REQUIRED)   # Boost.Math, headers only
find_path(GMSH_INCLUDE_DIR gmsh.h REQUIRED)
find_library(GMSH_LIBRARY gmsh REQUIRED)
add_library(gmsh_api INTERFACE)
target_include_directories(gmsh_api SYSTEM INTERFACE ${GMSH_INCLUDE_DIR})
target_link_libraries(gmsh_api INTERFACE ${GMSH_LIBRARY})
if(FRETWORK_TESTS)
  find_package(GTest REQUIRED)
endif()
if(FRETWORK_BENCH)
  find_package(benchmark REQUIRED)
endif()
