# SPDX-License-Identifier: GPL-3.0-or-later
# fretwork_find_python(<variable> <modules>): a Python that has the modules ("numpy", "h5py, numpy"), or "": FRETWORK_PYTHON, python3 of
# the PATH, Debian's own.
function(fretwork_find_python variable modules)
  foreach(candidate $ENV{FRETWORK_PYTHON} python3 /usr/bin/python3)
    execute_process(COMMAND ${candidate} -c "import sys, ${modules}; print(sys.executable)" RESULT_VARIABLE lacks OUTPUT_VARIABLE executable
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(lacks STREQUAL "0") # by its path: tests may run with another PATH
      set(${variable} ${executable} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${variable} "" PARENT_SCOPE)
endfunction()
