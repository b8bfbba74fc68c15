// What makes a class that Verilator wrote a VerilatedArray. Those classes have no common base, so these are
// templates; who instantiates one includes its header and that of its ___024root before.
#pragma once

#include "rtl_model/spec/cycles.h"
#include "tests/bench/verilated_array.h"

#include <stdexcept>

namespace hopmesh::bench {

/// Windows of rtl_model/verilog/stages.sv, in its order.
enum class Window { weight, source, bias, output, row_beats, last_phase, most_beats };

template <class Model> class VerilatedModel : public VerilatedArray {
 public:
  explicit VerilatedModel(const BenchNetwork& network) : network_(network) {
    model_.clock = model_.write = model_.start = 0;
    model_.eval();
  }
  ~VerilatedModel() override { model_.final(); }

  void begin_run(std::uint32_t threshold_raw, std::uint32_t max_sweeps) override {
    model_.threshold = threshold_raw, model_.max_sweeps = max_sweeps, model_.start = 1;
    clock();
    model_.start = 0;
  }
  void finish_run() override {
    while (model_.busy) clock();
  }
  void step_clock() override { clock(); }

  bool busy() const override { return model_.busy; }
  bool converged() const override { return model_.converged; }
  std::uint32_t sweeps() const override { return model_.sweeps; }
  std::uint64_t cycles() const override { return model_.cycles; }
  std::uint32_t largest_change_raw() const override { return model_.largest_change; }

 protected:
  void clock() {
    for (const unsigned char level : {1, 0}) model_.clock = level, model_.eval();
  }
  void write(Window window, std::size_t address, std::size_t word) {
    model_.write = 1, model_.window = static_cast<unsigned char>(window);
    model_.address = static_cast<std::uint32_t>(address);
    model_.word = static_cast<std::uint32_t>(word);
    clock();
    model_.write = 0;
  }
  /// A state's code from the low bits that the model keeps.
  std::int32_t code(std::uint32_t kept) const {
    const int unused = 32 - network_.array.formats.state.width;
    return static_cast<std::int32_t>(kept << unused) >> unused;
  }

  const BenchNetwork network_;
  Model model_;
};

/// verilog/neuron_modules.sv: addresses are neurons, weights lie as Topology has them.
template <class Model> class NeuronModules : public VerilatedModel<Model> {
 public:
  using VerilatedModel<Model>::VerilatedModel;

  void load(const std::vector<std::int32_t>& weights, const std::vector<std::int32_t>& biases) override {
    for (std::size_t k = 0; k < weights.size(); ++k) this->write(Window::weight, k, weights[k]);
    for (std::size_t i = 0; i < biases.size(); ++i) this->write(Window::bias, i, biases[i]);
  }
  void load_start(const std::vector<std::int32_t>& start) override {
    for (std::size_t i = 0; i < start.size(); ++i) this->write(Window::output, i, start[i]);
  }
  std::vector<std::int32_t> outputs_raw() const override {
    std::vector<std::int32_t> codes;
    for (std::size_t i = 0; i < this->network_.topology.neurons(); ++i)
      codes.push_back(this->code(this->model_.rootp->__PVT__neuron_modules__DOT__wires->state[i]));
    return codes;
  }
};

/// verilog/time_multiplexed.sv: a neuron is at {phase, element}. Refuses a network that it has no room for.
template <class Model> class TimeMultiplexed : public VerilatedModel<Model> {
 public:
  explicit TimeMultiplexed(const BenchNetwork& network)
      : VerilatedModel<Model>(network), phases_(spec::phases_of(network.topology, network.array.schedule)),
        slot_(network.topology.neurons()),
        elements_(std::size(this->model_.rootp->time_multiplexed__DOT__sum.m_storage)),
        rows_(std::size(this->model_.rootp->time_multiplexed__DOT__weight.m_storage) /
              std::size(this->model_.rootp->time_multiplexed__DOT__state.m_storage)) {
    expect_room();
    for (std::size_t k = 0; k < phases_.size(); ++k)
      for (std::size_t e = 0; e < phases_[k].size(); ++e) slot_[phases_[k][e]] = k * elements_ + e;
    load_phases();
  }

  void load(const std::vector<std::int32_t>& weights, const std::vector<std::int32_t>& biases) override {
    const spec::Topology& t = this->network_.topology;
    const std::size_t per_cell = t.neurons_per_cell;
    for (std::size_t i = 0; i < t.neurons(); ++i) {
      const std::size_t row = t.row_offset(i / per_cell, i % per_cell), taps = t.taps(i / per_cell);
      for (std::size_t k = 0; k < t.most_taps(); ++k) // a short row ends in zeros, of itself
        load_tap(i, k, k < taps ? weights[row + k] : 0, k < taps ? source_of(i / per_cell, k) : i);
      this->write(Window::bias, slot_[i], biases[i]);
    }
  }
  void load_start(const std::vector<std::int32_t>& start) override {
    for (std::size_t i = 0; i < start.size(); ++i) this->write(Window::output, slot_[i], start[i]);
  }
  std::vector<std::int32_t> outputs_raw() const override {
    std::vector<std::int32_t> codes;
    const auto& state = this->model_.rootp->time_multiplexed__DOT__state;
    for (std::size_t slot : slot_) codes.push_back(this->code(state[slot / elements_][slot % elements_]));
    return codes;
  }

 private:
  void expect_room() const {
    bool fits = phases_.size() <= std::size(this->model_.rootp->time_multiplexed__DOT__state.m_storage) &&
                this->network_.topology.most_taps() <= rows_;
    for (const auto& neurons : phases_) fits = fits && neurons.size() <= this->model_.elements;
    if (!fits) throw std::invalid_argument("the time-multiplexed model has no room for this network");
  }
  std::size_t source_of(std::size_t cell, std::size_t tap) const {
    const spec::Topology& t = this->network_.topology;
    const std::size_t per_cell = t.neurons_per_cell, k = tap / per_cell;
    const std::size_t from = k == 0 ? cell : t.link_to[t.first_link[cell] + k - 1];
    return from * per_cell + tap % per_cell;
  }
  void load_tap(std::size_t neuron, std::size_t tap, std::int32_t weight, std::size_t source) {
    const std::size_t phase = slot_[neuron] / elements_, element = slot_[neuron] % elements_;
    const std::size_t address = (phase * rows_ + tap) * elements_ + element;
    this->write(Window::weight, address, weight);
    this->write(Window::source, address, slot_[source]);
  }
  void load_phases() {
    const spec::Topology& t = this->network_.topology;
    for (std::size_t k = 0; k < phases_.size(); ++k) {
      std::size_t longest = 0;
      for (std::uint32_t i : phases_[k]) longest = std::max(longest, t.taps(i / t.neurons_per_cell));
      this->write(Window::row_beats, k * elements_, longest);
    }
    this->write(Window::last_phase, 0, phases_.size() - 1);
    this->write(Window::most_beats, 0, t.most_taps());
  }

  const spec::Phases phases_;
  std::vector<std::size_t> slot_;
  const std::size_t elements_, rows_; ///< as addresses count them: powers of two
};

} // namespace hopmesh::bench
