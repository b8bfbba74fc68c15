// A problem as Matrix Market files.
#include "sim/files/output_file.h"
#include "sim/networks/problems/problem.h"

namespace hopmesh::problems {

void write_problem(const std::filesystem::path& folder, const Problem& p) {
  files::check_writable(folder, p.W.entries.size() * 40 + p.bias.size() * 50);
  files::write_matrix(folder / "W.mtx", p.W.rows, p.W.columns, p.W.entries);
  files::write_vector(folder / "bias.mtx", p.bias);
  files::write_vector(folder / "V0.mtx", p.start);
}

} // namespace hopmesh::problems
