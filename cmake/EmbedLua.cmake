# Turns the Lua files that ship with the tool into one C++ source, so that the program needs no
# files beside it: cmake -DOUTPUT=x.cpp -DFOLDER=scripts -P EmbedLua.cmake
file(GLOB SOURCES ${FOLDER}/*.lua)
list(SORT SOURCES)
set(entries "")
foreach(source ${SOURCES})
  file(READ ${source} text)
  get_filename_component(name ${source} NAME_WE)
  # A raw string literal holds 64 KiB at most; these files are far smaller.
  string(APPEND entries "    {\"${name}\", R\"lua~(${text})lua~\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Generated from scripts/*.lua at build time.
#include \"bindings/lua/embedded.hpp\"

namespace asperity::lua {

std::span<const EmbeddedScript> embedded_scripts() {
  static const EmbeddedScript scripts[] = {
${entries}  };
  return scripts;
}

}  // namespace asperity::lua
")
