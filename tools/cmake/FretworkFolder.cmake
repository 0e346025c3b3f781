# SPDX-License-Identifier: GPL-3.0-or-later
# One folder = one namespace = one target. A folder's headers are seen as "folder/header.hpp", and only by the targets that
# link the folder: each folder is published through an include directory of its own (build/include/<folder>/<folder> is a
# link to it), so that an include against the direction of the architecture does not compile. A folder inside another one,
# "folder/component", is a target of its own likewise, in the namespace of the outer one.

function(fretwork_publish target folder)
  string(REPLACE "/" "_" name ${folder})
  set(root ${CMAKE_BINARY_DIR}/include/${name})
  cmake_path(GET folder PARENT_PATH parent)
  file(MAKE_DIRECTORY ${root}/${parent})
  if(NOT EXISTS ${root}/${folder})
    file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${folder} ${root}/${folder} SYMBOLIC)
  endif()
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${root}>)
endfunction()

function(fretwork_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # version 12 sees uninitialised values where Eigen's kernels have been inlined. Units of several sources take up to 2 GB in any case: looking for memory to
    # free takes a seventh of its time.
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized --param=ggc-min-heapsize=1500000)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    # It would zero and copy structures of some hundred bytes by rep stos and rep movs instead of memset and memcpy: runs with contacts took 10 % longer.
    target_compile_options(${target} PRIVATE -mstringop-strategy=libcall)
  endif()
  if(FRETWORK_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(FRETWORK_AUDIT)
    target_compile_options(${target} PRIVATE -UNDEBUG)
    target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
  endif()
  if(FRETWORK_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=address,undefined -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
    target_compile_definitions(${target} PUBLIC FRETWORK_SANITIZED)
    # Eigen offsets the null pointer of an empty matrix. The other three take half of the compiler's time, and what they report ends a program under
    # the address sanitizer anyway: accesses through null, outside of an object, or by vectors at an address that is not theirs.
    if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
      target_compile_options(${target} PUBLIC -fno-sanitize=pointer-overflow,null,alignment,object-size)
    endif()
  endif()
  if(FRETWORK_FUZZ)
    target_compile_options(${target} PUBLIC -fsanitize=fuzzer-no-link)
    target_link_options(${target} PUBLIC -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# ccache looks at files with precompiled headers only where it is told that this is meant.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
  list(PREPEND CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros)
endif()

# The headers of others that most files include, compiled once for each set of options. A precompiled header fits no other macros than its own: fmt's are
# taken from its target (FretworkDependencies.cmake); toml++ is left out. Files include what they use all the same: the preset dev builds without.
function(fretwork_precompiled_headers name)
  if(NOT TARGET ${name})
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cpp CONTENT "")
    add_library(${name} STATIC ${CMAKE_BINARY_DIR}/${name}.cpp)
    fretwork_compile_options(${name})
    target_compile_options(${name} PRIVATE ${ARGN})
    target_link_libraries(${name} PRIVATE Eigen3::Eigen fmt::fmt)
    target_precompile_headers(${name} PRIVATE <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <cmath> <filesystem> <fmt/format.h> <fstream>
                              <functional> <map> <memory> <optional> <span> <string> <variant> <vector>)
  endif()
endfunction()

# Sources of a target compiled as one, at most 28: the headers that they share, and what these instantiate, are then paid for once; two units of 28
# take three quarters of the time of seven of 8, and up to 2 GB each. Names of unnamed namespaces must differ within a folder. Sources with options of their own are left alone.
function(fretwork_unity target)
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources count)
  math(EXPR units "(${count} + 27) / 28")
  math(EXPR size "(${count} + ${units} - 1) / ${units}")
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${FRETWORK_UNITY} UNITY_BUILD_BATCH_SIZE ${size})
  if(NOT FRETWORK_UNITY)
    return()
  endif()
  # names of other sources of the folder are no shadows; without unity builds they are told
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU") # which takes a source that another one includes for a header
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage -Wno-shadow -Wshadow=local)
  else()
    target_compile_options(${target} PRIVATE -Wno-shadow)
  endif()
endfunction()

# fretwork_folder(<folder> [COLD] [TARGET name] SOURCES ... [KNOWS folders ...] [LIBRARIES private third-party ...])
# COLD: what runs before and after the time loop. Its time goes to the compiler, not to the processor that runs it.
function(fretwork_folder folder)
  cmake_parse_arguments(ARG "COLD" "TARGET" "SOURCES;KNOWS;LIBRARIES" ${ARGN})
  if(NOT ARG_TARGET)
    string(REPLACE "/" "_" name ${folder})
    set(ARG_TARGET fretwork_${name})
  endif()
  add_library(${ARG_TARGET} STATIC ${ARG_SOURCES})
  fretwork_publish(${ARG_TARGET} ${folder})
  fretwork_compile_options(${ARG_TARGET})
  target_compile_features(${ARG_TARGET} PUBLIC cxx_std_20)
  target_link_libraries(${ARG_TARGET} PUBLIC Eigen3::Eigen)
  foreach(known ${ARG_KNOWS})
    string(REPLACE "/" "_" known ${known})
    target_link_libraries(${ARG_TARGET} PUBLIC fretwork_${known})
  endforeach()
  target_link_libraries(${ARG_TARGET} PRIVATE ${ARG_LIBRARIES})
  if(ARG_COLD)
    fretwork_precompiled_headers(fretwork_cold_headers $<$<CONFIG:Release>:-O1>)
    target_compile_options(${ARG_TARGET} PRIVATE $<$<CONFIG:Release>:-O1>)
    target_precompile_headers(${ARG_TARGET} REUSE_FROM fretwork_cold_headers)
  else()
    fretwork_precompiled_headers(fretwork_headers)
    target_precompile_headers(${ARG_TARGET} REUSE_FROM fretwork_headers)
  endif()
  fretwork_unity(${ARG_TARGET})
endfunction()

# The options of loops over vectors (kernels/vector_lanes.hpp).
function(fretwork_kernel_sources)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "-O3;-Wno-psabi;-fno-math-errno;-fno-trapping-math;-falign-functions=64"
                              SKIP_PRECOMPILE_HEADERS ON)   # they fit no other mathematics
endfunction()
