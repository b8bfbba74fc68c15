#include "sim/levels/hosts/native_fixed_host.h"

namespace hopmesh::levels {

namespace {

void hear(void* listener, const hm_relaxation* one) {
  auto* step = static_cast<HostStep*>(listener);
  step->last = *one;
  step->sweeps.push_back(one->sweeps);
}

} // namespace

int NativeFixedHost::open() {
  const int error = NativeHost::open();
  if (error == HM_OK) motion_.set_threshold(driver());
  return error;
}

int NativeFixedHost::step(HostStep& step) {
  motion_.take();
  const hm_fixed_mesh mesh = motion_.mesh();
  const hm_fixed_work work{&motion_.plan(), &mesh, &motion_.state(), &opened_driver(), &step, hear};
  const int error = hm_fixed_step(&work, &step.result.relaxation, &step.result.lost_node);
  if (error == HM_OK) motion_.give();
  return error;
}

} // namespace hopmesh::levels
