# The libraries this project stands on. Each is a Debian package; `lab` installs them.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 REQUIRED)
pkg_check_modules(FFTW3 REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(MPFR REQUIRED IMPORTED_TARGET mpfr)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(PUGIXML REQUIRED IMPORTED_TARGET pugixml)
pkg_check_modules(LIBZIP REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(ZLIB REQUIRED IMPORTED_TARGET zlib)
pkg_check_modules(LIBMD REQUIRED IMPORTED_TARGET libmd)
# Linked by asperity-hdf5.so alone, which is loaded at the first HDF5 file written.
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial)
# Linked by asperity-serve.so and asperity-sandbox.so, the page's server and what holds its runs. Without them the
# program builds, and `asperity serve` says what it needs.
pkg_check_modules(HTTPLIB IMPORTED_TARGET cpp-httplib)
pkg_check_modules(SECCOMP IMPORTED_TARGET libseccomp)
pkg_check_modules(LUA_C REQUIRED IMPORTED_TARGET lua5.4)
pkg_check_modules(LUA_CXX REQUIRED IMPORTED_TARGET lua5.4-c++)
