# The libraries of cmake/Packages.cmake for the wasm preset, as bindings/wasm/dependencies.sh built them.
set(deps ${CMAKE_SOURCE_DIR}/build/wasm-deps)
if(NOT EXISTS ${deps}/lib/libmpfr.a)
  message(FATAL_ERROR "${deps} has no libraries; bindings/wasm/dependencies.sh builds them")
endif()
# package(TARGET [FILE..]): the headers, and the libraries.
function(package target)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${deps}/include)
  foreach(file ${ARGN})
    target_link_libraries(${target} INTERFACE ${deps}/lib/lib${file}.a)
  endforeach()
endfunction()

add_library(Threads::Threads INTERFACE IMPORTED GLOBAL)  # none
package(Eigen3::Eigen)
package(Boost::headers)
package(nlohmann_json::nlohmann_json)
package(CLI11::CLI11)
package(PkgConfig::FFTW3)  # grids over MPI ranks only
package(PkgConfig::MPFR mpfr)
package(PkgConfig::XXHASH xxhash)
package(PkgConfig::PUGIXML pugixml)
package(PkgConfig::LIBZIP zip z)
package(PkgConfig::ZLIB z)
package(PkgConfig::LIBMD md)
package(PkgConfig::LUA_C)
package(PkgConfig::LUA_CXX lua)
