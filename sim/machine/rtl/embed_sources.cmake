# Turns files into C++ strings: cmake -DSOURCES="a;b" -DOUTPUT=x.cpp -P embed_sources.cmake
set(text "// Made by sim/machine/rtl/embed_sources.cmake.\n#include \"sim/machine/rtl/rtl_sources.h\"\n\n")
string(APPEND text "namespace hopmesh::machine {\n\nconst std::vector<std::pair<std::string, std::string>>& rtl_sources() {\n")
string(APPEND text "  static const std::vector<std::pair<std::string, std::string>> all{\n")
foreach(source ${SOURCES})
  get_filename_component(name ${source} NAME)
  # Of square brackets and semicolons CMake makes lists where a text is handed on: none of that here.
  file(READ ${source} content HEX)
  string(REGEX REPLACE "(..)" "\\\\x\\1" content "${content}")
  string(APPEND text "      {\"${name}\", \"${content}\"},\n")
endforeach()
string(APPEND text "  };\n  return all;\n}\n\n} // namespace hopmesh::machine\n")
file(WRITE ${OUTPUT} "${text}")
