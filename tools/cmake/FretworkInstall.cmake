# SPDX-License-Identifier: GPL-3.0-or-later
# `cmake --install`: component `program` (program, report, manual, examples, completions) and component `libraries` (headers under
# include/fretwork, archives, the package configuration that find_package(Fretwork) reads). The program finds its parts by their place
# beside its own folder: ../libexec/fretwork, ../share/fretwork. A prefix can therefore be moved as a whole.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(documents share/doc/fretwork)

install(TARGETS fretwork RUNTIME DESTINATION bin COMPONENT program)
install(TARGETS fretwork-geometry RUNTIME DESTINATION libexec/fretwork COMPONENT program)
install(DIRECTORY python/fretwork DESTINATION share/fretwork/python COMPONENT program PATTERN __pycache__ EXCLUDE)
install(FILES sweep/openturns_helper.py DESTINATION share/fretwork/sweep COMPONENT program)
install(FILES doc/fretwork.1 DESTINATION share/man/man1 COMPONENT program)
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE tools/package/copyright DESTINATION ${documents} COMPONENT program)
install(DIRECTORY doc DESTINATION ${documents} COMPONENT program FILES_MATCHING PATTERN *.md PATTERN *.png PATTERN *.svg)
install(DIRECTORY examples DESTINATION ${documents} COMPONENT program
        PATTERN *.results EXCLUDE PATTERN *.sweep EXCLUDE PATTERN build EXCLUDE)
install(FILES app/completion/fretwork DESTINATION share/bash-completion/completions COMPONENT program)
# Debian's zsh looks for the functions of packages, of prefix /usr, in a folder of their own.
install(CODE "
  set(functions site-functions)
  if(CMAKE_INSTALL_PREFIX MATCHES \"/usr\$\")
    set(functions vendor-completions)
  endif()
  file(INSTALL \"${PROJECT_SOURCE_DIR}/app/completion/_fretwork\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}/share/zsh/\${functions}\")"
  COMPONENT program)

# fretwork_<x> is exported as Fretwork::<x>, with the components of transient.
set(folders core signals kernels vibration mesh fem modal contact transient)
set(libraries core core_mpi core_petsc mesh fem fem_petsc modal modal_slepc contact signals kernels vibration)
get_property(components DIRECTORY transient PROPERTY SUBDIRECTORIES)
foreach(component ${components})
  cmake_path(GET component FILENAME component)
  list(APPEND libraries transient_${component})
endforeach()
list(APPEND libraries transient)
foreach(library ${libraries})
  set_target_properties(fretwork_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS fretwork_${library} EXPORT FretworkTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries
          INCLUDES DESTINATION include/fretwork)
endforeach()
install(FILES tools/package/copyright DESTINATION share/doc/libfretwork-dev COMPONENT libraries)
install(DIRECTORY ${folders} DESTINATION include/fretwork COMPONENT libraries FILES_MATCHING PATTERN *.hpp)
set(configuration ${CMAKE_INSTALL_LIBDIR}/cmake/Fretwork)
install(EXPORT FretworkTargets NAMESPACE Fretwork:: DESTINATION ${configuration} COMPONENT libraries)
configure_package_config_file(tools/cmake/FretworkConfig.cmake.in FretworkConfig.cmake INSTALL_DESTINATION ${configuration}
                              NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(FretworkConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/FretworkConfig.cmake ${PROJECT_BINARY_DIR}/FretworkConfigVersion.cmake
        DESTINATION ${configuration} COMPONENT libraries)
