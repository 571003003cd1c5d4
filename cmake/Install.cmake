# cmake --install build/release --prefix /usr/local: the program with its parts, the module where Debian's lua5.4
# looks for it, the documents and examples (component `program`); the part for mpirun (`mpi`); the engine's headers
# and libraries for find_package(asperity) (`development`). cmake/Package.cmake makes a Debian package of each.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)

# Where the loader looks for the numeric library, if it is one of its own (ASPERITY_LEVELS): next to the program in the
# build's folder, in lib/asperity when installed. Without /proc the loader does not know $ORIGIN of a program. One list for
# both, because CMake would pad a list to replace with empty entries, which stand for the current folder.
if(ASPERITY_LEVELS)
  set(installed ${CMAKE_INSTALL_PREFIX}/lib/asperity)
  set_target_properties(asperity asperity_module PROPERTIES BUILD_WITH_INSTALL_RPATH ON)
  set_target_properties(asperity PROPERTIES INSTALL_RPATH "$ORIGIN;$ORIGIN/../lib/asperity;${installed}")
  set_target_properties(asperity_module PROPERTIES INSTALL_RPATH "$ORIGIN;$ORIGIN/../../asperity;${installed}")
endif()
install(TARGETS asperity RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS asperity_module LIBRARY DESTINATION lib/lua/5.4)
# Parts loaded when first needed: core/loaded_part.cpp looks here.
install(TARGETS asperity_part_hdf5 LIBRARY DESTINATION lib/asperity)
# The page's server and the filter of its runs.
foreach(part serve sandbox)
  if(TARGET asperity_part_${part})
    install(TARGETS asperity_part_${part} LIBRARY DESTINATION lib/asperity)
  endif()
endforeach()
if(TARGET asperity_part_mpi)
  install(TARGETS asperity_part_mpi LIBRARY DESTINATION lib/asperity COMPONENT mpi)
endif()
if(TARGET asperity_part_edit)
  install(TARGETS asperity_part_edit LIBRARY DESTINATION lib/asperity)
endif()
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES docs/asperity.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES docs/asperity.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME asperity)
install(DIRECTORY scripts/lessons DESTINATION ${CMAKE_INSTALL_DATADIR}/asperity)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
# The documents' site for `asperity serve`, if `./lab docs` built it.
install(DIRECTORY build/site DESTINATION ${CMAKE_INSTALL_DATADIR}/asperity OPTIONAL)

# asperity::engine is the whole of it; each floor has a name of its own (engine/CMakeLists.txt).
add_library(asperity_engine INTERFACE)
set_target_properties(asperity_engine PROPERTIES EXPORT_NAME engine)
target_link_libraries(asperity_engine INTERFACE asperity_study)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/asperity)
install(TARGETS asperity_engine EXPORT asperity COMPONENT development)
# Headers whose code depends on the vector width stay private: a program that includes them may have another width.
set(private "/core/fourier/fourier_(batch|filter|lane_filter|lanes)\\.hpp|/register_vectors\\.hpp"
            "/node_loop\\.hpp|/(contact_preconditioner|half_order_pyramid)\\.hpp"
            "/slabs/slab_(descent|level|nest|preconditioner|quality)\\.hpp"
            "/half_space/solver/(contact_level|contact_quality|descent|free_set|load_projection|nested_descent)\\.hpp")
list(JOIN private "|" private)
install(DIRECTORY engine DESTINATION include/asperity COMPONENT development FILES_MATCHING PATTERN "*.hpp"
        REGEX "${private}" EXCLUDE)
install(EXPORT asperity NAMESPACE asperity:: FILE asperityTargets.cmake DESTINATION ${package_folder}
        COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/asperityConfig.cmake.in
                              ${CMAKE_BINARY_DIR}/asperityConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/asperityConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/asperityConfig.cmake ${CMAKE_BINARY_DIR}/asperityConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT development)

include(Package)
