// The table of an array's keys. Readers, writers, test vectors, `info`, random and shrunk arrays, and the
// page walk its rows.
#pragma once

#include "rtl_model/spec/array_limits.h"
#include "rtl_model/spec/memory_map.h"

namespace hopmesh::spec {

// The rows below are in the order of array files.

/// Keys of what sums rows: which neurons, when, on how many multipliers.
inline ArrayKeys element_keys(ArraySpec& a) {
  return {
      ArrayKey("array.schedule", choice(a.schedule, schedule_names),
               "who fires together: neurons of a colour, one after the other, all at once")
          .in_vectors(1)
          .plain(Schedule::sequential),
      ArrayKey("array.lanes", &a.lanes, "multipliers a neuron, or an element: inputs taken a cycle")
          .allows(detail::numbers(1, most_lanes))
          .in_vectors(5)
          .plain(1),
      ArrayKey("array.elements", &a.elements,
               "processing elements that the neurons of a phase share; 0: one a neuron")
          .allows(detail::numbers(0, most_elements))
          .in_vectors(6)
          .plain(0),
      ArrayKey("array.stages", choice(a.stages, stages_names), "an output stage an element, or one for all")
          .counts_only(is_folded(a), "array.elements above 0")
          .in_vectors(7)
          .plain(Stages::each),
  };
}

/// Keys of what makes V of a sum.
inline ArrayKeys stage_keys(ArraySpec& a) {
  const char* const with_division = "an array.output other than \"binary\"";
  const char* const with_reciprocal = divides(a) ? "array.normaliser = \"reciprocal\"" : with_division;
  return {
      ArrayKey("array.output", choice(a.output, output_names),
               "V moves by R · s / N; is the sign of s; moves by ω · s / |w_ii|; or by s / N, with momentum")
          .in_vectors(2)
          .plain(Output::modified),
      ArrayKey("array.normaliser", choice(a.normaliser, normaliser_names),
               "how u = s / N is made; not looked at beside binary outputs")
          .counts_only(divides(a), with_division)
          .in_vectors(3)
          .plain(Normaliser::prescaled),
      ArrayKey("array.reciprocal_bits", &a.reciprocal_bits, "width of the truncated reciprocal")
          .in_unit("bits")
          .allows(detail::numbers(least_reciprocal_bits, most_reciprocal_bits))
          .counts_only(has_reciprocal(a), with_reciprocal)
          .in_vectors(4)
          .plain(18),
      ArrayKey("array.relaxation", &a.relaxation, "ω of `projected` in sixteenths: 16 is Gauss and Seidel's")
          .allows(detail::numbers(1, most_relaxation))
          .counts_only(a.output == Output::projected, "array.output = \"projected\"")
          .in_vectors(31)
          .plain(16),
      ArrayKey("array.momentum_entries", &a.momentum_entries,
               "entries of the table of m, of which a sweep takes one and the last one holds on")
          .allows(detail::numbers(1, most_momentum_entries))
          .counts_only(has_momentum(a), "array.output = \"momentum\"")
          .in_vectors(32)
          .plain(1),
      ArrayKey("array.pipeline", &a.pipeline,
               "more registers inside normalise and output: longer, and a faster clock")
          .allows(detail::numbers(0, most_registers))
          .in_vectors(8)
          .plain(0),
  };
}

inline ArrayKeys clock_keys(ArraySpec& a) {
  return {
      ArrayKey("array.bus_bits", &a.bus_bits, "data width of the host bus")
          .in_unit("bits")
          .allows({"32, 64 or 128", 32, 128, false, {bus_widths.begin(), bus_widths.end()}})
          .in_vectors(9)
          .plain(32),
      ArrayKey("array.packing", &a.packing, "codes of 16 bits and less share the words of the bus")
          .allows({"`true`, `false`"})
          .counts_only(can_pack(a), "a weight, bias or state of at most 16 bits, or a table of m")
          .in_vectors(30) // behind the formats
          .plain(false),
      ArrayKey("array.clock_mhz", &a.clock_mhz, "only for times in seconds: changes neither bits nor cycles")
          .in_unit("MHz")
          .allows({"above 0, at most 10000", 0, most_mhz, true}),
  };
}

inline ArrayKeys format_keys(ArraySpec& a) {
  constexpr int first_line = 10; // of test vectors
  ArrayKeys keys;
  for (const SignalClass& signal : signal_classes) {
    NumberFormat* const format = &(a.formats.*signal.format);
    const bool sum = signal.format == &Formats::accumulator;
    const Place place = sum ? Place(Accumulator{&a.exact_accumulator, format}) : Place(format);
    const int line = first_line + static_cast<int>(keys.size());
    keys.push_back(ArrayKey(std::string("formats.") + signal.name, place, signal.meaning)
                       .allows(detail::bits(signal))
                       .in_vectors(line));
  }
  return keys;
}

inline ArrayKeys array_keys(ArraySpec& a) {
  ArrayKeys all;
  for (const auto& some : {element_keys(a), stage_keys(a), clock_keys(a), format_keys(a)})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// The rows on which answers depend, in the order of test vectors.
inline ArrayKeys answer_keys(const ArrayKeys& all) {
  ArrayKeys some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some),
               [](const ArrayKey& key) { return key.vectors_line > 0; });
  std::sort(some.begin(), some.end(),
            [](const ArrayKey& a, const ArrayKey& b) { return a.vectors_line < b.vectors_line; });
  return some;
}

/// The table of an array. Where a walker takes one, a caller may give it rows of its own beside these.
using ArrayTable = ArrayKeys (*)(ArraySpec&);

} // namespace hopmesh::spec
