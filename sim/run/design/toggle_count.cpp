#include "sim/run/design/toggle_count.h"

#include "rtl_model/spec/memory_map.h"
#include "sim/levels/array_mover.h"
#include "sim/levels/level.h"

namespace hopmesh::run {

namespace {

using spec::Window;

/// Keeps the codes that go over the bus, window by window.
class CodeKeeper : public levels::ArrayPort {
 public:
  CodeKeeper(levels::ArrayPort& behind, const spec::MemoryMap& map) : behind_(behind), map_(map) {
    for (const Window w : {Window::WEIGHT, Window::OUTPUT})
      codes_[w == Window::WEIGHT].assign(map[w].words() * static_cast<std::size_t>(map[w].codes_a_word), 0);
  }

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override {
    const int error = behind_.read(address, words, count);
    keep(address, words, count);
    return error;
  }
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override {
    keep(address, words, count);
    return behind_.write(address, words, count);
  }
  int wait_for_irq() override { return behind_.wait_for_irq(); }

  const std::vector<std::uint32_t>& weights() const { return codes_[1]; }
  const std::vector<std::uint32_t>& outputs() const { return codes_[0]; }

 private:
  void keep(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
    for (const Window w : {Window::WEIGHT, Window::OUTPUT})
      for (std::uint32_t k = 0; k < count; ++k)
        if (map_[w].holds(address + 4 * k)) keep_word(w, (address + 4 * k - map_[w].offset) / 4, words[k]);
  }
  void keep_word(Window w, std::uint64_t at, std::uint32_t word) {
    const auto many = static_cast<std::uint64_t>(map_[w].codes_a_word);
    for (std::uint64_t k = 0; k < many; ++k)
      codes_[w == Window::WEIGHT][at * many + k] =
          word >> k * static_cast<std::uint64_t>(map_[w].code_bits());
  }

  levels::ArrayPort& behind_;
  const spec::MemoryMap& map_;
  std::vector<std::uint32_t> codes_[2];
};

/// Bits that change between the numbers of a sequence.
class Changes {
 public:
  explicit Changes(int width) : mask_((std::uint64_t{1} << width) - 1), width_(width) {}
  void next(std::uint64_t code) {
    for (std::uint64_t bits = (code ^ last_) & mask_; bits != 0; bits &= bits - 1) changed_ += 1;
    last_ = code, seen_ += 1;
  }
  double share() const { return seen_ > 0 ? changed_ / (seen_ * width_) : 0; }

 private:
  std::uint64_t mask_, last_ = 0;
  double changed_ = 0, seen_ = 0;
  int width_;
};

} // namespace

machine::Toggles count_toggles(const levels::Prepared& p, std::size_t steps) {
  const spec::ArraySpec& array = p.inputs.array;
  const spec::Topology& t = p.mesh->topology();
  const spec::MemoryMap map = spec::memory_map(array, t);
  const auto port = levels::default_level().make_port(array, t, {});
  CodeKeeper keeper(*port, map);
  levels::ArrayMover mover(p.inputs.scene, *p.mesh, array, keeper, false);
  for (std::size_t k = 0; k < steps; ++k) mover.advance();
  const spec::Formats& f = array.formats;
  const int cut = f.state.fraction_bits() - f.link.fraction_bits();
  const auto per_cell = static_cast<std::size_t>(t.neurons_per_cell);
  Changes weights(f.weight.width), links(f.link.width);
  for (std::size_t n = 0; n < t.neurons(); ++n) {
    const std::size_t cell = n / per_cell, row = t.row_offset(cell, n % per_cell);
    for (std::size_t tap = 0; tap < t.taps(cell); ++tap) {
      const std::size_t block = tap / per_cell;
      const std::size_t from = block == 0 ? cell : t.link_to[t.first_link[cell] + block - 1];
      weights.next(keeper.weights()[row + tap]);
      links.next(keeper.outputs()[from * per_cell + tap % per_cell] >> cut);
    }
  }
  return {weights.share(), links.share()};
}

} // namespace hopmesh::run
