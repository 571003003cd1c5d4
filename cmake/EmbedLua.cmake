# Turns the Lua files that ship with the tool into one C++ source, so that the program needs no
# files beside it: cmake -DOUTPUT=x.cpp -DFOLDER=scripts -P EmbedLua.cmake
# The files of FOLDER are the modules, those of FOLDER/lessons the lessons; FOLDER/lessons/de has German texts.

# A raw string literal holds 64 KiB at most; these files are far smaller.
function(entries result base pattern)
  file(GLOB sources ${base}/${pattern})
  list(SORT sources)
  set(text "")
  foreach(source ${sources})
    file(READ ${source} content)
    file(RELATIVE_PATH name ${base} ${source})
    string(REGEX REPLACE "\\.[a-z]+$" "" name ${name})
    string(APPEND text "    {\"${name}\", R\"lua~(${content})lua~\"},\n")
  endforeach()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

entries(scripts ${FOLDER} *.lua)
entries(lessons ${FOLDER}/lessons *.lua)
entries(lesson_texts ${FOLDER}/lessons */*.txt)
set(functions "")
foreach(kind scripts lessons lesson_texts)
  string(APPEND functions "
std::span<const EmbeddedScript> embedded_${kind}() {
  static const EmbeddedScript files[] = {
${${kind}}  };
  return files;
}
")
endforeach()
file(WRITE ${OUTPUT} "// Generated from the files of scripts at build time.
#include \"bindings/lua/registry/embedded.hpp\"

namespace asperity::lua {
${functions}
}  // namespace asperity::lua
")
