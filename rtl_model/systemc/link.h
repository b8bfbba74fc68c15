// What runs between cells: the registered outputs of one cell, read by its neighbours and by itself.
#pragma once

#include <array>
#include <cstdint>
#include <systemc>

namespace hopmesh::systemc {

/// Read side of a link: up to three raw codes, side by side.
class LinkIf : public sc_core::sc_interface {
 public:
  virtual const std::int32_t* wires() const = 0;
};

/// The link register of a cell. A write shows after the update phase, so all neurons of a phase read what was
/// there before.
class LinkRegister : public sc_core::sc_prim_channel, public LinkIf {
 public:
  explicit LinkRegister(const char* name) : sc_prim_channel(name) {}
  const std::int32_t* wires() const override { return now_.data(); }
  void write(std::size_t p, std::int32_t raw) {
    next_[p] = raw;
    request_update();
  }
  /// Load from the host, outside a run: shows at once.
  void load(std::size_t p, std::int32_t raw) { now_[p] = next_[p] = raw; }

 protected:
  void update() override { now_ = next_; }

 private:
  std::array<std::int32_t, 3> now_{}, next_{};
};

} // namespace hopmesh::systemc
