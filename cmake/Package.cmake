# cpack --preset package: three Debian packages, for processors of the common baseline. `asperity` is the program,
# its module for lua5.4, documents and examples; `asperity-mpi` the part for mpirun, apart because Open MPI is large;
# `libasperity-dev` the engine for C++.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME asperity)
set(CPACK_PACKAGE_VENDOR "The Asperity developers")
set(CPACK_PACKAGE_CONTACT "The Asperity developers <developers@asperity.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME asperity)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "laboratory for rough surfaces, scripted in Lua
 Makes or loads rough surfaces, presses them together through schedules of
 loads, turns them between events, traces them with a stylus and tilts them
 until they slip. Every result carries its cost and its certified error.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# Every chart and picture is drawn by gnuplot.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "gnuplot-nox, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "asperity-mpi, lua5.4, python3-h5py")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libasperity-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "laboratory for rough surfaces, C++ headers and libraries
 The engine of Asperity for C++ programs: find_package(asperity).")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "asperity (= ${PROJECT_VERSION}), pkg-config, libfftw3-dev, libmpfr-dev, \
libxxhash-dev, libpugixml-dev, libzip-dev, libmd-dev, zlib1g-dev")

if(TARGET asperity_part_mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
  set(CPACK_DEBIAN_MPI_PACKAGE_NAME asperity-mpi)
  set(CPACK_COMPONENT_MPI_DESCRIPTION "laboratory for rough surfaces, over the ranks of MPI
 The part of Asperity that spreads a run over the processes of mpirun.")
  set(CPACK_DEBIAN_MPI_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "asperity (= ${PROJECT_VERSION}), openmpi-bin")
endif()
include(CPack)
