// What a call of the bus or of the firmware came to, in words and as exceptions.
#pragma once

#include "firmware/driver.h"

#include <stdexcept>
#include <string>

namespace hopmesh::levels {

/// The user asked to stop while an array was still relaxing; the step did not happen.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped") {}
};

/// An error of firmware/bus.h as a sentence.
std::string error_text(int error);

/// Throws Stopped where the user stopped a wait, and std::runtime_error for any other error.
void check(int error);
/// As check(), of hm_driver_open, which knows what it found.
void check_opened(int error, const hm_driver& driver);

} // namespace hopmesh::levels
