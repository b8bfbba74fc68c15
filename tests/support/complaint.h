// What code says of a mistake.
#pragma once

#include "sim/input/input_error.h"

#include <string>

namespace hopmesh::tests {

/// What the action's error says; "" if it throws none.
template <typename Error = input::InputError, typename Action> std::string complaint(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

} // namespace hopmesh::tests
