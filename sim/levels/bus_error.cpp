#include "sim/levels/bus_error.h"

#include "firmware/registers.h"

#include <fmt/format.h>

namespace hopmesh::levels {

std::string error_text(int error) {
  switch (error) {
  case HM_ERROR_BUS:
    return "the bus refused a transfer";
  case HM_ERROR_ID:
    return "there is no Hopmesh array behind the bus";
  case HM_ERROR_MESH:
    return "the array was built for another mesh";
  case HM_ERROR_NUMBER:
    return "a weight, a bias or a start value is not finite";
  case HM_ERROR_BUSY:
    return "the array was running when it should not";
  case HM_ERROR_SPACE:
    return "the driver's buffer is too small";
  case HM_ERROR_VERSION:
    return "the array's registers are of another version";
  default:
    return "error " + std::to_string(error);
  }
}

void check(int error) {
  if (error == HM_ERROR_STOPPED) throw Stopped();
  if (error != HM_OK) throw std::runtime_error(error_text(error));
}

void check_opened(int error, const hm_driver& driver) {
  if (error != HM_ERROR_VERSION) return check(error);
  const auto text = [](std::uint32_t version) {
    return fmt::format("{}.{}", HM_FIELD(version, VERSION_MAJOR), HM_FIELD(version, VERSION_MINOR));
  };
  throw std::runtime_error(
      fmt::format("the array's registers are of version {}; this program knows version {}",
                  text(driver.version), text(HM_VERSION_VALUE)));
}

} // namespace hopmesh::levels
