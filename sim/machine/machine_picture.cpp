#include "sim/machine/machine_picture.h"

#include "rtl_model/spec/cycles.h"
#include "rtl_model/spec/memory_map.h"
#include "sim/input/count_text.h"
#include "sim/machine/silicon.h"
#include "sim/pictures/svg_canvas.h"

namespace hopmesh::machine {

namespace {

using input::grouped, input::with_noun;
using pictures::Box;
using Lines = std::vector<std::string>;

constexpr const char *memory_colour = "#dcebf7", *multiplier_colour = "#fbe3cf", *register_colour = "#e3f2e6",
                     *control_colour = "#f1f1f4", *card_colour = "#fbfbfc", *ink = "#4a5560";

class MachineDrawing : public pictures::SvgCanvas {
 public:
  MachineDrawing(const spec::ArraySpec& array, const spec::Topology& topology, const std::string& scene)
      : SvgCanvas(1180, 690, 40, "The machine: array " + array.name + " for " + scene,
                  fmt::format("{} of {}, {}; made from the description", with_noun(topology.cells(), "cell"),
                              with_noun(static_cast<std::uint64_t>(topology.neurons_per_cell), "neuron"),
                              with_noun(topology.links(), "link"))),
        a_(array), t_(topology), f_(spec::built_formats(array, topology.most_taps())),
        parts_(parts_of(array, topology)), memory_(memory_bits(array, topology)) {
    put(R"(<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" )"
        R"(orient="auto"><path d="M0 0L8 4L0 8z" fill="{}"/></marker></defs>)",
        ink);
    draw_host();
    draw_control();
    draw_cards();
    draw_sums();
    draw_stage();
    draw_way_back();
    draw_totals();
  }

 private:
  bool folded() const { return spec::is_folded(a_); }

