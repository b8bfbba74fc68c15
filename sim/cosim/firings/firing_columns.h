// The table of a firing's numbers: what each is called, how wide it is, how often it stands in a line, and
// whether a core is asked for it. Writers, readers, the judge and the page walk its rows.
#pragma once

#include "rtl_model/spec/firing.h"
#include "sim/cosim/firings/neuron_shape.h"

#include <optional>
#include <string>
#include <vector>

namespace hopmesh::cosim {

/// A firing, and where it comes from.
struct Firing {
  std::uint64_t sweep = 0, neuron = 0; ///< sweep 0: a line that no run made
  std::uint32_t edges = 0;             ///< a bit for each edge that it shows (firing_edges.h)
  spec::FiringInputs inputs;
  spec::FiringSteps steps;
};

enum class Part { place, input, answer };
enum class Count { one, taps, sums };

struct FiringColumn {
  const char* name; ///< in files
  Part part;
  Count count;
  bool negative; ///< two's complement; otherwise unsigned
  int (*bits)(const NeuronShape&);
  const char* stage; ///< of an answer, as people call it; names of one stage stand side by side
  const char* meaning;
};

const std::vector<FiringColumn>& firing_columns();
std::size_t count_of(const FiringColumn& column, const NeuronShape& shape);
/// Place of a column in the table. Throws std::logic_error for a name that is not there.
std::size_t column_named(const std::string& name);

/// What a line holds, column by column; nothing where a core did not tell.
using Cell = std::optional<std::int64_t>;
using FiringRow = std::vector<std::vector<Cell>>;

/// Shorter rows are filled up: with taps of weight 0, which change no sum, and with the last sum.
FiringRow row_of(const Firing& firing, const NeuronShape& shape);
/// The place and the inputs that a line tells; all of them must be there. Steps stay empty.
Firing firing_of(const FiringRow& row);
/// What firing_of refuses, in words: found, and expected. Nothing where it takes the row.
std::optional<std::pair<std::string, std::string>> row_fault(const FiringRow& row, const NeuronShape& shape);

} // namespace hopmesh::cosim
