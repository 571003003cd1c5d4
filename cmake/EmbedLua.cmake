# Turns the Lua files that ship with the tool into one C++ source, so that the program needs no
# files beside it: cmake -DOUTPUT=x.cpp -DFOLDER=scripts -P EmbedLua.cmake
# The files of FOLDER are the modules, those of FOLDER/lessons the lessons.

# A raw string literal holds 64 KiB at most; these files are far smaller.
function(entries result pattern)
  file(GLOB sources ${pattern})
  list(SORT sources)
  set(text "")
  foreach(source ${sources})
    file(READ ${source} content)
    get_filename_component(name ${source} NAME_WE)
    string(APPEND text "    {\"${name}\", R\"lua~(${content})lua~\"},\n")
  endforeach()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

entries(modules ${FOLDER}/*.lua)
entries(lessons ${FOLDER}/lessons/*.lua)
file(WRITE ${OUTPUT} "// Generated from scripts/*.lua and scripts/lessons/*.lua at build time.
#include \"bindings/lua/registry/embedded.hpp\"

namespace asperity::lua {

std::span<const EmbeddedScript> embedded_scripts() {
  static const EmbeddedScript scripts[] = {
${modules}  };
  return scripts;
}

std::span<const EmbeddedScript> embedded_lessons() {
  static const EmbeddedScript scripts[] = {
${lessons}  };
  return scripts;
}

}  // namespace asperity::lua
")