  void block(const Box& box, const char* colour, const std::string& heading, const Lines& lines) {
    put(R"(<rect x="{}" y="{}" width="{}" height="{}" rx="4" fill="{}" stroke="{}"/>)", box.left, box.top,
        box.right - box.left, box.bottom - box.top, colour, ink);
    text(box.left + 10, box.top + 20, heading, R"( font-weight="600")");
    for (std::size_t k = 0; k < lines.size(); ++k)
      text(box.left + 10, box.top + 38 + 17 * double(k), lines[k], R"( font-size="12")");
  }
  void arrow(const pictures::Points& points, bool both = false) {
    put(R"svg(<path d="{}" fill="none" stroke="{}" stroke-width="1.6" marker-end="url(#tip)"{}/>)svg",
        pictures::path_through(points), ink, both ? R"svg( marker-start="url(#tip)")svg" : "");
  }
  /// `count` numbers of some bits each.
  static std::string of_bits(std::uint64_t count, int width) {
    return fmt::format("{} × {} bits", grouped(count), width);
  }

  void draw_host() {
    const spec::MemoryMap map = spec::memory_map(a_, t_);
    const auto window = [&](const char* name, spec::Window w) {
      return fmt::format("{}: {}", name, with_noun(map[w].words(), "word"));
    };
    block({40, 84, 226, 150}, control_colour, "Host", {"makes networks,", "moves the mesh"});
    arrow({{120, 158}, {120, 228}});
    arrow({{140, 228}, {140, 158}});
    text(154, 197, fmt::format("bus, {} bits{}", a_.bus_bits, a_.packing ? ", packed" : ""),
         R"( font-size="12")");
    block({40, 234, 226, 386}, register_colour, "Registers, windows",
          {fmt::format("{} KiB of addresses", grouped(map.span / 1024)),
           window("weights", spec::Window::WEIGHT), window("biases", spec::Window::BIAS),
           window("outputs", spec::Window::OUTPUT), "formats, sizes, counters", "START, ABORT, RESET, irq"});
    arrow({{226, 330}, {286, 330}});
  }

  std::string rounds_text(const spec::Phases& phases) const {
    if (!folded()) return "each in a single round";
    std::uint64_t rounds = 0;
    for (const spec::Rounds& phase : spec::fold_of(a_, t_, phases).rounds) rounds += phase.size();
    return fmt::format("in {} of at most {}", with_noun(rounds, "round"),
                       with_noun(parts_.accumulators, "neuron"));
  }

  void draw_control() {
    const spec::Phases phases = spec::phases_of(t_, a_.schedule);
    const spec::CycleModel m = spec::cycle_model(a_, t_, phases);
    block({270, 84, 640, 164}, control_colour, "Sequencer",
          {fmt::format("{}: {} a sweep,", name_of(a_.schedule), with_noun(phases.size(), "phase")),
           rounds_text(phases),
           fmt::format("a sweep takes {} cycles, prepare {}", grouped(m.sweep), grouped(m.prepare))});
    arrow({{440, 164}, {440, 182}});
    block({860, 84, 1140, 150}, register_colour, "Convergence detector",
          {"the largest |ΔV| of a sweep:", "at rest, or on to the next sweep?"});
    arrow({{860, 117}, {646, 117}});
  }

  // Cards behind the first one are the other elements; a stage of its own lies on the card.
  void draw_cards() {
    const double right = parts_.stages > 1 ? 1140 : 722;
    const int behind = static_cast<int>(std::min<std::uint64_t>(parts_.accumulators - 1, 3));
    for (int k = behind; k >= 0; --k)
      put(R"(<rect x="{}" y="{}" width="{}" height="{}" rx="8" fill="{}" stroke="#9aa5b1"/>)", 286.0 + 7 * k,
          188.0 + 7 * k, right - 286 - 21, 336.0, card_colour);
    if (parts_.stages == 1)
      put(R"(<rect x="748" y="188" width="392" height="336" rx="8" fill="{}" stroke="#9aa5b1"/>)",
          card_colour);
    text(300, 210,
         folded() ? with_noun(parts_.accumulators, "element")
                  : with_noun(parts_.accumulators, "neuron") + ", nothing shared",
         R"( font-size="15" font-weight="600")");
  }

  void draw_sums() {
    const std::uint64_t neurons = t_.neurons();
    const std::string all = folded() ? "all elements" : "all neurons";
    block({300, 224, 490, 290}, memory_colour, "Rows",
          {of_bits(t_.weight_words(), f_.weight.width), "of weights, " + all});
    block({300, 302, 490, 368}, memory_colour, "Biases", {of_bits(neurons, f_.bias.width), all});
    Lines links{of_bits(neurons, f_.link.width)};
    links.push_back(folded() ? fmt::format("in each of {} memories", grouped(parts_.link_memories))
                             : std::string("a register each, and wires"));
    if (parts_.link_banks > 1) links.push_back("in two banks: read, write");
    block({300, 380, 490, 464}, memory_colour, "Links", links);
    block({526, 224, 690, 290}, multiplier_colour, a_.lanes == 1 ? "Multiplier" : "Multipliers",
          {fmt::format("w · L: {} × {} bits", f_.weight.width, f_.link.width),
           with_noun(static_cast<std::uint64_t>(a_.lanes), "lane")});
    arrow({{490, 257}, {520, 257}});
    arrow({{490, 422}, {508, 422}, {508, 272}, {520, 272}});
    block({526, 320, 690, 386}, register_colour, "Accumulator s",
          {fmt::format("{} bits{}", f_.accumulator.width, a_.exact_accumulator ? ", exact" : ""),
           spec::sums_norm(a_) ? fmt::format("beside it {}: {} bits", divisor(), norm_bits(a_, t_)) : ""});
    arrow({{608, 290}, {608, 314}});
    arrow({{490, 345}, {520, 345}});
    if (!spec::shares_stage(a_)) return arrow({{690, 353}, {756, 353}});
    block({526, 416, 690, 464}, register_colour, "Hold register",
          {fmt::format("{} bits", f_.accumulator.width)});
    arrow({{608, 386}, {608, 410}});
    arrow({{690, 440}, {728, 440}, {728, 353}, {756, 353}});
  }

  const char* divisor() const { return a_.output == spec::Output::projected ? "|w_ii|" : "N"; }

  Lines normaliser_lines() const {
    if (a_.output == spec::Output::binary) return {"u is the sign of s"};
    if (!spec::sums_norm(a_)) return {"rows are divided by the host", "u is s, rounded"};
    const std::uint64_t neurons = t_.neurons();
    const char* divider = spec::shares_stage(a_) ? "divider: all bits at once" : "divider: a bit a cycle";
    if (!spec::has_reciprocal(a_))
      return {fmt::format("u = s / {}", divisor()), divider,
              fmt::format("{}: ", divisor()) + of_bits(neurons, norm_bits(a_, t_))};
    return {fmt::format("u = s · r: {} × {} bits", f_.accumulator.width, a_.reciprocal_bits), divider,
            "r: " + of_bits(neurons, reciprocal_bits(a_, t_))};
  }

  Lines change_lines() const {
    switch (a_.output) {
    case spec::Output::binary:
      return {"ΔV = u − V"};
    case spec::Output::projected:
      return {"V + u, held", "within ±1"};
    case spec::Output::momentum:
      return {"Y + u is V,", "V + m · ΔV is Y:",
              fmt::format("{} × {} bits", spec::momentum_format.width, f_.state.width + 1),
              fmt::format("m: {} entries", grouped(static_cast<std::uint64_t>(a_.momentum_entries)))};
    default:
      return {"ΔV = R · u:", fmt::format("{} × {} bits", f_.state.width, f_.drive.width), "R = 1 ∓ V"};
    }
  }

  void draw_stage() {
    text(762, 210,
         fmt::format("Output stage, {}: {}", parts_.stages == 1 ? "one for all" : "one each",
                     with_noun(spec::stage_cycles(a_), "cycle")),
         R"( font-size="15" font-weight="600")");
    const bool normalises = a_.output != spec::Output::binary;
    const bool multiplies = a_.output == spec::Output::modified || spec::has_momentum(a_);
    const int twice = a_.output == spec::Output::projected ? 1 : 0; // u reaches 2
    Lines registers{fmt::format("u: {} bits, ΔV: {} bits", f_.drive.width + twice, f_.state.width + 1)};
    if (a_.pipeline > 0)
      registers.push_back(with_noun(static_cast<std::uint64_t>(a_.pipeline), "register") + " of pipeline");
    block({762, 224, 942, 290}, register_colour, "Registers", registers);
    block({762, 306, 942, 400}, normalises && spec::has_reciprocal(a_) ? multiplier_colour : control_colour,
          "Normaliser", normaliser_lines());
    block({972, 306, 1100, 400}, multiplies ? multiplier_colour : control_colour, "Change", change_lines());
    arrow({{942, 353}, {966, 353}});
    block({762, 440, 1100, 506}, memory_colour, "States",
          {(spec::has_momentum(a_) ? "V, and as many Y: " : "V: ") + of_bits(t_.neurons(), f_.state.width),
           spec::has_momentum(a_) ? "both are written; links show Y, after a restart V"
                                  : "V + ΔV is written, and shown as a link"});
    arrow({{1036, 400}, {1036, 434}});
    arrow({{1072, 306}, {1072, 156}});
    text(1064, 246, "|ΔV|", R"( text-anchor="end")");
  }

  void draw_way_back() {
    arrow({{930, 506}, {930, 576}, {395, 576}, {395, 470}});
    const char* writes = !folded()            ? "to the neuron and its neighbours"
                         : parts_.stages == 1 ? "to every memory of links; one write a cycle"
                                              : "to every memory of links; a write for each stage";
    text(662, 570,
         fmt::format("L: {} in {} bits, {}", spec::has_momentum(a_) ? "Y" : "V", f_.link.width, writes),
         R"( text-anchor="middle")");
  }

  void draw_totals() {
    const MultiplierBits multipliers = multiplier_bits(a_, t_);
    double x = 40;
    x = name(x, 628, memory_colour, fmt::format("memory: {} bits", grouped(memory_.total())));
    x = name(x, 628, multiplier_colour,
             fmt::format("multipliers: {} bits times bits", grouped(multipliers.total())));
    x = name(x, 628, register_colour, "registers");
    name(x, 628, control_colour, "control");
    text(40, 658,
         fmt::format(
             "Memory: weights {}, links {}, states {}, biases {}, norms and reciprocals {}, accumulators {}. "
             "Subtractors of dividers: {} bits.",
             grouped(memory_.weights), grouped(memory_.links), grouped(memory_.states),
             grouped(memory_.biases), grouped(memory_.norms + memory_.reciprocals), grouped(memory_.sums),
             grouped(divider_bits(a_, t_))),
         R"( font-size="12" fill="#666")");
  }

  const spec::ArraySpec& a_;
  const spec::Topology& t_;
  const spec::Formats f_;
  const Parts parts_;
  const MemoryBits memory_;
};

} // namespace

std::string machine_picture(const spec::ArraySpec& array, const spec::Topology& topology,
                            const std::string& scene) {
  return MachineDrawing(array, topology, scene).finish();
}

} // namespace hopmesh::machine
