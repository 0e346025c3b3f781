# SPDX-License-Identifier: GPL-3.0-or-later
# `cpack -G DEB` in the build folder: fretwork_<version>_<architecture>.deb, the program, and libfretwork-dev, the libraries.
# What the program links is found by dpkg-shlibdeps; the packages of other programs that it starts are named here.
set(CPACK_PACKAGE_NAME fretwork)
set(CPACK_PACKAGE_VENDOR Fretwork)
set(CPACK_PACKAGE_CONTACT "The Fretwork authors <authors@fretwork.invalid>")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program libraries)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME fretwork)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "From a line mesh to beam modes, a transient with impacts and Coulomb friction
at contacts with clearance, and wear.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3, python3-h5py, python3-numpy, python3-meshio, openmpi-bin, libopenblas0-serial")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-openturns, python3-pandas, python3-xarray, python3-matplotlib, libfretwork-dev, paraview")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/tools/package/postinst ${PROJECT_SOURCE_DIR}/tools/package/prerm)

set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME libfretwork-dev)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARIES_DESCRIPTION "Headers, archives and the CMake package of the libraries mesh, fem, modal,
contact and transient.")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_DEPENDS
    "libeigen3-dev (>= 3.4), libfmt-dev, libssl-dev, libfftw3-dev, libslepc-real-dev, libopenmpi-dev, pkg-config")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_RECOMMENDS "cmake (>= 3.23), g++, fretwork")
include(CPack)
