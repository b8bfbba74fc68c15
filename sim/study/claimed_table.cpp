#include "sim/study/claimed_table.h"

#include "sim/levels/interrupt.h"

#include <chrono>
#include <thread>

namespace hopmesh::study {

std::optional<files::CsvWriter> claim_table(const std::filesystem::path& table,
                                            const std::vector<std::string>& columns) {
  constexpr auto glance = std::chrono::milliseconds(20);
  while (!std::filesystem::exists(table) && !levels::stop_requested) {
    try {
      std::optional<files::CsvWriter> writer(std::in_place, table, columns, files::CheckedRows());
      if (!std::filesystem::exists(table)) return writer;
    } catch (const files::BusyError&) {
      std::this_thread::sleep_for(glance);
    }
  }
  return std::nullopt;
}

files::DamagedFile damaged_cell(const std::filesystem::path& table, std::size_t row, const std::string& key,
                                const std::string& found, const std::string& expected) {
  const int line = static_cast<int>(row) + 2;
  return files::set_aside(table, input::input_error(table.string(), line, key, found, expected).what());
}

} // namespace hopmesh::study
