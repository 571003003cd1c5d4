# The numeric floors as one shared library, compiled once for each level of processor (ASPERITY_LEVELS, for packages).
# All copies have one file name. The loader takes the highest level that the processor supports, because it searches
# glibc-hwcaps/LEVEL in each folder of its path first. Program, module and higher floors are compiled for the lowest level.
set(levels)
if(ASPERITY_LEVELS)
  set(levels x86-64 x86-64-v3 x86-64-v4)
endif()

# The copies compute the same bits, and stored results name the build they come from: all have one build id, that of the
# lowest level, which is written as an option for the linker of the others.
set(build_id ${CMAKE_CURRENT_BINARY_DIR}/numeric-build-id)
foreach(level IN LISTS levels)
  set(copy asperity_numeric_${level})
  add_library(${copy} SHARED)
  if(level STREQUAL x86-64)
    set(folder .)
    set(export EXPORT asperity)
    target_link_options(${copy} PRIVATE -Wl,--build-id=sha1)
    add_custom_command(TARGET ${copy} POST_BUILD BYPRODUCTS ${build_id} COMMAND ${CMAKE_READELF} -n $<TARGET_FILE:${copy}>
                       | sed -n "s/.*Build ID: /-Wl,--build-id=0x/p" > ${build_id})
  else()
    set(folder glibc-hwcaps/${level})
    set(export)
    target_link_options(${copy} PRIVATE @${build_id})
    set_target_properties(${copy} PROPERTIES LINK_DEPENDS ${build_id})
    add_dependencies(${copy} asperity_numeric_x86-64)
  endif()
  set_target_properties(${copy} PROPERTIES LINKER_LANGUAGE CXX OUTPUT_NAME asperity-numeric-${PROJECT_VERSION}
                        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/${folder})
  # No inline function of the program may replace one of a copy.
  target_link_options(${copy} PRIVATE -Wl,-Bsymbolic)
  target_link_libraries(${copy} PRIVATE Threads::Threads)
  install(TARGETS ${copy} ${export} LIBRARY DESTINATION lib/asperity/${folder} COMPONENT program)
endforeach()

# asperity_levels(NAME SOURCES .. LIBRARIES ..): adds the sources to each copy.
function(asperity_levels name)
  cmake_parse_arguments(PART "" "" "SOURCES;LIBRARIES" ${ARGN})
  foreach(level IN LISTS levels)
    set(objects asperity_${name}_${level})
    add_library(${objects} OBJECT ${PART_SOURCES})
    target_link_libraries(${objects} PRIVATE asperity_options ${PART_LIBRARIES})
    target_compile_options(${objects} PRIVATE -march=${level} -fno-semantic-interposition)
    set_target_properties(${objects} PROPERTIES CXX_VISIBILITY_PRESET default)
    target_sources(asperity_numeric_${level} PRIVATE $<TARGET_OBJECTS:${objects}>)
    target_link_libraries(asperity_numeric_${level} PRIVATE ${PART_LIBRARIES})
  endforeach()
endfunction()
