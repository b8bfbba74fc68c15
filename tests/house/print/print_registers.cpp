// print_registers PAGE: prints the tables of firmware/registers.h afresh into the page.
#include "tests/house/register_tables.h"

#include <fstream>
#include <iostream>
#include <sstream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: print_registers docs/hardware/registers.md\n";
    return 2;
  }
  std::ostringstream page;
  page << std::ifstream(argv[1]).rdbuf();
  const std::string printed = hopmesh::tests::with_tables(page.str());
  std::ofstream out(argv[1]);
  out << printed;
  return out.flush() ? 0 : 1;
}
