# cmake --install build/release --prefix /usr/local: the program, the module where Debian's lua5.4
# looks for it, the documents, the editor's types and the examples.
include(GNUInstallDirs)
install(TARGETS asperity RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS asperity_module LIBRARY DESTINATION lib/lua/5.4)
# Parts loaded when first needed: core/loaded_part.cpp looks here.
install(TARGETS asperity_part_hdf5 LIBRARY DESTINATION lib/asperity)
if(TARGET asperity_part_mpi)
  install(TARGETS asperity_part_mpi LIBRARY DESTINATION lib/asperity)
endif()
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
