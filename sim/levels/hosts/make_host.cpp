#include "sim/levels/hosts/fixed_motion.h"
#include "sim/levels/hosts/native_fixed_host.h"
#include "sim/levels/hosts/native_host.h"
#include "sim/levels/hosts/rv32.h"
#include "sim/scene/scene_reader.h"

#include <new>

namespace hopmesh::levels {

namespace {

std::unique_ptr<StepHost> make_rv32(const scene::Scene& scene, const HostPlace& place) {
  const auto refuse = [&](const char* key, const char* found, const char* expected) {
    return scene::scene_error(scene, key, found, expected);
  };
  if (!has_rv32_host())
    throw refuse("host.processor", "\"rv32\", which this program was built without",
                 "\"native\", or a build with riscv64-unknown-elf-gcc, picolibc and libunicorn");
  if (place.relax.reload == scene::Reload::bias)
    throw refuse("relax.reload", "\"bias\" beside host.processor = \"rv32\"",
                 "\"all\", or host.processor = \"native\"");
  try {
    return make_rv32_host(scene.host, place);
  } catch (const std::bad_alloc&) {
    throw refuse("host.processor", "\"rv32\", for a mesh that does not fit into the core's 256 MiB",
                 "\"native\", or a smaller mesh");
  }
}

void expect_fixed(const scene::Scene& scene, const spec::ArraySpec& array, const HostPlace& place) {
  const Refusal why = why_not_fixed(scene, array, place);
  if (why.key)
    throw scene::scene_error(scene, why.key, std::string(why.found) + " beside host.arithmetic = \"fixed\"",
                             std::string(why.expected) + ", or host.arithmetic = \"double\"");
}

} // namespace

std::unique_ptr<StepHost> make_host(const scene::Scene& scene, const spec::ArraySpec& array,
                                    const HostPlace& place) {
  const bool fixed = scene.host.arithmetic == scene::Arithmetic::fixed;
  if (fixed) expect_fixed(scene, array, place);
  if (scene.host.processor == scene::Processor::native && fixed)
    return std::make_unique<NativeFixedHost>(place);
  if (scene.host.processor == scene::Processor::native) return std::make_unique<NativeHost>(place);
  return make_rv32(scene, place);
}

} // namespace hopmesh::levels
