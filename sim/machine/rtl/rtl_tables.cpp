#include "sim/machine/rtl/rtl_tables.h"

#include "rtl_model/spec/rounds.h"

namespace hopmesh::machine {

using spec::ArraySpec;
using spec::Topology;

void BitTable::put(std::size_t row, int at, int count, std::uint64_t value) {
  std::uint32_t* const to = &bits_[row * words];
  for (int k = 0; k < count; ++k)
    if (value >> k & 1) to[(at + k) / 32] |= 1u << (at + k) % 32;
}

std::string BitTable::hex() const {
  constexpr char digits[] = "0123456789abcdef";
  const int count = (width + 3) / 4;
  std::string text;
  for (std::size_t k = 0; k < rows; ++k) {
    for (int d = count - 1; d >= 0; --d) text += digits[row(k)[d / 8] >> d % 8 * 4 & 15];
    text += '\n';
  }
  return text;
}

namespace {

/// Where a neuron is worked on.
struct Home {
  std::size_t element = 0, place = 0; ///< of its stage
  std::size_t row_element = 0, first_line = 0;
};

/// Writes the tables of one array.
class Writer {
 public:
  Writer(const ArraySpec& a, const Topology& t, const RtlRoom& room)
      : array_(a), topology_(t), room_(room), fold_(spec::fold_of(a, t, spec::phases_of(t, a.schedule))),
        homes_(t.neurons()) {
    find_homes();
  }

  BitTable lines() const;
  BitTable rounds() const;
  BitTable weight_map() const;
  BitTable neuron_map() const;

 private:
  void find_homes();
  void put_taps(BitTable& table, std::size_t line, std::size_t element, std::uint32_t neuron) const;
  std::uint32_t source(std::uint32_t neuron, std::size_t tap) const;
  bool shares() const { return spec::shares_stage(array_); }
  std::size_t elements() const { return static_cast<std::size_t>(array_.elements); }
  int place_bits() const { return index_bits(room_.places); }
  /// Of the memory of links that a source is in; none where there is one.
  int sub_bits() const { return shares() || elements() == 1 ? 0 : index_bits(elements()); }
  bool marks_own() const { return array_.output == spec::Output::projected; }
  int field_bits() const { return place_bits() + sub_bits() + 1 + marks_own(); }

