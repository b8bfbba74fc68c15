#include "sim/files/kept_file.h"

#include "sim/input/whole_file.h"

#include <fmt/format.h>

namespace hopmesh::files {

DamagedFile set_aside(const std::filesystem::path& file, const std::string& found) {
  const std::string why = input::as_a_line(found); // it may quote the damage
  std::error_code error;
  const std::string aside = file.string() + ".damaged";
  std::filesystem::rename(file, aside, error);
  if (error) return DamagedFile(fmt::format("{}; it cannot be set aside: {}", why, error.message()));
  return DamagedFile(fmt::format("{}; set aside as {}, and the same command makes it again", why,
                                 std::filesystem::path(aside).filename().string()));
}

CsvTable read_kept(const std::filesystem::path& file, const std::vector<std::string>& columns) {
  constexpr std::size_t most_bytes = 1u << 24;
  try {
    return parse_checked_csv(input::read_whole_file(file.string(), "a result of this work", most_bytes),
                             file.string(), columns);
  } catch (const input::InputError& why) {
    throw set_aside(file, why.what());
  }
}

} // namespace hopmesh::files
