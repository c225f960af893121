# `cmake --install`: program, documents, decks with the examples of plugins; and, as the component `development`,
# headers, libraries and the CMake package "mudline" for authors of plugins.
include(CMakePackageConfigHelpers)
set(mudline_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/mudline)

# What a plugin compiles against: headers and flags only. It links no package, because a second copy of the code and
# its types inside the plugin would not be the program's; the symbols come from the program at dlopen.
add_library(mudline_plugin INTERFACE)
set_target_properties(mudline_plugin PROPERTIES EXPORT_NAME plugin)
target_link_libraries(mudline_plugin INTERFACE mudline_flags)
target_include_directories(mudline_plugin INTERFACE
  $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/packages> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/mudline>)
target_include_directories(mudline_plugin SYSTEM INTERFACE
  $<TARGET_PROPERTY:mudline::trilinos,INTERFACE_INCLUDE_DIRECTORIES>)
target_compile_definitions(mudline_plugin INTERFACE
  $<TARGET_PROPERTY:mudline::trilinos,INTERFACE_COMPILE_DEFINITIONS>)
target_compile_options(mudline_plugin INTERFACE $<TARGET_PROPERTY:mudline::trilinos,INTERFACE_COMPILE_OPTIONS>)
add_library(mudline::plugin ALIAS mudline_plugin)

# The flags are part of the binary interface: -march changes the layout of vectors, sanitisers need their runtime.
separate_arguments(mudline_cxx_flags UNIX_COMMAND "${CMAKE_CXX_FLAGS}")
target_compile_options(mudline_flags INTERFACE "$<INSTALL_INTERFACE:${mudline_cxx_flags}>")

get_property(mudline_packages GLOBAL PROPERTY MUDLINE_PACKAGES)
install(TARGETS ${mudline_packages} mudline_flags mudline_plugin EXPORT mudlineTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(DIRECTORY packages/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mudline COMPONENT development
  FILES_MATCHING PATTERN "*.hpp" PATTERN tests EXCLUDE PATTERN benchmarks EXCLUDE)
if(TARGET mudline)
  install(TARGETS mudline RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(MUDLINE_GMSH)  # the program looks for it there (gmsh_library.cpp)
  install(TARGETS mudline_gmsh LIBRARY DESTINATION libexec/mudline)
endif()
# Without what stands beside an example of a plugin that was built and run in its folder.
install(DIRECTORY inputs DESTINATION ${CMAKE_INSTALL_DATADIR}/mudline
  PATTERN build EXCLUDE PATTERN results EXCLUDE PATTERN "*.so" EXCLUDE)
# The documents as they stand in the repository. Decks and documents refer to each other as if they lay side by side.
install(FILES README.md LICENSE CHANGELOG.md CONTRIBUTING.md CODE_OF_CONDUCT.md CITATION.cff
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN site EXCLUDE PATTERN __pycache__ EXCLUDE)
function(mudline_install_link name from to)
  file(RELATIVE_PATH path /${from} /${to}/${name})
  file(CREATE_LINK ${path} ${PROJECT_BINARY_DIR}/links/${name} SYMBOLIC)
  install(FILES ${PROJECT_BINARY_DIR}/links/${name} DESTINATION ${from})
endfunction()
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/links)
mudline_install_link(inputs ${CMAKE_INSTALL_DOCDIR} ${CMAKE_INSTALL_DATADIR}/mudline)
mudline_install_link(docs ${CMAKE_INSTALL_DATADIR}/mudline ${CMAKE_INSTALL_DOCDIR})

install(EXPORT mudlineTargets NAMESPACE mudline:: DESTINATION ${mudline_config_dir} COMPONENT development)
configure_package_config_file(cmake/mudlineConfig.cmake.in ${PROJECT_BINARY_DIR}/mudlineConfig.cmake
  INSTALL_DESTINATION ${mudline_config_dir} PATH_VARS CMAKE_INSTALL_BINDIR)
# Before version 1 the interface may change with every minor version, and a plugin is bound to its build anyway.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mudlineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mudlineConfig.cmake ${PROJECT_BINARY_DIR}/mudlineConfigVersion.cmake
  cmake/MudlineDependencies.cmake DESTINATION ${mudline_config_dir} COMPONENT development)
