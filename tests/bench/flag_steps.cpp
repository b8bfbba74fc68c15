#include "tests/bench/flag_steps.h"

#include "sim/levels/array_mover.h"

#include <ctime>

namespace hopmesh::bench {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

FlagSteps::FlagSteps(const scene::Scene& scene, const levels::BuiltMesh& mesh, tests::Dut& dut)
    : mesh_(mesh), dut_(dut), parameters_(levels::step_parameters(scene)), buffer_(4096) {}

void FlagSteps::begin() {
  memory_.emplace(mesh_);
  sweeps_ = cycles_ = 0;
  if (hm_driver_open(&driver_, &bus(), &mesh_.firmware(), buffer_.data(),
                     static_cast<std::uint32_t>(buffer_.size())) != HM_OK)
    throw std::runtime_error("the driver refuses the device");
  seconds_ = {};
}

void FlagSteps::advance() {
  const hm_solver solver{this, &FlagSteps::relax, nullptr, nullptr};
  const PartSeconds before = seconds_;
  const double began = processor_seconds();
  hm_step_result result;
  if (hm_step(&mesh_.firmware(), &parameters_, &solver, &memory_->state, &result) != HM_OK)
    throw std::runtime_error("the firmware could not do a step");
  const double relaxed =
      seconds_.array - before.array + seconds_.bus - before.bus + seconds_.driver - before.driver;
  seconds_.network_and_motion += processor_seconds() - began - relaxed;
  sweeps_ += result.relaxation.sweeps;
  cycles_ += result.relaxation.cycles;
}

int FlagSteps::relax(void* self, const hm_mesh* mesh, hm_network* network, double threshold,
                     std::uint32_t max_sweeps, hm_relaxation* result) {
  auto& steps = *static_cast<FlagSteps*>(self);
  const PartSeconds before = steps.seconds_;
  const double began = processor_seconds();
  const int error = hm_driver_relax(&steps.driver_, mesh, network, threshold, max_sweeps, result);
  const double elsewhere = steps.seconds_.array - before.array + steps.seconds_.bus - before.bus;
  steps.seconds_.driver += processor_seconds() - began - elsewhere;
  return error;
}

int FlagSteps::transfer(tlm::tlm_command command, std::uint32_t address, std::uint32_t* words,
                        std::uint32_t count) {
  const double began = processor_seconds();
  const auto response = dut_.transfer(command, address, words, 4 * count);
  seconds_.bus += processor_seconds() - began;
  return response == tlm::TLM_OK_RESPONSE ? HM_OK : HM_ERROR_BUS;
}

int FlagSteps::wait_for_irq() {
  const double began = processor_seconds();
  dut_.run_until_done();
  seconds_.array += processor_seconds() - began;
  return HM_OK;
}

// Exact: V is a multiple of the state's last place.
std::vector<std::int32_t> FlagSteps::start_raw() const {
  int clipped = 0;
  std::vector<std::int32_t> codes;
  for (double v : memory_->start) codes.push_back(hm_quantise(v, 0, &driver_.state, &clipped));
  return codes;
}

} // namespace hopmesh::bench
