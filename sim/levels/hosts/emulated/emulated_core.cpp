#include "sim/levels/hosts/emulated/emulated_core.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <sys/mman.h>
#include <unicorn/unicorn.h>

namespace hopmesh::levels {

namespace {

constexpr std::size_t ram_bytes = HM_CORE_BRIDGE - HM_CORE_RAM; // pages that nobody touches cost nothing
constexpr std::size_t stack_bytes = 64 * 1024, alignment = 16;

std::uint8_t* map_memory() {
  void* const memory =
      mmap(nullptr, ram_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return static_cast<std::uint8_t*>(memory);
}

void note_block(uc_engine*, std::uint64_t address, std::uint32_t bytes, void* counts) {
  static_cast<InstructionCounts*>(counts)->add(static_cast<std::uint32_t>(address), bytes);
}

} // namespace

void EmulatedCore::Unmap::operator()(std::uint8_t* memory) const {
  munmap(memory, ram_bytes);
}

void EmulatedCore::expect(int error, const char* what) const {
  if (error != UC_ERR_OK)
    throw std::runtime_error(std::string("the emulated core ") + what + ": " +
                             uc_strerror(static_cast<uc_err>(error)));
}

EmulatedCore::EmulatedCore(const CoreProgram& program, HostBus& bus)
    : program_(program), bus_(bus), ram_(map_memory()), counts_(program),
      end_(program.address_of("hm_core_end")) {
  for (const ProgramPart& part : program.parts())
    std::memcpy(at<std::uint8_t>(part.address), part.bytes.data(), part.bytes.size());
  expect(uc_open(UC_ARCH_RISCV, UC_MODE_RISCV32, &uc_), "does not start");
  expect(uc_mem_map_ptr(uc_, HM_CORE_RAM, ram_bytes, UC_PROT_ALL, ram_.get()), "has no memory");
  add_bus();
  uc_hook blocks = 0;
  expect(uc_hook_add(uc_, &blocks, UC_HOOK_BLOCK, reinterpret_cast<void*>(note_block), &counts_,
                     std::uint64_t{1}, std::uint64_t{0}),
         "cannot be watched");
  stack_ = reserve(stack_bytes) + static_cast<std::uint32_t>(stack_bytes);
}

EmulatedCore::~EmulatedCore() {
  if (uc_) uc_close(uc_);
}

std::uint32_t EmulatedCore::reserve(std::size_t bytes) {
  const std::size_t wanted = (bytes + alignment - 1) / alignment * alignment;
  if (wanted > ram_bytes - memory_bytes()) throw std::bad_alloc();
  const std::uint32_t address = end_;
  end_ += static_cast<std::uint32_t>(wanted);
  return address;
}

// Accesses come out of the emulator's own C code, which no exception may cross.
void EmulatedCore::add_bus() {
  const auto self = [](void* core) { return static_cast<EmulatedCore*>(core); };
  static const auto core = self;
  expect(uc_mmio_map(
             uc_, HM_CORE_ARRAY, HM_CORE_ARRAY_MOST,
             [](uc_engine*, std::uint64_t offset, unsigned, void* me) {
               return core(me)->read_array(static_cast<std::uint32_t>(offset));
             },
             this,
             [](uc_engine*, std::uint64_t offset, unsigned, std::uint64_t word, void* me) {
               core(me)->write_array(static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(word));
             },
             this),
         "sees no array");
  expect(uc_mmio_map(
             uc_, HM_CORE_BRIDGE, HM_BRIDGE_BYTES,
             [](uc_engine*, std::uint64_t offset, unsigned, void* me) {
               return core(me)->read_bridge(static_cast<std::uint32_t>(offset));
             },
             this,
             [](uc_engine*, std::uint64_t offset, unsigned, std::uint64_t word, void* me) {
               core(me)->write_bridge(static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(word));
             },
             this),
         "sees no bridge");
}

template <typename Use> int EmulatedCore::guarded(Use use) {
  try {
    return use();
  } catch (...) {
    if (!thrown_) thrown_ = std::current_exception();
    uc_emu_stop(uc_);
    return HM_ERROR_BUS;
  }
}

std::uint64_t EmulatedCore::read_array(std::uint32_t address) {
  std::uint32_t word = 0;
  const int error = guarded([&] { return bus_.read(address, &word, 1); });
  if (error_ == HM_OK) error_ = error;
  return word;
}

void EmulatedCore::write_array(std::uint32_t address, std::uint32_t word) {
  const int error = guarded([&] { return bus_.write(address, &word, 1); });
  if (error_ == HM_OK) error_ = error;
}

std::uint64_t EmulatedCore::read_bridge(std::uint32_t offset) {
  if (offset == HM_BRIDGE_WAIT)
    return static_cast<std::uint32_t>(guarded([&] { return bus_.wait_for_irq(); }));
  const int error = offset == HM_BRIDGE_ERROR ? error_ : HM_OK;
  if (offset == HM_BRIDGE_ERROR) error_ = HM_OK;
  return static_cast<std::uint32_t>(error);
}

bool EmulatedCore::in_memory(std::uint32_t address, std::uint32_t words) const {
  return address >= HM_CORE_RAM && address % 4 == 0 && address <= end_ && words <= (end_ - address) / 4;
}

void EmulatedCore::write_bridge(std::uint32_t offset, std::uint32_t word) {
  if (offset == HM_BRIDGE_ADDRESS) transfer_address_ = word;
  if (offset == HM_BRIDGE_MEMORY) transfer_memory_ = word;
  if (offset != HM_BRIDGE_TO_ARRAY && offset != HM_BRIDGE_TO_MEMORY) return;
  const int error = guarded([&] {
    if (!in_memory(transfer_memory_, word)) return static_cast<int>(HM_ERROR_BUS);
    auto* const words = at<std::uint32_t>(transfer_memory_);
    return offset == HM_BRIDGE_TO_ARRAY ? bus_.write(transfer_address_, words, word)
                                        : bus_.read(transfer_address_, words, word);
  });
  if (error_ == HM_OK) error_ = error;
}

int EmulatedCore::call(const std::string& function, std::uint32_t argument) {
  const std::uint32_t begin = program_.address_of(function), idle = program_.address_of("hm_core_idle");
  std::uint32_t sp = stack_, answer = 0, at_last = 0;
  uc_reg_write(uc_, UC_RISCV_REG_A0, &argument);
  uc_reg_write(uc_, UC_RISCV_REG_SP, &sp);
  uc_reg_write(uc_, UC_RISCV_REG_RA, &idle);
  const uc_err error = uc_emu_start(uc_, begin, idle, 0, 0);
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  expect(error, "stopped");
  uc_reg_read(uc_, UC_RISCV_REG_A0, &answer);
  uc_reg_read(uc_, UC_RISCV_REG_PC, &at_last);
  if (at_last != idle) throw std::runtime_error("the emulated core stopped in " + function);
  return static_cast<int>(answer);
}

} // namespace hopmesh::levels
