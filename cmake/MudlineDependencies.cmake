# Third-party libraries behind mudline::<name> targets, so that each package sees only what it may see.
# Trilinos 13.2 (plain variables) and 14+ (imported targets) differ only here. The installed package includes this
# same file, so all targets are imported ones: an export then names them and the user's machine finds them anew.
find_package(MPI REQUIRED COMPONENTS C CXX)
set(mudline_trilinos_components Tpetra Belos MueLu Ifpack2 NOX Teuchos KokkosKernels Kokkos)
find_package(Trilinos REQUIRED COMPONENTS ${mudline_trilinos_components})

add_library(mudline::trilinos INTERFACE IMPORTED)
if(TARGET Trilinos::all_selected_libs)
  target_link_libraries(mudline::trilinos INTERFACE Trilinos::all_selected_libs)
else()
  target_include_directories(mudline::trilinos SYSTEM INTERFACE ${Trilinos_INCLUDE_DIRS} ${Trilinos_TPL_INCLUDE_DIRS})
  target_link_libraries(mudline::trilinos INTERFACE ${Trilinos_LIBRARIES} ${Trilinos_TPL_LIBRARIES})
endif()
target_link_libraries(mudline::trilinos INTERFACE MPI::MPI_CXX)

# Light views of the same installation for packages that must not see Tpetra. The header directory is one
# for all of Trilinos in Debian; what a package may include is enforced by tests/structure.
foreach(part teuchos kokkos)
  add_library(mudline::${part} INTERFACE IMPORTED)
  target_link_libraries(mudline::${part} INTERFACE mudline::trilinos)
endforeach()

find_package(PkgConfig REQUIRED)
pkg_check_modules(TINYXML2 REQUIRED IMPORTED_TARGET tinyxml2)
pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)

find_path(METIS_INCLUDE_DIR metis.h REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)
add_library(mudline::metis INTERFACE IMPORTED)
target_include_directories(mudline::metis SYSTEM INTERFACE ${METIS_INCLUDE_DIR})
target_link_libraries(mudline::metis INTERFACE ${METIS_LIBRARY})

find_path(MUMPS_INCLUDE_DIR dmumps_c.h REQUIRED)
find_library(MUMPS_LIBRARY dmumps REQUIRED)
find_library(MUMPS_COMMON_LIBRARY mumps_common REQUIRED)
add_library(mudline::mumps INTERFACE IMPORTED)
target_include_directories(mudline::mumps SYSTEM INTERFACE ${MUMPS_INCLUDE_DIR})
target_link_libraries(mudline::mumps INTERFACE ${MUMPS_LIBRARY} ${MUMPS_COMMON_LIBRARY} MPI::MPI_C)

set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
add_library(mudline::hdf5 INTERFACE IMPORTED)
target_include_directories(mudline::hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(mudline::hdf5 INTERFACE ${HDF5_C_LIBRARIES} MPI::MPI_C)

if(MUDLINE_GMSH)
  find_path(GMSH_INCLUDE_DIR gmsh.h REQUIRED)
  find_library(GMSH_LIBRARY gmsh REQUIRED)
  add_library(mudline::gmsh INTERFACE IMPORTED)
  target_include_directories(mudline::gmsh SYSTEM INTERFACE ${GMSH_INCLUDE_DIR})
  target_link_libraries(mudline::gmsh INTERFACE ${GMSH_LIBRARY})
endif()

find_package(CLI11 REQUIRED)
if(MUDLINE_TESTS)
  find_package(GTest REQUIRED)
endif()
if(MUDLINE_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
