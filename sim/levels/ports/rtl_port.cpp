#include "sim/levels/ports/rtl_port.h"

#include "firmware/registers.h"
#include "sim/machine/rtl/rtl_tables.h"

#include <stdexcept>

namespace hopmesh::levels {

RtlPort::RtlPort(const RtlLibrary& library, const spec::ArraySpec& array, const spec::Topology& topology,
                 const machine::RtlRoom& room, const std::atomic<bool>& stop)
    : library_(library), model_(library.make()), stop_(stop) {
  int which = 0;
  for (const machine::BitTable& table : machine::rtl_tables(array, topology, room))
    if (library_.table(model_, which++, table.row(0), table.words, table.rows) != 0)
      throw std::runtime_error("rtl: the model has no room for the table " + table.name);
  const std::vector<std::uint32_t> facts = machine::rtl_facts(array, topology);
  library_.facts(model_, facts.data(), facts.size());
}

RtlPort::~RtlPort() {
  library_.free(model_);
}

int RtlPort::read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
  return library_.transfer(model_, 0, address, words, count) == 0 ? HM_OK : HM_ERROR_BUS;
}

int RtlPort::write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  // The model only reads the words of a write.
  return library_.transfer(model_, 1, address, const_cast<std::uint32_t*>(words), count) == 0 ? HM_OK
                                                                                              : HM_ERROR_BUS;
}

// In slices, so that a long relaxation can be stopped. An array that does not work will never raise the line.
int RtlPort::wait_for_irq() {
  constexpr std::uint64_t slice = 100'000;
  while (library_.irq(model_) == 0) {
    if (stop_ || library_.busy(model_) == 0) return HM_ERROR_STOPPED;
    library_.wait(model_, slice);
  }
  return HM_OK;
}

} // namespace hopmesh::levels
