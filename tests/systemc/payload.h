// A TLM payload with every attribute in the caller's hands, to misuse a bus on purpose.
#pragma once

#include <cstdint>
#include <tlm>

namespace hopmesh::tests {

struct Attempt {
  tlm::tlm_command command = tlm::TLM_READ_COMMAND;
  std::uint64_t address = 0;
  unsigned length = 4, streaming_width = 4;
  unsigned char* data = nullptr;
  bool byte_enables = false;
};

/// Fills `payload` as an initiator should: the response begins as INCOMPLETE, DMI as not allowed.
inline void fill(tlm::tlm_generic_payload& payload, const Attempt& a) {
  static unsigned char enables[4] = {0xFF, 0xFF, 0xFF, 0xFF};
  payload.set_command(a.command);
  payload.set_address(a.address);
  payload.set_data_ptr(a.data);
  payload.set_data_length(a.length);
  payload.set_streaming_width(a.streaming_width);
  payload.set_byte_enable_ptr(a.byte_enables ? enables : nullptr);
  payload.set_byte_enable_length(a.byte_enables ? 4 : 0);
  payload.set_dmi_allowed(false);
  payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
}

} // namespace hopmesh::tests
