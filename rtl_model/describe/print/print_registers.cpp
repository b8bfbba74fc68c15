// print_registers FORMAT: the register table for another tool, on stdout.
#include "rtl_model/describe/register_rows.h"

#include <cstdio>
#include <cstring>

int main(int argc, char** argv) {
  using hopmesh::describe::formats;
  for (const auto& format : formats)
    if (argc == 2 && std::strcmp(argv[1], format.name) == 0) {
      const std::string text = format.text();
      const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
      if (whole && std::fflush(stdout) == 0) return 0;
      std::perror("print_registers: stdout");
      return 2;
    }
  std::string names;
  for (const auto& format : formats) names += std::string(names.empty() ? "" : ", ") + format.name;
  std::fprintf(stderr, "print_registers: found %s, expected %s\n",
               argc == 2 ? ("\"" + std::string(argv[1]) + "\"").c_str() : "no format", names.c_str());
  return 2;
}
