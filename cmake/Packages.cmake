# The libraries this project stands on. Each is a Debian package; `lab` installs them.
find_package(PkgConfig REQUIRED)

# library(PREFIX MODULE PACKAGE): a library by the name pkg-config knows it by, and the package that brings it.
macro(library prefix module package)
  pkg_check_modules(${prefix} IMPORTED_TARGET ${module})
  if(NOT ${prefix}_FOUND)
    message(FATAL_ERROR "${module} was not found; install ${package}")
  endif()
endmacro()

find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
# Headers alone: distributions, minima, Sobol's points, numbers of many digits.
find_package(Boost 1.74)
if(NOT Boost_FOUND)
  message(FATAL_ERROR "Boost 1.74 was not found; install libboost-dev")
endif()
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 REQUIRED)
library(FFTW3 fftw3 libfftw3-dev)
library(MPFR mpfr libmpfr-dev)
library(XXHASH libxxhash libxxhash-dev)
library(PUGIXML pugixml libpugixml-dev)
library(LIBZIP libzip libzip-dev)
library(ZLIB zlib zlib1g-dev)
library(LIBMD libmd libmd-dev)
# Linked by asperity-hdf5.so alone, which is loaded at the first HDF5 file written.
library(HDF5 hdf5-serial libhdf5-dev)
# Linked by asperity-serve.so and asperity-sandbox.so, the page's server and what holds its runs. Without them the
# program builds, and `asperity serve` says what it needs.
pkg_check_modules(HTTPLIB IMPORTED_TARGET cpp-httplib)
pkg_check_modules(SECCOMP IMPORTED_TARGET libseccomp)
library(LUA_C lua5.4 liblua5.4-dev)
library(LUA_CXX lua5.4-c++ liblua5.4-dev)
