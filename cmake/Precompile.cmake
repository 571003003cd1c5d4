# Headers of the language's library and of GoogleTest, read once for all sources of a kind. Builds from scratch take
# less time and no longer notice an #include that is missing, so that this is for builds made beside an
# ordinary one: CI's second compiler and its sanitizers.
option(ASPERITY_PRECOMPILE "Precompile the headers of libraries" OFF)

# Called on a library whose sources include little but the language's own headers.
function(asperity_precompile target)
  if(NOT ASPERITY_PRECOMPILE)
    return()
  endif()
  if(NOT TARGET asperity_headers)
    set(source ${CMAKE_BINARY_DIR}/precompiled_headers.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "// Compiled with the headers that other targets take from it.\n")
    add_library(asperity_headers STATIC ${source})
    target_link_libraries(asperity_headers PRIVATE asperity_options)
    target_precompile_headers(asperity_headers PRIVATE <algorithm> <chrono> <cmath> <filesystem> <fstream>
                              <functional> <map> <memory> <numbers> <optional> <set> <span> <string> <variant> <vector>)
  endif()
  target_precompile_headers(${target} REUSE_FROM asperity_headers)
endfunction()

# Called on a program of tests.
function(asperity_precompile_tests target)
  if(NOT ASPERITY_PRECOMPILE)
    return()
  endif()
  if(NOT TARGET asperity_test_headers)
    set(source ${CMAKE_BINARY_DIR}/precompiled_test_headers.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "// Compiled with the headers that programs of tests take from it.\n")
    add_executable(asperity_test_headers ${source})
    target_link_libraries(asperity_test_headers PRIVATE asperity_options GTest::gtest_main)
    target_precompile_headers(asperity_test_headers PRIVATE <gtest/gtest.h> <algorithm> <chrono> <cmath> <filesystem>
                              <fstream> <functional> <map> <memory> <numbers> <optional> <set> <span> <sstream>
                              <string> <variant> <vector>)
  endif()
  target_precompile_headers(${target} REUSE_FROM asperity_test_headers)
endfunction()
