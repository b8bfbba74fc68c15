#include "tests/bench/clocked_flag.h"

namespace hopmesh::bench {

namespace {

const std::uint32_t* words(const std::vector<std::int32_t>& codes) {
  return reinterpret_cast<const std::uint32_t*>(codes.data());
}

template <typename From, typename To> void copy(const From& from, To& to) {
  to.resize(from.size());
  std::copy(from.begin(), from.end(), to.begin());
}

} // namespace

void RegisterCopy::take(const engine::ClockedEngine& engine) {
  const engine::ClockedRegisters& r = engine.registers();
  copy(r.norm, norm);
  copy(r.sum, sum);
  copy(r.drive, drive);
  copy(r.change, change);
  copy(r.state, state);
  copy(r.link, link);
}

ClockedFlag::ClockedFlag()
    : network_(grid_network(20, 20, 20, "", {"relax.max_sweeps=20"})),
      engine_(std::make_unique<engine::ClockedEngine>(network_.array, network_.topology)) {
  engine_->write_weights(0, words(network_.weights), network_.weights.size());
  engine_->write_biases(0, words(network_.biases), network_.biases.size());
  engine_->write_outputs(0, words(network_.start), network_.start.size());
}

// As many sweeps as a step of that flag takes; the outputs go on from where they are.
void ClockedFlag::start_if_idle() {
  if (!engine_->busy()) engine_->start(0, 282);
}

std::int64_t ClockedFlag::step(std::uint64_t clocks) {
  for (; clocks > 0; --clocks) {
    start_if_idle();
    engine_->step();
  }
  return outputs();
}

std::int64_t ClockedFlag::step_and_copy(std::uint64_t clocks) {
  for (; clocks > 0; --clocks) {
    start_if_idle();
    engine_->step();
    copy_.take(*engine_);
  }
  return outputs();
}

std::int64_t ClockedFlag::step_and_draw(std::uint64_t clocks) {
  levels::WaveRequest request;
  request.file = "/dev/null";
  levels::ClockedVcd vcd(request, *engine_, 10000, false);
  vcd.show_all(0);
  for (std::uint64_t cycle = 1; cycle <= clocks; ++cycle) {
    start_if_idle();
    const int segment = engine_->segment();
    engine_->step();
    vcd.edge(2 * cycle, segment, false);
  }
  vcd.finish(2 * clocks + 2);
  return outputs();
}

std::int64_t ClockedFlag::stride(std::uint64_t clocks) {
  while (clocks > 0) {
    start_if_idle();
    const std::uint64_t before = engine_->result().cycles;
    engine_->step(clocks);
    clocks -= engine_->result().cycles - before;
  }
  return outputs();
}

std::int64_t ClockedFlag::outputs() const {
  std::int64_t sum = 0;
  for (std::int32_t V : engine_->registers().state) sum += V;
  return sum;
}

} // namespace hopmesh::bench
