# Every example runs at its default size and must end well, and `asperity check` must find no fault.
file(GLOB examples CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/examples/*.lua ${CMAKE_SOURCE_DIR}/examples/*/*.lua)
foreach(example ${examples})
  get_filename_component(name ${example} NAME_WE)
  add_test(NAME "examples: ${name}" COMMAND run_script $<TARGET_FILE:asperity> ${example})
  add_test(NAME "examples: check ${name}" COMMAND asperity check ${example})
  set_tests_properties("examples: ${name}" "examples: check ${name}" PROPERTIES LABELS examples TIMEOUT 600)
endforeach()
