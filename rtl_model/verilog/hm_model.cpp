// The Verilated hm_device behind a C face, for a program that loads it at run time. Made by Verilator with
// the prefix Vhm; the program that loads it knows which parameters it was made with.
#include "Vhm.h"
#include "Vhm___024root.h"
#include "verilated.h"

#include <cstdint>
#include <memory>

namespace {

struct Model {
  std::unique_ptr<VerilatedContext> context{new VerilatedContext};
  std::unique_ptr<Vhm> device{new Vhm(context.get())};
};

void cycle(Model& m) {
  m.device->clock = 1;
  m.device->eval();
  m.device->clock = 0;
  m.device->eval();
}

// A row of a table into a place of a memory, which Verilator keeps in the least type that holds it.
template <typename Number> void put(Number& place, const std::uint32_t* words) {
  place = static_cast<Number>(words[0]);
}
void put(QData& place, const std::uint32_t* words) {
  place = static_cast<QData>(words[1]) << 32 | words[0];
}
template <std::size_t count> void put(VlWide<count>& place, const std::uint32_t* words) {
  for (std::size_t k = 0; k < count; ++k) place[k] = words[k];
}
template <typename Word, std::size_t depth>
int fill(VlUnpacked<Word, depth>& memory, const std::uint32_t* words, std::uint64_t each,
         std::uint64_t rows) {
  if (rows > depth) return -1;
  for (std::uint64_t k = 0; k < rows; ++k) put(memory[k], words + each * k);
  return 0;
}

} // namespace

extern "C" {

void* hm_model_make() {
  Model* m = new Model;
  m->device->clock = 0;
  m->device->request = 0;
  m->device->eval();
  return m;
}

void hm_model_free(void* model) {
  delete static_cast<Model*>(model);
}

/// Table `which`, in the order of the parameters of hm_device: `rows` rows of `each` words.
int hm_model_table(void* model, int which, const std::uint32_t* words, std::uint64_t each,
                   std::uint64_t rows) {
  Vhm___024root& root = *static_cast<Model*>(model)->device->rootp;
  switch (which) {
  case 0:
    return fill(root.hm_device__DOT__array__DOT__lines_table__DOT__memory, words, each, rows);
  case 1:
    return fill(root.hm_device__DOT__array__DOT__rounds_table__DOT__memory, words, each, rows);
  case 2:
    return fill(root.hm_device__DOT__weight_map__DOT__memory, words, each, rows);
  case 3:
    return fill(root.hm_device__DOT__neuron_map__DOT__memory, words, each, rows);
  case 4:
    return fill(root.hm_device__DOT__first_links__DOT__memory, words, each, rows);
  case 5:
    return fill(root.hm_device__DOT__links__DOT__memory, words, each, rows);
  default:
    return -1;
  }
}

/// So many words as hm_device has FACTS.
void hm_model_facts(void* model, const std::uint32_t* words, std::uint64_t count) {
  Model& m = *static_cast<Model*>(model);
  for (std::uint64_t k = 0; k < count; ++k) m.device->facts[k] = words[k];
  cycle(m);
}

/// A transfer, clock by clock. Returns the answer of the bus: 0 done, else it was refused.
int hm_model_transfer(void* model, int write, std::uint32_t address, std::uint32_t* words,
                      std::uint32_t count) {
  Model& m = *static_cast<Model*>(model);
  Vhm& d = *m.device;
  d.request = 1;
  d.write = write != 0;
  d.address = address;
  d.bytes = 4 * count;
  d.write_data = write && count > 0 ? words[0] : 0;
  std::uint32_t sent = 0, taken = 0;
  for (bool first = true, last = false; !last; first = false) {
    d.eval();
    last = d.last;
    const int answer = d.answer;
    const bool beat = d.beat;
    // In the first cycle the last word of the transfer before still stands there.
    if (d.read_valid && !first && !write) words[taken++] = d.read_data;
    cycle(m);
    d.request = 0;
    if (beat && ++sent < count) d.write_data = words[sent];
    if (last && answer != 0) return answer;
  }
  if (!write) words[taken] = d.read_data; // behind the last beat
  return 0;
}

/// Lets at most so many clocks pass, until the interrupt line is up or nothing works any more. Returns how
/// many did.
std::uint64_t hm_model_wait(void* model, std::uint64_t most) {
  Model& m = *static_cast<Model*>(model);
  std::uint64_t passed = 0;
  for (; passed < most && !m.device->irq && m.device->busy; ++passed) cycle(m);
  return passed;
}

int hm_model_busy(void* model) {
  return static_cast<Model*>(model)->device->busy;
}

int hm_model_irq(void* model) {
  return static_cast<Model*>(model)->device->irq;
}

} // extern "C"
