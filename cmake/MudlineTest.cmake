# Every test of the tree is defined by one function, mudline_test.

# Debian's interpreter is the one that has Debian's numpy, scipy and h5py; another python3 may come first in the PATH.
if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)

include(MudlineLauncher)
mudline_launcher(mudline_mpiexec ${MPIEXEC_EXECUTABLE})
if("--oversubscribe" IN_LIST mudline_mpiexec AND NOT MUDLINE_SANITIZE)  # a sanitizer's library must be the first
  add_library(mudline_waiting_ranks MODULE ${CMAKE_CURRENT_LIST_DIR}/../tests/support/waiting_ranks.cpp)
  list(APPEND mudline_mpiexec -x LD_PRELOAD=$<TARGET_FILE:mudline_waiting_ranks>)
endif()

# mudline_test(NAME LABELS word... {SCRIPT file.py | COMMAND program} [argument...] [RANKS n]
#              [ENVIRONMENT name=value...])
#
# SCRIPT is a Python file of the calling folder. RANKS: processors that it takes; for tests that are a run of so many
# ranks and little else. Tests that mostly start runs of one rank take one. Ranks that wait long sleep
# (mudline_waiting_ranks in the place of Open MPI's mpi_yield_when_idle): docs/benchmarks/tests.md tells what it gains.
# They share one machine: Open MPI looks for no network and hwloc for no device, which took a third of a start.
#
# tests/support/cpu_limit.py ends what never would: a test that runs away, after `cpu` seconds on processors of all that
# it starts, and one that hangs, by the clock. The limit is one for all and some five times what the dearest test takes
# on a quick processor, so that a slow one fails none.
function(mudline_test name)
  cmake_parse_arguments(arg "" "RANKS" "LABELS;SCRIPT;COMMAND;ENVIRONMENT" ${ARGN})
  set(cpu 900)
  if(NOT arg_RANKS)
    set(arg_RANKS 1)
  endif()
  if(arg_SCRIPT)
    list(POP_FRONT arg_SCRIPT script)
    set(arg_COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${arg_SCRIPT})
  endif()
  set(support ${PROJECT_SOURCE_DIR}/tests/support)
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} -B ${support}/cpu_limit.py ${cpu} ${arg_COMMAND})
  if(MUDLINE_SANITIZE)
    list(APPEND arg_ENVIRONMENT "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/leaks.supp:print_suppressions=0"
      "UBSAN_OPTIONS=print_stacktrace=1")
  endif()
  math(EXPR wall "3 * ${cpu} + 900")  # cpu_limit.py ends it before
  list(JOIN mudline_mpiexec " " mpiexec)
  set(environment "MUDLINE=$<TARGET_FILE:mudline>" "MUDLINE_MPIEXEC=${mpiexec}" "PYTHONPATH=${support}"
    OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 HWLOC_HIDE_ERRORS=2 OMPI_MCA_mpi_yield_when_idle=1
    OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader OMPI_MCA_osc=sm HWLOC_COMPONENTS=-pci,-linuxio,-opencl,-gl,-x86
    ${arg_ENVIRONMENT})
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${wall} PROCESSORS ${arg_RANKS}
    ENVIRONMENT "${environment}")
endfunction()
