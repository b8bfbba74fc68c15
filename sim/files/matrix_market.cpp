#include "sim/files/matrix_market.h"

#include "sim/files/output_file.h"

#include <fmt/format.h>

namespace hopmesh::files {

void write_matrix(const std::filesystem::path& path, std::size_t rows, std::size_t columns,
                  const std::vector<MatrixEntry>& entries) {
  OutputFile file(path);
  file.write(fmt::format("%%MatrixMarket matrix coordinate real general\n{} {} {}\n", rows, columns,
                         entries.size()));
  for (const MatrixEntry& e : entries)
    file.write(fmt::format("{} {} {:.17g}\n", e.row + 1, e.column + 1, e.value));
  file.commit();
}

void write_vector(const std::filesystem::path& path, const std::vector<double>& values) {
  OutputFile file(path);
  file.write(fmt::format("%%MatrixMarket matrix array real general\n{} 1\n", values.size()));
  for (double value : values) file.write(fmt::format("{:.17g}\n", value));
  file.commit();
}

} // namespace hopmesh::files
