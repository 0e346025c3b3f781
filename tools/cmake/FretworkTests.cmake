# SPDX-License-Identifier: GPL-3.0-or-later
# fretwork_test(<name> SOURCES ... LIBRARIES ... [MAIN file] [RANKS 1 2 3]): one executable of GoogleTest tests. Without RANKS each test is
# registered by itself; with RANKS the whole executable runs under mpirun once for each number of ranks.
include(GoogleTest)
set(FRETWORK_MPI_ENVIRONMENT
    "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_rmaps_base_oversubscribe=1;OMPI_MCA_pml=ob1;OMPI_MCA_btl=self,vader,tcp;OMPI_MCA_btl_vader_single_copy_mechanism=none;OMP_NUM_THREADS=1")

function(fretwork_test name)
  cmake_parse_arguments(ARG "" "MAIN" "SOURCES;LIBRARIES;RANKS" ${ARGN})
  if(NOT ARG_MAIN)
    set(ARG_MAIN ${CMAKE_SOURCE_DIR}/tests/test_main.cpp)
  endif()
  add_executable(${name} ${ARG_SOURCES} ${ARG_MAIN})
  fretwork_compile_options(${name})
  target_compile_options(${name} PRIVATE -UNDEBUG)   # assertions are checked in every test
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} fretwork_test_paths GTest::gtest)
  if(ARG_RANKS)
    foreach(ranks ${ARG_RANKS})
      add_test(NAME ${name}_${ranks}_ranks
               COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:${name}>)
      set_tests_properties(${name}_${ranks}_ranks PROPERTIES ENVIRONMENT "${FRETWORK_MPI_ENVIRONMENT}"
                           LABELS ${name} PROCESSORS ${ranks} TIMEOUT 300)
    endforeach()
  else()
    gtest_discover_tests(${name} PROPERTIES LABELS ${name} TIMEOUT 300 DISCOVERY_TIMEOUT 60)
  endif()
endfunction()
