# `cpack -G DEB` in the build folder: packages for the Debian on which it was built, mudline and mudline-dev.
set(CPACK_PACKAGE_NAME mudline)
set(CPACK_PACKAGE_VENDOR "mudline authors")
set(CPACK_PACKAGE_CONTACT "mudline authors")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE zstd)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME mudline)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
  "openmpi-bin, python3 (>= 3.9), python3-h5py, python3-matplotlib, python3-numpy")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Piles, anchors, penetrometers and footings: program, decks, documents.")
if(MUDLINE_GMSH)
  string(APPEND CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "\nIt holds a library that links Gmsh; as a whole the package is under the GPL.")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME mudline-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "mudline (= ${PROJECT_VERSION}), cmake, g++, pkg-config, trilinos-all-dev, libopenmpi-dev, libhdf5-openmpi-dev, \
libmetis-dev, libmumps-dev, libptscotch-dev, libscotch-dev, liblapack-dev, libopenblas-dev, libboost-dev, \
libtinyxml2-dev, libmuparser-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and libraries with which a plugin is compiled.")
include(CPack)
