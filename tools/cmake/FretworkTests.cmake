# SPDX-License-Identifier: GPL-3.0-or-later
# fretwork_test(<name> [HEAVY] SOURCES ... LIBRARIES ... [MAIN file] [RANKS 1 2 3]): one executable of GoogleTest tests. Without RANKS each test is
# registered by itself; with RANKS the whole executable runs under mpirun once for each number of ranks.
include(GoogleTest)
set(FRETWORK_MPI_ENVIRONMENT
    "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_rmaps_base_oversubscribe=1;OMPI_MCA_pml=ob1;OMPI_MCA_btl=self,vader,tcp;OMPI_MCA_btl_vader_single_copy_mechanism=none;OMP_NUM_THREADS=1")

# s: a test that takes longer hangs.
set(FRETWORK_LONGEST_TEST 600)
if(FRETWORK_SANITIZE)
  set(FRETWORK_LONGEST_TEST 1800)
endif()

# What every test's own code is compiled with. HEAVY: tests that compute for seconds themselves; of others the compiler takes most time, but
# with sanitizers.
function(fretwork_test_options target heavy)
  fretwork_compile_options(${target})
  target_compile_options(${target} PRIVATE -UNDEBUG)   # assertions are checked in every test
  if(heavy OR FRETWORK_SANITIZE)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O0>)
  endif()
endfunction()

# fretwork_test_library(<name> [HEAVY] SOURCES ... LIBRARIES ...): what several executables of tests share, compiled once.
function(fretwork_test_library name)
  cmake_parse_arguments(ARG "HEAVY" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  # the flags of executables: a precompiled header fits no others
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(${name} PRIVATE ${CMAKE_CXX_COMPILE_OPTIONS_PIE})
  fretwork_test_options(${name} ${ARG_HEAVY})
  target_include_directories(${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${ARG_LIBRARIES} PRIVATE fretwork_test_paths GTest::gtest)
  if(NOT name MATCHES "_test_main$")
    fretwork_test_headers(${name} ${ARG_HEAVY})
  endif()
  fretwork_unity(${name})
endfunction()

# The precompiled headers of tests/CMakeLists.txt.
function(fretwork_test_headers target heavy)
  if(heavy)
    target_precompile_headers(${target} REUSE_FROM fretwork_heavy_test_main)
  else()
    target_precompile_headers(${target} REUSE_FROM fretwork_test_main)
  endif()
endfunction()

function(fretwork_test name)
  cmake_parse_arguments(ARG "HEAVY" "MAIN" "SOURCES;LIBRARIES;RANKS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES} ${ARG_MAIN})
  fretwork_test_options(${name} ${ARG_HEAVY})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} fretwork_test_paths GTest::gtest)
  fretwork_test_headers(${name} ${ARG_HEAVY})
  fretwork_unity(${name})
  if(NOT ARG_MAIN)
    target_link_libraries(${name} PRIVATE fretwork_test_main)
  endif()
  if(ARG_RANKS)
    foreach(ranks ${ARG_RANKS})
      add_test(NAME ${name}_${ranks}_ranks
               COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:${name}>)
      set_tests_properties(${name}_${ranks}_ranks PROPERTIES ENVIRONMENT "${FRETWORK_MPI_ENVIRONMENT}"
                           LABELS ${name} PROCESSORS ${ranks} TIMEOUT ${FRETWORK_LONGEST_TEST})
    endforeach()
  else()
    gtest_discover_tests(${name} PROPERTIES LABELS ${name} TIMEOUT ${FRETWORK_LONGEST_TEST} DISCOVERY_TIMEOUT 60)
  endif()
endfunction()
