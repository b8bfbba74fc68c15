// The firmware's steps in whole numbers, compiled for this very processor.
#pragma once

#include "sim/levels/hosts/fixed_motion.h"
#include "sim/levels/hosts/native_host.h"

namespace hopmesh::levels {

class NativeFixedHost : public NativeHost {
 public:
  explicit NativeFixedHost(const HostPlace& place) : NativeHost(place), motion_(place) {}

  int open() override;
  int step(HostStep& step) override;

 private:
  FixedMotion motion_;
};

} // namespace hopmesh::levels
