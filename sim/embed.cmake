# Turns files into C++ strings: cmake -DROOM=pictures -DNAME=files -DFILES="a;b" -DOUTPUT=x.cpp -P embed.cmake
# makes hopmesh::pictures::files(), names and bytes in the order given.
set(type "std::vector<std::pair<std::string, std::string>>")
set(text "// Made by sim/embed.cmake.\n#include <string>\n#include <utility>\n#include <vector>\n\n")
string(APPEND text "namespace hopmesh::${ROOM} {\n\nconst ${type}& ${NAME}();\n")
string(APPEND text "const ${type}& ${NAME}() {\n  static const ${type} all{\n")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  # CMake would make lists of a text's square brackets and semicolons: hexadecimal digits have none.
  file(READ ${file} content HEX)
  file(SIZE ${file} bytes)
  string(REGEX REPLACE "(..)" "\\\\x\\1" content "${content}")
  string(APPEND text "      {\"${name}\", {\"${content}\", ${bytes}}},\n")
endforeach()
string(APPEND text "  };\n  return all;\n}\n\n} // namespace hopmesh::${ROOM}\n")
file(WRITE ${OUTPUT} "${text}")
