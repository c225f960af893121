# Every test of the tree is defined by one function, mudline_test.

# Debian's interpreter is the one that has Debian's numpy, scipy and h5py; another python3 may come first in the PATH.
if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)

include(MudlineLauncher)
mudline_launcher(mudline_mpiexec ${MPIEXEC_EXECUTABLE})

# mudline_test(NAME LABELS word... {SCRIPT file.py | COMMAND program} [argument...] [CPU seconds] [RANKS n]
#              [ENVIRONMENT name=value...])
#
# SCRIPT is a Python file of the calling folder. CPU (300) limits the time on processors of all that the test starts, all
# ranks together (tests/support/cpu_limit.py); the clock on the wall ends only what hangs. RANKS: processors that it takes.
function(mudline_test name)
  cmake_parse_arguments(arg "" "CPU;RANKS" "LABELS;SCRIPT;COMMAND;ENVIRONMENT" ${ARGN})
  if(NOT arg_CPU)
    set(arg_CPU 300)
  endif()
  if(NOT arg_RANKS)
    set(arg_RANKS 1)
  endif()
  if(arg_SCRIPT)
    list(POP_FRONT arg_SCRIPT script)
    set(arg_COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${arg_SCRIPT})
  endif()
  set(support ${PROJECT_SOURCE_DIR}/tests/support)
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} -B ${support}/cpu_limit.py ${arg_CPU} ${arg_COMMAND})
  if(MUDLINE_SANITIZE)
    list(APPEND arg_ENVIRONMENT "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/leaks.supp:print_suppressions=0"
      "UBSAN_OPTIONS=print_stacktrace=1")
  endif()
  math(EXPR wall "11 * ${arg_CPU} + 900")  # cpu_limit.py ends it before
  list(JOIN mudline_mpiexec " " mpiexec)
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${wall} PROCESSORS ${arg_RANKS} ENVIRONMENT
    "MUDLINE=$<TARGET_FILE:mudline>;MUDLINE_MPIEXEC=${mpiexec};PYTHONPATH=${support};OMP_NUM_THREADS=1;OPENBLAS_NUM_THREADS=1;HWLOC_HIDE_ERRORS=2;${arg_ENVIRONMENT}")
endfunction()
