#include "sim/cosim/firings/memory_layout.h"

#include "sim/cosim/firings/firing_edges.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

std::string in_capitals(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

std::string parameter(const std::string& name, std::int64_t value, const std::string& words = "") {
  return fmt::format("localparam {} = {};{}\n", name, value, words.empty() ? "" : " // " + words);
}

std::string format_parameters(const std::string& name, const spec::NumberFormat& f) {
  return parameter(name + "_BITS", f.width, f.text()) + parameter(name + "_FRACTION", f.fraction_bits()) +
         parameter(name + "_ROUNDING", static_cast<int>(f.rounding), std::string(name_of(f.rounding))) +
         parameter(name + "_OVERFLOW", static_cast<int>(f.overflow), std::string(name_of(f.overflow)));
}

/// The parameters of one key.
struct KeyParameters {
  const std::string name;
  const NeuronShape& shape;

  std::string operator()(const bool* x) const { return parameter(name, *x); }
  std::string operator()(const int* x) const { return parameter(name, *x); }
  std::string operator()(const double*) const { return ""; } // no answer depends on one
  std::string operator()(const spec::Choice& c) const {
    return parameter(name, *c.at, std::string(c.name()));
  }
  std::string operator()(const spec::NumberFormat* f) const { return format_parameters(name, *f); }
  std::string operator()(const spec::Accumulator& sum) const {
    return parameter(name + "_EXACT", *sum.exact) + format_parameters(name, shape.formats.accumulator);
  }
};

const char* count_words(const FiringColumn& column) {
  return column.count == Count::one ? "1" : column.count == Count::taps ? "a tap" : "the bias, and a beat";
}

} // namespace

std::string layout_text(const NeuronShape& shape, const std::string& name, std::size_t firings) {
  std::string text = fmt::format("// Firings of one neuron: {}.\n", name);
  text += parameter("FIRINGS", static_cast<std::int64_t>(firings)) +
          parameter("TAPS", static_cast<std::int64_t>(shape.taps), "of the longest row") +
          parameter("BEATS", static_cast<std::int64_t>(shape.beats)) + "// The array.\n";
  spec::ArraySpec array = shape.array;
  for (const spec::ArrayKey& key : spec::answer_keys(spec::array_keys(array)))
    text += std::visit(KeyParameters{in_capitals(key.word()), shape}, key.place);
  text += "// Words of a firing in each memory, and bits of a word.\n";
  for (const FiringColumn& column : firing_columns())
    text +=
        parameter(in_capitals(column.name) + "_COUNT", static_cast<std::int64_t>(count_of(column, shape))) +
        parameter(in_capitals(column.name) + "_WIDTH", column.bits(shape));
  text += "// Bits of a word of `edges`.\n";
  for (std::size_t k = 0; k < firing_edges().size(); ++k)
    text += parameter("EDGE_" + in_capitals(firing_edges()[k].name), static_cast<std::int64_t>(k));
  return text;
}

std::string memories_text(bool blank) {
  std::string text = "// Behind neuron_layout.vh, in a module. NEURONS_DIR: the folder, as a string.\n"
                     "`ifndef NEURONS_DIR\n`define NEURONS_DIR \".\"\n`endif\n";
  std::string reads;
  for (const FiringColumn& column : firing_columns()) {
    const std::string name = column.name, capitals = in_capitals(name);
    text += fmt::format("reg {}[{}_WIDTH-1:0] {} [0:FIRINGS*{}_COUNT-1];\n", column.negative ? "signed " : "",
                        capitals, name, capitals);
    if (!blank || column.part != Part::answer)
      reads += fmt::format("  $readmemh({{`NEURONS_DIR, \"/{}.memh\"}}, {});\n", name, name);
  }
  return text + "task read_neurons;\nbegin\n" + reads + "end\nendtask\n";
}

std::string folder_page(const NeuronShape& shape, const FiringTask& task, std::size_t firings) {
  std::string text = fmt::format(
      "# Firings of one neuron: {}\n\n{} firings of rows of at most {} taps, {}. Word k of firing n stands "
      "at "
      "address n · count + k.\nA module that includes `neuron_layout.vh` and `neuron_memories.vh` has all of "
      "them in memories of these names once it has called the task `read_neurons`.\n`hopmesh vectors "
      "--neurons --check` judges the answers in this "
      "folder.\n\n| file | words a firing | count | bits | signed | meaning |\n|---|---|---:|---:|---|---|\n",
      task.name, firings, shape.taps, task.blank ? "answers left to a core" : "with answers");
  for (const FiringColumn& column : firing_columns())
    text += fmt::format("| `{}.memh` | {} | {} | {} | {} | {} |\n", column.name, count_words(column),
                        count_of(column, shape), column.bits(shape), column.negative ? "yes" : "no",
                        column.meaning);
  return text;
}

} // namespace hopmesh::cosim
