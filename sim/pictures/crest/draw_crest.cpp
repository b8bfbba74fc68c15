// Part of the build: draws the crest and writes it as the C++ source of flag_crest().
#include "sim/pictures/crest/crest.h"

#include <cstdio>

int main(int argc, char** argv) {
  std::FILE* file = argc == 2 ? std::fopen(argv[1], "w") : nullptr;
  if (file == nullptr) return std::fputs("usage: draw_crest OUTPUT.cpp\n", stderr), 2;
  const std::string png = hopmesh::pictures::crest_png(512);
  std::fputs("// Made by sim/pictures/draw_crest.cpp.\n#include \"sim/pictures/flag_crest.h\"\n\n"
             "namespace hopmesh::pictures {\n\nnamespace {\n\nconstexpr unsigned char png[] = {",
             file);
  for (std::size_t k = 0; k < png.size(); ++k)
    std::fprintf(file, "%s%d,", k % 32 == 0 ? "\n" : "", static_cast<unsigned char>(png[k]));
  std::fputs(
      "};\n\n} // namespace\n\nstd::string_view flag_crest() {\n"
      "  return {reinterpret_cast<const char*>(png), sizeof png};\n}\n\n} // namespace hopmesh::pictures\n",
      file);
  return std::fclose(file) == 0 ? 0 : 2;
}
