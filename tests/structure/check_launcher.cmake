# mudline_launcher asks the launcher at hand who it is: stand-ins say what those of the vendors say.
#   cmake -DFOLDER=<scratch> -P check_launcher.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/../../cmake/MudlineLauncher.cmake)

function(expect name says options)
  set(mpiexec ${FOLDER}/mpiexec_${name})
  file(WRITE ${mpiexec} "#!/bin/sh\necho '${says}'\n")
  file(CHMOD ${mpiexec} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  mudline_launcher(words ${mpiexec})
  if(NOT "${words}" STREQUAL "${mpiexec}${options}")
    message(FATAL_ERROR "${says}: ${words}")
  endif()
endfunction()

set(open_mpi ";--allow-run-as-root;--oversubscribe;--bind-to;none")
expect(open_mpi_4 "mpiexec (OpenRTE) 4.1.4" "${open_mpi}")
expect(open_mpi_5 "mpiexec (Open MPI) 5.0.3" "${open_mpi}")
expect(mpich "HYDRA build details: Version: 4.0.2" "")
expect(intel "Intel(R) MPI Library for Linux* OS, Version 2021.9" "")
