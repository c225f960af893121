# One package = one static library mudline_<name> (alias mudline::<name>), include root packages/,
# and, when tests/ holds *_test.cpp, one gtest executable <name>_tests. Files named *_test.np2.cpp run on 2 ranks.
# benchmarks/ holds timed figures, with a CMakeLists.txt: programs to run by hand (docs/benchmarks), never tests.
#
#   mudline_package(materials SOURCES a.cpp b.cpp DEPENDS core tensor PRECOMPILED light
#                   [ALONE heavy.cpp ...] [PRIVATE mudline::metis ...] [KERNELS] [GMSH_TESTS])
#
# DEPENDS are packages (the include arrows); PRIVATE are third-party targets; the tests of GMSH_TESTS use Gmsh where
# MUDLINE_HAVE_GMSH is defined.
# The presets release, avx2 and ci compile eight sources as one (CMAKE_UNITY_BUILD), which halves the time for reading
# headers and templates; ALONE are heavy sources, which are compiled by themselves. Names in the unnamed namespaces of a
# package must therefore differ. Tests are compiled one by one.
# PRECOMPILED names the precompiled headers of the package and its tests (mudline_precompiled below). KERNELS: the
# package has the loops in which a run spends its time. A release optimises them most (-O3), other packages less (-O2)
# and tests least (-O1), which takes a third off the time that tests compile. The numbers are the same.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)  # paths relative to the checkout: clones share what was compiled once
  set(ccache ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ccache} ${CCACHE_PROGRAM})
  set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
  # Precompiled headers are looked up by the content of the headers, apart from what earlier versions stored. By
  # preprocessed text a changed comment found the old ones, in which g++ does not recognise the changed header, and all
  # that it declares was declared twice.
  set(precompiled_launcher ${ccache} CCACHE_DEPEND=1 CCACHE_NAMESPACE=mudline-precompiled ${CCACHE_PROGRAM})
else()
  set(precompiled_launcher ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=lld MUDLINE_HAVE_LLD)
if(MUDLINE_HAVE_LLD)
  add_link_options(-fuse-ld=lld)
endif()
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)  # Trilinos outside the system's folders is found after installation too
set_property(GLOBAL APPEND PROPERTY JOB_POOLS heavy=1 link=1)
set(CMAKE_JOB_POOL_LINK link)

add_library(mudline_flags INTERFACE)
target_compile_features(mudline_flags INTERFACE cxx_std_17)
# Open MPI's C++ classes are not used, and they were compiled into every object.
target_compile_definitions(mudline_flags INTERFACE OMPI_SKIP_MPICXX)
target_compile_options(mudline_flags INTERFACE $<BUILD_INTERFACE:-Wall;-Wextra;-Wno-unused-parameter>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(mudline_flags INTERFACE $<BUILD_INTERFACE:-fpch-preprocess>)  # what ccache wants
endif()
if(MUDLINE_WERROR)
  target_compile_options(mudline_flags INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()

if(MUDLINE_SANITIZE)
  add_compile_options(-O1 -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

# mudline_precompiled(NAME header...): headers that are compiled once for all packages that name it. They save reading
# time only: every source still includes what it uses, which the presets debug and sanitize check by doing without.
function(mudline_precompiled name)
  add_library(mudline_precompiled_${name} OBJECT ${CMAKE_SOURCE_DIR}/cmake/precompiled.cpp)
  set_target_properties(mudline_precompiled_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON
    CXX_COMPILER_LAUNCHER "${precompiled_launcher}")
  target_include_directories(mudline_precompiled_${name} PRIVATE ${CMAKE_SOURCE_DIR}/packages)
  target_link_libraries(mudline_precompiled_${name} PRIVATE mudline_flags mudline::trilinos)
  target_precompile_headers(mudline_precompiled_${name} PRIVATE <algorithm> <array> <cmath> <functional> <map> <memory>
    <optional> <set> <sstream> <string> <vector> ${ARGN})
endfunction()
mudline_precompiled(light <Teuchos_ParameterList.hpp> <Kokkos_Core.hpp>)
mudline_precompiled(tpetra <Teuchos_CommHelpers.hpp> <Tpetra_FECrsMatrix.hpp> <Tpetra_Operator.hpp>)
mudline_precompiled(framework <Teuchos_CommHelpers.hpp> <framework/term.hpp>)
mudline_precompiled(simulation <Teuchos_CommHelpers.hpp> <simulation/model.hpp>)

function(mudline_package name)
  cmake_parse_arguments(arg "KERNELS;GMSH_TESTS" "PRECOMPILED" "SOURCES;ALONE;DEPENDS;PUBLIC;PRIVATE" ${ARGN})
  add_library(mudline_${name} STATIC ${arg_SOURCES} ${arg_ALONE})
  add_library(mudline::${name} ALIAS mudline_${name})
  set_target_properties(mudline_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${name})
  target_include_directories(mudline_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/packages> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/mudline>)
  target_link_libraries(mudline_${name} PUBLIC mudline_flags)
  target_precompile_headers(mudline_${name} REUSE_FROM mudline_precompiled_${arg_PRECOMPILED})
  set_source_files_properties(${arg_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  if(NOT arg_KERNELS)
    target_compile_options(mudline_${name} PRIVATE $<$<CONFIG:Release>:-O2>)
  endif()
  foreach(dependency ${arg_DEPENDS})
    target_link_libraries(mudline_${name} PUBLIC mudline_${dependency})
  endforeach()
  target_link_libraries(mudline_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY MUDLINE_PACKAGES mudline_${name})

  if(MUDLINE_TESTS)
    mudline_package_tests(${name} ${arg_PRECOMPILED} ${arg_GMSH_TESTS})
  endif()
  if(MUDLINE_BENCHMARKS AND EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/benchmarks/CMakeLists.txt)
    add_subdirectory(benchmarks)
  endif()
endfunction()

function(mudline_package_tests name precompiled gmsh)
  file(GLOB serial CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/tests/*_test.cpp)
  file(GLOB parallel CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/tests/*_test.np2.cpp)
  foreach(kind serial parallel)
    if(NOT ${kind})
      continue()
    endif()
    if("${kind}" STREQUAL "serial")
      set(target ${name}_tests)
      set(ranks 1)
    else()
      set(target ${name}_tests_np2)
      set(ranks 2)
    endif()
    add_executable(${target} ${${kind}} ${CMAKE_SOURCE_DIR}/cmake/gtest_main.cpp)
    target_link_libraries(${target} PRIVATE mudline_${name} mudline::trilinos GTest::gtest)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1> -fPIC)  # -fPIC as the package, whose precompiled headers serve here too
    target_precompile_headers(${target} REUSE_FROM mudline_precompiled_${precompiled})
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
    target_compile_definitions(${target} PRIVATE MUDLINE_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
    if(MUDLINE_GMSH AND gmsh)
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:mudline_gmsh_objects>)
      target_link_libraries(${target} PRIVATE mudline::gmsh)
      target_compile_definitions(${target} PRIVATE MUDLINE_HAVE_GMSH)
    endif()
    mudline_test(unit.${target} LABELS unit RANKS ${ranks} COMMAND ${mudline_mpiexec} -n ${ranks} $<TARGET_FILE:${target}>)
  endforeach()
endfunction()
