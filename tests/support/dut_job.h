// A job's network written into a device.
#pragma once

#include "sim/cosim/array_job.h"
#include "tests/support/dut.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {

inline void load(Dut& dut, const cosim::ArrayJob& job) {
  ASSERT_EQ(dut.put_codes(Window::WEIGHT, job.weight), tlm::TLM_OK_RESPONSE);
  ASSERT_EQ(dut.put_codes(Window::BIAS, job.bias), tlm::TLM_OK_RESPONSE);
  ASSERT_EQ(dut.put_codes(Window::OUTPUT, job.start), tlm::TLM_OK_RESPONSE);
}

} // namespace hopmesh::tests
