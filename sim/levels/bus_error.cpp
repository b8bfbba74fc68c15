#include "sim/levels/bus_error.h"

#include "firmware/bus.h"

namespace hopmesh::levels {

std::string error_text(int error) {
  switch (error) {
  case HM_ERROR_BUS:
    return "the bus refused a transfer";
  case HM_ERROR_ID:
    return "there is no Hopmesh array of this version behind the bus";
  case HM_ERROR_MESH:
    return "the array was built for another mesh";
  case HM_ERROR_NUMBER:
    return "a weight, a bias or a start value is not finite";
  case HM_ERROR_BUSY:
    return "the array was running when it should not";
  case HM_ERROR_SPACE:
    return "the driver's buffer is too small";
  default:
    return "error " + std::to_string(error);
  }
}

void check(int error) {
  if (error == HM_ERROR_STOPPED) throw Stopped();
  if (error != HM_OK) throw std::runtime_error(error_text(error));
}

} // namespace hopmesh::levels
