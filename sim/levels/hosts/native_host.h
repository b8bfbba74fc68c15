// The firmware, compiled for this very processor.
#pragma once

#include "sim/levels/hosts/step_host.h"

namespace hopmesh::levels {

class NativeHost : public StepHost {
 public:
  explicit NativeHost(const HostPlace& place);

  int open() override;
  int step(HostStep& step) override;
  const hm_driver& driver() const override { return driver_; }
  std::vector<double> loaded_weights() const override { return loaded_; }
  int restore(const std::vector<double>& weights, int shift) override;

 protected:
  hm_driver& opened_driver() { return driver_; }

 private:
  static int relax(void* context, const hm_mesh* mesh, hm_network* network, double threshold,
                   std::uint32_t max_sweeps, hm_relaxation* result);
  static int correct(void* context, const hm_mesh* mesh, hm_network* network, double threshold,
                     std::uint32_t max_sweeps, hm_relaxation* result);
  static double room(void* context);

  const HostPlace place_;
  hm_driver driver_{};
  std::vector<std::uint32_t> buffer_;
  std::vector<double> loaded_;
  HostStep* step_ = nullptr; ///< while one is done
};

} // namespace hopmesh::levels
