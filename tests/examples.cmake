# Every lesson runs as it is, and `asperity check` finds no fault: what a lesson says it found, it checks itself.
file(GLOB lessons CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/scripts/lessons/*.lua)
foreach(lesson ${lessons})
  get_filename_component(name ${lesson} NAME_WE)
  add_test(NAME "lessons: ${name}" COMMAND run_script $<TARGET_FILE:asperity> ${lesson})
  add_test(NAME "lessons: check ${name}" COMMAND asperity check ${lesson})
  set_tests_properties("lessons: ${name}" "lessons: check ${name}" PROPERTIES LABELS lessons TIMEOUT 120)
endforeach()

# Every example runs at its default size and must end well, and `asperity check` must find no fault.
file(GLOB examples CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/examples/*.lua ${CMAKE_SOURCE_DIR}/examples/*/*.lua)
foreach(example ${examples})
  get_filename_component(name ${example} NAME_WE)
  add_test(NAME "examples: ${name}" COMMAND run_script $<TARGET_FILE:asperity> ${example})
  add_test(NAME "examples: check ${name}" COMMAND asperity check ${example})
  set_tests_properties("examples: ${name}" "examples: check ${name}" PROPERTIES LABELS examples TIMEOUT 600)
endforeach()
