// A job's network, its table and its rule to stop by written into a device.
#pragma once

#include "sim/cosim/array_job.h"
#include "tests/support/dut.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {

inline void load(Dut& dut, const cosim::ArrayJob& job) {
  ASSERT_EQ(dut.put_codes(Window::WEIGHT, job.weight), tlm::TLM_OK_RESPONSE);
  ASSERT_EQ(dut.put_codes(Window::BIAS, job.bias), tlm::TLM_OK_RESPONSE);
  ASSERT_EQ(dut.put_codes(Window::OUTPUT, job.start), tlm::TLM_OK_RESPONSE);
  if (!job.momentum.empty()) {
    ASSERT_EQ(dut.put_codes(Window::MOMENTUM, job.momentum), tlm::TLM_OK_RESPONSE);
  }
  if (job.rule == spec::StopRule()) return; // as RESET leaves it
  dut.write(HM_REG_STOP, static_cast<std::uint32_t>(job.rule.by_sum) << HM_SHIFT_STOP_BY_SUM |
                             static_cast<std::uint32_t>(job.rule.share) << HM_SHIFT_STOP_SHARE);
  dut.write(HM_REG_SUM_THRESHOLD_LO, static_cast<std::uint32_t>(job.rule.floor));
  dut.write(HM_REG_SUM_THRESHOLD_HI, static_cast<std::uint32_t>(job.rule.floor >> 32));
}

} // namespace hopmesh::tests
