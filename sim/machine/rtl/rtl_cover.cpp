#include "sim/machine/rtl/rtl_cover.h"

namespace hopmesh::machine {

namespace {

constexpr int most_rtl_elements = 256; ///< a line of the table has a field for each of them
constexpr int most_with_stages = 32;   ///< every element has a memory of the links of every other

} // namespace

std::optional<spec::SpecFault> rtl_fault(const spec::ArraySpec& a, const spec::Topology& t) {
  using spec::SpecFault;
  const auto number = [](int n) { return std::to_string(n); };
  if (t.cells() == 0) return SpecFault{"mesh", "no free node", "an array of at least one cell"};
  if (a.elements == 0)
    return SpecFault{"array.elements", "0",
                     "1 to " + number(most_rtl_elements) + ": RTL is of folded arrays (--array folded)"};
  if (a.elements > most_rtl_elements)
    return SpecFault{"array.elements", number(a.elements),
                     "at most " + number(most_rtl_elements) + " elements of RTL"};
  if (!spec::shares_stage(a) && a.elements > most_with_stages)
    return SpecFault{"array.elements", number(a.elements),
                     "at most " + number(most_with_stages) + " elements of RTL with a stage each"};
  if (a.lanes != 1) return SpecFault{"array.lanes", number(a.lanes), "1: an element of RTL has one lane"};
  if (!a.exact_accumulator)
    return SpecFault{"formats.accumulator", a.formats.accumulator.text(),
                     "\"exact\": RTL has no accumulator that rounds"};
  if (a.bus_bits != 32)
    return SpecFault{"array.bus_bits", number(a.bus_bits), "32: the bus of RTL has so many"};
  if (a.packing) return SpecFault{"array.packing", "true", "false: RTL has a word of its own for every code"};
  return std::nullopt;
}

} // namespace hopmesh::machine
