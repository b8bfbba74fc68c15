#include "sim/run/design/bus_script.h"

#include <fmt/format.h>
#include <iterator>

namespace hopmesh::run {

void BusScript::add(Line line, std::uint32_t first, std::uint32_t second) {
  fmt::format_to(std::back_inserter(text_), "{:x}{:08x}{:08x}\n", static_cast<int>(line), first, second);
  lines_ += 1;
}

// Transfers that are refused are no part of a motion.
int BusScript::read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
  const int error = behind_.read(address, words, count);
  if (error != HM_OK) return error;
  add(Line::reads, address, count);
  for (std::uint32_t k = 0; k < count; ++k) add(Line::end, 0, words[k]);
  return error;
}

int BusScript::write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  const int error = behind_.write(address, words, count);
  if (error != HM_OK) return error;
  if (count == 1) {
    add(Line::write, address, words[0]);
    return error;
  }
  add(Line::writes, address, count);
  for (std::uint32_t k = 0; k < count; ++k) add(Line::end, 0, words[k]);
  return error;
}

int BusScript::wait_for_irq() {
  const int error = behind_.wait_for_irq();
  if (error == HM_OK) add(Line::wait, 0, 0);
  return error;
}

std::string BusScript::hex() const {
  return text_ + fmt::format("{:x}{:08x}{:08x}\n", static_cast<int>(Line::end), 0, 0);
}

} // namespace hopmesh::run
