// Waves that run along the cloth and grow away from the pole; the cloth sags a little at its free end.
#include "tests/pictures/sample_run.h"

#include <cmath>

namespace hopmesh::tests {
namespace {

using namespace pictures;

void add_mesh(RunView& view, std::size_t side) {
  const auto node = [side](std::size_t r, std::size_t c) { return static_cast<std::uint32_t>(r * side + c); };
  const auto corner = [&](std::size_t r, std::size_t c) {
    const float last = static_cast<float>(side - 1);
    return ViewCorner{node(r, c), static_cast<float>(c) / last, static_cast<float>(r) / last};
  };
  view.nodes = side * side;
  view.pinned.assign(view.nodes, false);
  for (std::size_t r = 0; r < side; ++r) view.pinned[node(r, 0)] = true;
  for (std::size_t r = 0; r < side; ++r)
    for (std::size_t c = 0; c < side; ++c) {
      if (c + 1 < side) view.springs.push_back({{node(r, c), node(r, c + 1)}, 1.0f});
      if (r + 1 < side) view.springs.push_back({{node(r, c), node(r + 1, c)}, 1.0f});
      if (r + 1 == side || c + 1 == side) continue;
      view.springs.push_back({{node(r, c), node(r + 1, c + 1)}, std::sqrt(2.0f)});
      view.springs.push_back({{node(r, c + 1), node(r + 1, c)}, std::sqrt(2.0f)});
      view.triangles.push_back({corner(r, c), corner(r + 1, c), corner(r + 1, c + 1)});
      view.triangles.push_back({corner(r, c), corner(r + 1, c + 1), corner(r, c + 1)});
    }
}

std::vector<float> flag_at(std::size_t side, double time) {
  std::vector<float> frame;
  const double start = 1.0 - std::exp(-time);
  for (std::size_t r = 0; r < side; ++r)
    for (std::size_t c = 0; c < side; ++c) {
      const double s = static_cast<double>(c) / static_cast<double>(side - 1);
      const double phase = 7.0 * s - 3.2 * time + 0.06 * static_cast<double>(r);
      const double x =
          static_cast<double>(c) * (1.0 - 0.05 * start * s) + 0.15 * start * s * std::sin(2 * phase);
      const double y = 2.3 * start * s * std::sin(phase);
      const double z = -static_cast<double>(r) - 2.6 * start * s * s + 0.3 * start * s * std::cos(phase);
      for (const double v : {x, y, z}) frame.push_back(static_cast<float>(v));
    }
  return frame;
}

void add_series(RunView& view, std::size_t steps) {
  std::vector<double> sweeps, cycles, energy, kinetic, strain, error;
  for (std::size_t k = 1; k <= steps; ++k) {
    const double t = 0.05 * static_cast<double>(k), calm = std::exp(-t / 4.0);
    view.step_times.push_back(t);
    sweeps.push_back(std::round(38 + 60 * calm + 6 * std::sin(3.2 * t)));
    cycles.push_back(sweeps.back() * 1224 + 96);
    energy.push_back(-412.0 + 300.0 * calm * (1.0 + 0.2 * std::cos(6.4 * t)));
    kinetic.push_back(40.0 * (1 - calm) * (1.0 + 0.3 * std::sin(6.4 * t)));
    strain.push_back(0.02 + 0.05 * calm + 0.008 * std::sin(3.2 * t));
    error.push_back(1e-6 * std::pow(10.0, 4.2 * (1 - calm)) * (1.2 + std::sin(2.1 * t)));
  }
  view.series = {{"sweeps", "", sweeps},    {"cycles", "", cycles},         {"energy", "J", energy},
                 {"kinetic", "J", kinetic}, {"largest strain", "", strain}, {"error", "m/s²", error}};
}

} // namespace

RunView sample_run(std::size_t side, std::size_t frames, std::size_t steps) {
  RunView view;
  view.title = "flag-400";
  view.subtitle = "SystemC level, 400 steps of 0.05 s, array paper-16, 400 cells, coloured schedule";
  view.outcome = "Done: 400 of 400 steps, every relaxation converged.";
  add_mesh(view, side);
  for (std::size_t f = 0; f < frames; ++f) {
    const double time = 20.0 * static_cast<double>(f) / static_cast<double>(frames > 1 ? frames - 1 : 1);
    view.frames.push_back(flag_at(side, time));
    view.frame_times.push_back(time);
    view.frame_steps.push_back(std::round(time / 0.05));
  }
  add_series(view, steps);
  view.tables = {
      {"The scene", {{"nodes", "400, of which 20 pinned"}, {"springs", "1482"}, {"time step", "0.05 s"}}},
      {"The array",
       {{"weights", "fixed<18,2,SC_RND_CONV,SC_SAT>"},
        {"activations", "fixed<16,4,SC_RND,SC_SAT>"},
        {"schedule", "coloured, 4 phases"},
        {"cycles per sweep", "1224"}}},
      {"Speed", {{"wall time", "12.4 s"}, {"steps", "32.3 per s"}, {"cycles simulated", "1.61 M per s"}}}};
  view.manifest = "{\n  \"version\": \"0.1.0\",\n  \"scene\": {\"name\": \"flag-400\"},\n  \"seed\": 1\n}\n";
  return view;
}

} // namespace hopmesh::tests
