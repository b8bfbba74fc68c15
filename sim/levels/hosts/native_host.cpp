#include "sim/levels/hosts/native_host.h"

#include "firmware/registers.h"
#include "sim/levels/array_port.h"

namespace hopmesh::levels {

NativeHost::NativeHost(const HostPlace& place) : place_(place), buffer_(longest_burst) {}

int NativeHost::open() {
  const int error = hm_driver_open(&driver_, &place_.bus.bus(), &place_.mesh, buffer_.data(),
                                   static_cast<std::uint32_t>(buffer_.size()));
  if (error != HM_OK) return error;
  const scene::RelaxSpec& relax = place_.relax;
  driver_.stop = relax.stop == scene::Stop::sum ? hm_stop{1, relax.share} : hm_stop{0, 0};
  const std::vector<double>& m = relax.momentum;
  if (driver_.output != HM_OUTPUT_MOMENTUM || m.empty()) return HM_OK;
  return hm_driver_put_momentum(&driver_, m.data(), static_cast<std::uint32_t>(m.size()));
}

int NativeHost::relax(void* context, const hm_mesh* mesh, hm_network* network, double threshold,
                      std::uint32_t max_sweeps, hm_relaxation* result) {
  auto* host = static_cast<NativeHost*>(context);
  if (host->place_.motion.reload_every > 1)
    host->loaded_.assign(network->weight, network->weight + hm_weight_count(mesh));
  const int error = hm_driver_relax(&host->driver_, mesh, network, threshold, max_sweeps, result);
  host->step_->last = *result;
  host->step_->sweeps.push_back(result->sweeps);
  return error;
}

int NativeHost::correct(void* context, const hm_mesh* mesh, hm_network* network, double threshold,
                        std::uint32_t max_sweeps, hm_relaxation* result) {
  auto* host = static_cast<NativeHost*>(context);
  const int error = hm_driver_correct(&host->driver_, mesh, network, threshold, max_sweeps, result);
  hm_add_relaxation(&host->step_->last, result);
  host->step_->sweeps.push_back(result->sweeps);
  return error;
}

double NativeHost::room(void* context) {
  return hm_driver_room(&static_cast<NativeHost*>(context)->driver_);
}

int NativeHost::step(HostStep& step) {
  step_ = &step;
  const hm_solver solver{this, relax, correct, room};
  driver_.clipped = driver_.vanished = 0;
  return hm_step(&place_.mesh, &place_.motion, &solver, &place_.memory.state, &step.result);
}

int NativeHost::restore(const std::vector<double>& weights, int shift) {
  loaded_ = weights;
  const hm_network network{loaded_.data(), place_.memory.bias.data(), place_.memory.now.output.data()};
  return hm_driver_restore(&driver_, &place_.mesh, &network, shift);
}

} // namespace hopmesh::levels
