// print_tables PAGE: prints the tables of a page afresh into it.
#include "tests/house/page_tables.h"

#include <fstream>
#include <iostream>
#include <sstream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: print_tables PAGE\n";
    return 2;
  }
  std::ostringstream page;
  page << std::ifstream(argv[1]).rdbuf();
  const std::string printed = hopmesh::tests::with_tables(page.str());
  std::ofstream out(argv[1]);
  out << printed;
  return out.flush() ? 0 : 1;
}
