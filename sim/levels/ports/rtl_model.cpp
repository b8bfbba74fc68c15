#include "sim/levels/ports/rtl_model.h"

#include <dlfcn.h>
#include <stdexcept>
#include <string>

namespace hopmesh::levels {

namespace {

template <typename Function> void find(void* library, const char* name, Function*& function) {
  void* const found = dlsym(library, name);
  if (found == nullptr) throw std::runtime_error(std::string("rtl: ") + dlerror());
  function = reinterpret_cast<Function*>(found);
}

} // namespace

RtlLibrary::RtlLibrary(const std::filesystem::path& file) {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(std::string("rtl: ") + dlerror());
  find(library, "hm_model_make", make);
  find(library, "hm_model_free", free);
  find(library, "hm_model_table", table);
  find(library, "hm_model_facts", facts);
  find(library, "hm_model_transfer", transfer);
  find(library, "hm_model_wait", wait);
  find(library, "hm_model_irq", irq);
  find(library, "hm_model_busy", busy);
}

} // namespace hopmesh::levels
