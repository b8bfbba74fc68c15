// The default array as one writes it first in SystemC: sc_fixed for every number, a signal for every value
// that leaves a module, a clocked method for every neuron. Benchmarks measure the production array against
// it. This model shares rtl_model/spec with that array and no arithmetic, so it is one more witness of the
// same bits.
#pragma once

#ifndef SC_INCLUDE_FX
#error "sc_fixed needs SC_INCLUDE_FX defined for the whole file (tests/bench/CMakeLists.txt does)"
#endif

#include "rtl_model/spec/cycles.h"

#include <memory>
#include <systemc>

namespace hopmesh::bench {

/// Formats are compile-time here; ScFixedArray refuses an array that has others.
using WeightFixed = sc_dt::sc_fixed<16, 1, sc_dt::SC_RND, sc_dt::SC_SAT>;
using BiasFixed = sc_dt::sc_fixed<24, 9, sc_dt::SC_RND, sc_dt::SC_SAT>;
using SumFixed = sc_dt::sc_fixed<39, 10, sc_dt::SC_TRN, sc_dt::SC_WRAP>; ///< exact for up to 255 taps
using DriveFixed = sc_dt::sc_fixed<18, 2, sc_dt::SC_RND, sc_dt::SC_SAT>;
using StateFixed = sc_dt::sc_fixed<24, 2, sc_dt::SC_RND, sc_dt::SC_SAT>;
using LinkFixed = sc_dt::sc_fixed<16, 2, sc_dt::SC_RND, sc_dt::SC_SAT>;
using NormFixed = sc_dt::sc_ufixed<29, 14>;       ///< sum |w| + |I|, in the last place of w and I
using ReciprocalFixed = sc_dt::sc_ufixed<18, 18>; ///< mantissa of 1 / N
using BiasedFixed = sc_dt::sc_fixed<25, 3>;       ///< R = 1 - V or 1 + V, exact
/// R u, rounded as the state; a bit more, because from -1 to +1 is a step of 2.
using DeltaFixed = sc_dt::sc_fixed<25, 3, sc_dt::SC_RND, sc_dt::SC_SAT>;

class ScFixedNeuron : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(ScFixedNeuron);
  ScFixedNeuron(sc_core::sc_module_name name, std::size_t taps, std::size_t phase,
                const spec::CycleModel& cycles);

  sc_core::sc_in<bool> clock;
  sc_core::sc_in<int> segment, beat;                ///< a number of spec::Segment; cycle of it
  sc_core::sc_vector<sc_core::sc_in<LinkFixed>> in; ///< one a tap
  sc_core::sc_out<LinkFixed> out;
  sc_core::sc_out<DeltaFixed> change; ///< |V' - V| of the last time it fired

  /// Outside a run, after elaboration.
  void load(const std::int32_t* weights_raw, std::int32_t bias_raw, std::int32_t state_raw);
  std::int32_t state_raw() const;

 private:
  void on_clock();
  void prepare_beat(int k);
  void phase_beat(int k);
  void divide();
  void normalise();
  void bias_by_r();
  void publish();

  const int taps_, segment_, phase_cycles_, prepare_cycles_;
  std::vector<WeightFixed> weights_;
  BiasFixed bias_;
  SumFixed sum_;
  NormFixed norm_;
  ReciprocalFixed reciprocal_;
  int reciprocal_shift_ = 0;
  DriveFixed drive_;
  DeltaFixed delta_;
  StateFixed state_;
};

class ScFixedArray : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(ScFixedArray);
  /// Throws std::invalid_argument unless `array` has the formats above, one lane, a reciprocal of 18 bits.
  ScFixedArray(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology);

  /// Codes as on the production array's bus; after elaboration, outside a run.
  void load(const std::vector<std::int32_t>& weights, const std::vector<std::int32_t>& biases,
            const std::vector<std::int32_t>& start);
  /// Simulates a whole run, from START to DONE. A threshold counts in the state's last place.
  void run(std::uint32_t threshold_raw, std::uint32_t max_sweeps);

  std::vector<std::int32_t> outputs_raw() const;
  std::uint32_t sweeps() const { return sweeps_; }
  std::uint64_t cycles() const { return cycles_; }
  std::uint32_t largest_change_raw() const;

 private:
  void wire();
  void toggle_clock();
  void on_clock();
  void enter(int segment);
  int next_segment();
  void measure_change();

  const spec::Topology topology_;
  const spec::Phases phases_;
  const spec::CycleModel model_;
  const sc_core::sc_time period_;
  sc_core::sc_event edge_;
  sc_core::sc_signal<bool> clock_;
  sc_core::sc_signal<int> segment_, beat_;
  sc_core::sc_vector<sc_core::sc_signal<LinkFixed>> links_;
  sc_core::sc_vector<sc_core::sc_signal<DeltaFixed>> changes_;
  std::vector<std::unique_ptr<ScFixedNeuron>> neurons_;
  DeltaFixed threshold_, largest_;
  std::uint32_t max_sweeps_ = 1, sweeps_ = 0;
  std::uint64_t cycles_ = 0;
  bool running_ = false;
};

} // namespace hopmesh::bench
