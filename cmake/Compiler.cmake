# Language level, warnings, sanitizers and machine flags, the same for every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

add_library(asperity_options INTERFACE)
target_include_directories(asperity_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(asperity_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       -Wno-sign-conversion -Wnon-virtual-dtor)
# GCC 12 sees an overlap in `"text" + std::string` that is not there (GCC bug 105651).
target_compile_options(asperity_options INTERFACE
                       $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
# Sources compiled several at once see one another's globals: what those shadow, or lend to a type, is no fault then.
if(CMAKE_UNITY_BUILD)
  target_compile_options(asperity_options INTERFACE -Wno-shadow
                         $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local> $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
# For code that waits for the engine: bindings and tests. A page has to load it.
if(EMSCRIPTEN)
  set(ASPERITY_LIGHT_OPTIMISATION -Oz)
else()
  set(ASPERITY_LIGHT_OPTIMISATION $<$<CONFIG:Release>:-O1>)
endif()
# g++ collects its garbage from 128 MiB on by default. From 512 MiB on, a unity source of contact compiles in 24 s instead of
# 29 s of processor time, with 1.0 GiB of memory instead of 0.7 (AMD EPYC, Zen 5).
target_compile_options(asperity_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
# Contraction of a*b+c would make debug, release and clang builds disagree in the last bit.
target_compile_options(asperity_options INTERFACE -ffp-contract=off)
target_compile_definitions(asperity_options INTERFACE EIGEN_DONT_PARALLELIZE)
# Results that are kept for later name the build they come from.
if(NOT EMSCRIPTEN)
  target_link_options(asperity_options INTERFACE -Wl,--build-id=sha1)
endif()
if(ASPERITY_WARNINGS_AS_ERRORS)
  target_compile_options(asperity_options INTERFACE -Werror)
endif()
# For what computes on grids: the floors up to friction and accuracy, tests and benchmarks. What stands above them gains nothing, and
# is compiled once for a build of this processor and for packages.
add_library(asperity_processor INTERFACE)
if(ASPERITY_NATIVE)
  target_compile_options(asperity_processor INTERFACE -march=native)
endif()
if(ASPERITY_SANITIZE)
  target_compile_options(asperity_options INTERFACE -fsanitize=${ASPERITY_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(asperity_options INTERFACE -fsanitize=${ASPERITY_SANITIZE})
  # What GCC adds for the sanitizer hides from it where a value was set; the release build looks for values that were not.
  target_compile_options(asperity_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  if(ASPERITY_SANITIZE MATCHES undefined)
    target_compile_options(asperity_options INTERFACE -fno-sanitize-recover=undefined)
  endif()
endif()
