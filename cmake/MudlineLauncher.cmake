# mudline_launcher(RESULT MPIEXEC): the words that start a program on several ranks, without "-n" and their number. More
# ranks than cores, run by root or not, and none bound to a core, so that tests beside each other share the cores. Open
# MPI has to be told so (its mpiexec names itself OpenRTE before version 5); MPICH, Intel MPI and others do it anyway and
# know none of these options.
function(mudline_launcher result mpiexec)
  execute_process(COMMAND ${mpiexec} --version OUTPUT_VARIABLE version ERROR_VARIABLE version)
  set(words ${mpiexec})
  if(version MATCHES "Open ?MPI|OpenRTE")
    list(APPEND words --allow-run-as-root --oversubscribe --bind-to none)
  endif()
  set(${result} ${words} PARENT_SCOPE)
endfunction()
