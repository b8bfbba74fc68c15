#include "sim/machine/timeline_picture.h"

#include "sim/pictures/svg_canvas.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::machine {

namespace {

using pictures::Box;

constexpr const char *bus_colour = "#d55e00", *prepare_colour = "#e69f00", *sweep_colour = "#0072b2",
                     *busy_colour = "#009e73", *idle_colour = "#e9edf1", *host_colour = "#8e5ea2",
                     *unknown = "url(#unknown)";
constexpr double lanes_left = 120, lanes_right = 970, stub = 46, lane_height = 30, lane_gap = 12;
constexpr double lanes_top = 112, shares_top = 368;
constexpr std::uint64_t most_runs = 12; ///< of more, the runs of a step are drawn as one

std::string duration(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.3g} us", 1e6 * seconds);
  return seconds < 1 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} s", seconds);
}

double part_of(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

/// 1, 2 or 5 times a power of ten: about six of them.
double step_along(double whole) {
  const double least = whole / 6, power = std::pow(10, std::floor(std::log10(least)));
  return power * (power >= least ? 1 : 2 * power >= least ? 2 : 5 * power >= least ? 5 : 10);
}

class TimelineDrawing : public pictures::SvgCanvas {
 public:
  explicit TimelineDrawing(const TimelineView& view)
      : SvgCanvas(1000, 520, lanes_left, view.title, view.note), view_(view) {
    put(R"svg(<defs><pattern id="unknown" width="7" height="7" patternUnits="userSpaceOnUse" )svg"
        R"svg(patternTransform="rotate(45)"><rect width="7" height="7" fill="#f4f4f4"/>)svg"
        R"svg(<rect width="2" height="7" fill="#b8b8b8"/></pattern></defs>)svg");
    draw_lanes();
    draw_shares();
    draw_legend();
  }

 private:
  static double lane_top(int lane) { return lanes_top + lane * (lane_height + lane_gap); }
  /// The host's time as cycles of the array's clock; 0 where it is not known.
  double host_cycles(const Timeline& t) const { return t.host_seconds.value_or(0) * view_.clock_mhz * 1e6; }
  /// Where the host's time is not known, stubs at the ends stand for it.
  double margin() const { return view_.step.host_seconds ? 0 : stub; }
  double at(double cycle) const {
    const double all =
        std::max(1.0, static_cast<double>(view_.step.time().cycles()) + host_cycles(view_.step));
    return lanes_left + margin() + cycle / all * (lanes_right - lanes_left - 2 * margin());
  }

  void bar(const Box& box, const char* colour, const std::string& tip) {
    put(R"(<rect class="part" x="{}" y="{}" width="{}" height="{}" fill="{}"><title>{}</title></rect>)",
        box.left, box.top, box.right - box.left, box.bottom - box.top, colour, pictures::escaped(tip));
  }
  void in_lane(int lane, double from, double to, const char* colour, const std::string& tip) {
    if (to > from) bar({at(from), lane_top(lane), at(to), lane_top(lane) + lane_height}, colour, tip);
  }

  void draw_lanes() {
    text(lanes_left, lanes_top - 18, view_.step_name, R"( font-size="15" font-weight="600")");
    const char* names[] = {"host", "bus", "array", "multipliers"};
    const auto whole = static_cast<double>(view_.step.time().cycles());
    for (int lane = 0; lane < 4; ++lane) {
      text(lanes_left - 12, lane_top(lane) + 20, names[lane], R"( text-anchor="end")");
      bar({lanes_left, lane_top(lane), lanes_right, lane_top(lane) + lane_height}, idle_colour, "waits");
    }
    draw_host();
    const double host = host_cycles(view_.step);
    const std::uint64_t runs = view_.runs > most_runs ? 1 : std::max<std::uint64_t>(1, view_.runs);
    for (std::uint64_t k = 0; k < runs; ++k) draw_run(host + whole * double(k) / double(runs), double(runs));
    draw_scale(host + whole);
  }

  void draw_host() {
    if (view_.step.host_seconds)
      return in_lane(0, 0, host_cycles(view_.step), host_colour,
                     "the host makes networks and moves the mesh, all of the step drawn as one: " +
                         duration(*view_.step.host_seconds));
    for (const double from : {lanes_left, lanes_right - stub})
      bar({from, lane_top(0), from + stub, lane_top(0) + lane_height}, unknown,
          "the host makes the network, and moves the mesh: how long that takes is not known");
  }

  /// A run out of so many, from its first cycle on.
  void draw_run(double from, double runs) {
    const Timeline& t = view_.step;
    const auto tell = [](const char* what, std::uint64_t cycles) {
      return fmt::format("{}: {} cycles", what, cycles);
    };
    const std::uint64_t load = t.bus - std::min(t.bus, view_.read);
    const double loaded = from + double(load) / runs, prepared = loaded + double(t.prepare) / runs;
    const double swept = prepared + double(t.sweeps) / runs, read = swept + double(t.bus - load) / runs;
    in_lane(1, from, loaded, bus_colour, tell("bus: load and start", load));
    in_lane(2, loaded, prepared, prepare_colour, tell("array: prepare", t.prepare));
    in_lane(2, prepared, swept, sweep_colour, tell("array: sweeps", t.sweeps));
    in_lane(1, swept, read, bus_colour, tell("bus: read back", t.bus - load));
    const double busy = lane_height * part_of(t.products, t.multipliers * t.sweeps);
    bar({at(prepared), lane_top(3) + lane_height - busy, at(swept), lane_top(3) + lane_height}, busy_colour,
        fmt::format("multipliers: {:.3g} % of them multiply while the array sweeps",
                    100 * busy / lane_height));
  }

  void draw_scale(double whole) {
    const Box box{lanes_left, lanes_top, lanes_right, lane_top(3) + lane_height};
    if (!(whole > 0)) return;
    const double step = step_along(whole);
    for (int k = 0; k * step <= whole; ++k) number_x(box, at(k * step), fmt::format("{:.6g}", k * step));
    text((lanes_left + lanes_right) / 2, box.bottom + 40,
         fmt::format("cycles of the array's clock; all {:.0f} of them take {}", whole,
                     duration(view_.step.time().seconds(view_.clock_mhz))),
         R"( text-anchor="middle")");
  }

  void draw_shares() {
    const Timeline& t = view_.motion;
    text(lanes_left, shares_top - 14,
         fmt::format("{}: {}", view_.motion_name, duration(t.time().seconds(view_.clock_mhz))),
         R"( font-size="15" font-weight="600")");
    const char* names[] = {t.host_seconds ? "all" : "bus and array", "multipliers"};
    const double whole = static_cast<double>(t.time().cycles()) + host_cycles(t);
    const auto share = [&](double cycles) { return whole > 0 ? cycles / whole : 0; };
    for (int k = 0; k < 2; ++k)
      text(lanes_left - 12, shares_top + k * (lane_height + lane_gap) + 20, names[k],
           R"( text-anchor="end")");
    double from = 0;
    if (t.host_seconds) from = draw_share(0, from, share(host_cycles(t)), host_colour, "host");
    from = draw_share(0, from, share(double(t.bus)), bus_colour, "bus");
    from = draw_share(0, from, share(double(t.prepare)), prepare_colour, "prepare");
    draw_share(0, from, share(double(t.sweeps)), sweep_colour, "sweeps");
    from = draw_share(1, 0, t.utilisation_with_bus() * share(double(t.time().cycles())), busy_colour,
                      "multiply");
    draw_share(1, from, 1 - from, idle_colour, "wait");
  }

  double draw_share(int row, double from, double share, const char* colour, const char* what) {
    const double top = shares_top + row * (lane_height + lane_gap), wide = lanes_right - lanes_left;
    const std::string words = fmt::format("{} {:.3g} %", what, 100 * share);
    bar({lanes_left + from * wide, top, lanes_left + (from + share) * wide, top + lane_height}, colour,
        words);
    if (share * wide > 8.0 * static_cast<double>(words.size()))
      text(lanes_left + (from + share / 2) * wide, top + 20, words,
           colour == idle_colour ? R"( text-anchor="middle")" : R"( text-anchor="middle" fill="#fff")");
    return from + share;
  }

  void draw_legend() {
    double x = lanes_left;
    x = name(x, 488, bus_colour, "bus");
    x = name(x, 488, prepare_colour, "array prepares");
    x = name(x, 488, sweep_colour, "array sweeps");
    x = name(x, 488, busy_colour, "multipliers that multiply");
    x = name(x, 488, idle_colour, "waits");
    if (view_.step.host_seconds)
      name(x, 488, host_colour, "host");
    else
      name(x, 488, unknown, "host: not known");
  }

  const TimelineView& view_;
};

} // namespace

std::string svg_of(const TimelineView& view) {
  return TimelineDrawing(view).finish();
}

} // namespace hopmesh::machine