  const ArraySpec& array_;
  const Topology& topology_;
  const RtlRoom room_;
  const spec::Fold fold_;
  std::vector<Home> homes_;
};

void Writer::find_homes() {
  std::size_t line = 0, round_number = 0, fired = 0;
  for (std::size_t k = 0; k < fold_.rounds.size(); ++k) {
    for (const spec::Round& round : fold_.rounds[k]) {
      for (std::size_t e = 0; e < round.count; ++e) {
        const std::size_t position = round.first + e;
        Home& home = homes_[fold_.order[k][position]];
        home = shares() ? Home{0, fired + position, e, line} : Home{e, round_number, e, line};
      }
      line += round.accumulate;
      round_number += 1;
    }
    fired += fold_.order[k].size();
  }
}

std::uint32_t Writer::source(std::uint32_t neuron, std::size_t tap) const {
  const auto per_cell = static_cast<std::size_t>(topology_.neurons_per_cell);
  const std::size_t cell = neuron / per_cell, block = tap / per_cell;
  const std::size_t from = block == 0 ? cell : topology_.link_to[topology_.first_link[cell] + block - 1];
  return static_cast<std::uint32_t>(from * per_cell + tap % per_cell);
}

// A line is three flags, then a field for each element: {own tap, tap, memory, place}.
void Writer::put_taps(BitTable& table, std::size_t line, std::size_t element, std::uint32_t neuron) const {
  const auto per_cell = static_cast<std::uint32_t>(topology_.neurons_per_cell);
  const std::size_t taps = topology_.taps(neuron / per_cell);
  const int at = 3 + static_cast<int>(element) * field_bits();
  for (std::size_t tap = 0; tap < taps; ++tap) {
    const Home& home = homes_[source(neuron, tap)];
    table.put(line + tap, at, place_bits(), home.place);
    table.put(line + tap, at + place_bits(), sub_bits(), home.element);
    table.put(line + tap, at + place_bits() + sub_bits(), 1, 1);
    if (marks_own()) table.put(line + tap, at + field_bits() - 1, 1, tap == neuron % per_cell);
  }
}

BitTable Writer::lines() const {
  BitTable table("LINES", 3 + array_.elements * field_bits(), rtl_room(array_, topology_).lines);
  std::size_t line = 0;
  for (std::size_t k = 0; k < fold_.rounds.size(); ++k)
    for (const spec::Round& round : fold_.rounds[k]) {
      for (std::size_t e = 0; e < round.count; ++e) put_taps(table, line, e, fold_.order[k][round.first + e]);
      line += round.accumulate;
      const bool ends_phase = &round == &fold_.rounds[k].back();
      table.put(line - 1, 0, 1, 1);
      table.put(line - 1, 1, 1, ends_phase);
      table.put(line - 1, 2, 1, ends_phase && k + 1 == fold_.rounds.size());
    }
  return table;
}

BitTable Writer::rounds() const {
  const int count_bits = index_bits(elements() + 1);
  BitTable table("ROUNDS", count_bits + 2, rtl_room(array_, topology_).rounds);
  std::size_t number = 0;
  for (std::size_t k = 0; k < fold_.rounds.size(); ++k)
    for (const spec::Round& round : fold_.rounds[k]) {
      const bool ends_phase = &round == &fold_.rounds[k].back();
      table.put(number, 0, 1, ends_phase);
      table.put(number, 1, 1, ends_phase && k + 1 == fold_.rounds.size());
      table.put(number++, 2, count_bits, round.count);
    }
  return table;
}

BitTable Writer::weight_map() const {
  const int line_bits = index_bits(room_.lines), element_bits = index_bits(elements());
  BitTable table("WEIGHT_MAP", line_bits + element_bits, topology_.weight_words());
  const auto per_cell = static_cast<std::size_t>(topology_.neurons_per_cell);
  for (std::size_t n = 0; n < homes_.size(); ++n)
    for (std::size_t tap = 0; tap < topology_.taps(n / per_cell); ++tap) {
      const std::size_t code = topology_.row_offset(n / per_cell, n % per_cell) + tap;
      table.put(code, 0, line_bits, homes_[n].first_line + tap);
      table.put(code, line_bits, element_bits, homes_[n].row_element);
    }
  return table;
}

BitTable Writer::neuron_map() const {
  BitTable table("NEURON_MAP", place_bits() + index_bits(elements()), homes_.size());
  for (std::size_t n = 0; n < homes_.size(); ++n) {
    table.put(n, 0, place_bits(), homes_[n].place);
    table.put(n, place_bits(), index_bits(elements()), homes_[n].element);
  }
  return table;
}

BitTable numbers(const std::string& name, int width, const std::vector<std::uint32_t>& values) {
  BitTable table(name, width, std::max<std::size_t>(values.size(), 1));
  for (std::size_t k = 0; k < values.size(); ++k) table.put(k, 0, width, values[k]);
  return table;
}

} // namespace

std::vector<BitTable> rtl_tables(const ArraySpec& array, const Topology& topology, const RtlRoom& room) {
  const Writer writer(array, topology, room);
  const int first_bits = index_bits(std::max<std::size_t>(room.links, 1) + 1),
            cell_bits = index_bits(room.cells + 1);
  return {writer.lines(),
          writer.rounds(),
          writer.weight_map(),
          writer.neuron_map(),
          numbers("FIRST_LINK", first_bits, topology.first_link),
          numbers("LINK", cell_bits, topology.link_to)};
}

} // namespace hopmesh::machine
