#include "sim/machine/cost/placement.h"

#include "sim/machine/rtl/rtl_text.h"

#include <fmt/format.h>
#include <fstream>
#include <regex>
#include <sstream>

namespace hopmesh::machine {

namespace {

namespace fs = std::filesystem;

struct Device {
  const char *name, *package;
  bool dsp;
};
constexpr Device devices[] = {{"up5k", "sg48", true}, {"hx8k", "ct256", false}};

// All signals but the clock go by way of two pins.
constexpr const char* harness =
    R"(module hopmesh_pins (input wire clock, input wire pin_in, output reg pin_out);
  reg [110:0] in;
  reg [44:0] out;
  wire [44:0] now;
  always @(posedge clock) begin
    in <= {in[109:0], pin_in};
    out <= now;
    pin_out <= ^out;
  end
  hopmesh_axi_top design (
      .clock(clock), .reset_n(in[0]), .awvalid(in[1]), .awready(now[0]), .awaddr(in[33:2]), .wvalid(in[34]),
      .wready(now[1]), .wdata(in[66:35]), .wstrb(in[70:67]), .bvalid(now[2]), .bready(in[71]), .bresp(now[4:3]),
      .arvalid(in[72]), .arready(now[5]), .araddr(in[104:73]), .rvalid(now[6]), .rready(in[105]),
      .rdata(now[38:7]), .rresp(now[40:39]), .irq(now[41])
  );
  assign now[44:42] = in[110:108];
endmodule
)";

double used(const std::string& log, const std::string& what, double* of = nullptr) {
  const std::regex words(what + R"(: +([0-9]+)/ *([0-9]+))");
  std::smatch part;
  if (!std::regex_search(log, part, words)) return 0;
  if (of) *of = std::stod(part[2]);
  return std::stod(part[1]);
}

double last_mhz(const std::string& log) {
  static const std::regex words(R"(Max frequency for clock[^:]*: +([0-9.]+) MHz)");
  double mhz = 0;
  for (std::sregex_iterator k(log.begin(), log.end(), words), end; k != end; ++k) mhz = std::stod((*k)[1]);
  return mhz;
}

std::string first_error(const std::string& log) {
  static const std::regex words("ERROR: ([^\n]*)");
  std::smatch part;
  return std::regex_search(log, part, words) ? part[1].str() : "no answer";
}

class Placer {
 public:
  Placer(const fs::path& design, const CostTools& tools) : design_(design), tools_(tools) {
    fs::create_directories(design / "cost");
    std::ofstream(design / "cost" / "hopmesh_pins.v") << harness;
  }

  bool synthesise(bool dsp) const {
    std::string script;
    for (const std::string& file : rtl_files()) script += "read_verilog -sv -Irtl " + file + "\n";
    script += fmt::format(
        "read_verilog -sv cost/hopmesh_pins.v\nsynth_ice40 {}-top hopmesh_pins -json cost/{}.json\n",
        dsp ? "-dsp " : "", name(dsp));
    std::ofstream(design_ / "cost" / (name(dsp) + ".ys")) << script;
    return run_tool({tools_.yosys, "-q", "-s", "cost/" + name(dsp) + ".ys"}, design_,
                    "cost/" + name(dsp) + ".log") == 0;
  }
  std::string place(const Device& device, bool dsp, int seed) const {
    const std::string log = fmt::format("cost/{}-{}.log", device.name, seed);
    run_tool({tools_.nextpnr, fmt::format("--{}", device.name), "--package", device.package, "--json",
              "cost/" + name(dsp) + ".json", "--seed", std::to_string(seed), "--freq", "24",
              "--timing-allow-fail"},
             design_, log);
    return file_text(design_ / log);
  }

 private:
  static std::string name(bool dsp) { return dsp ? "placed-dsp" : "placed"; }

  const fs::path design_;
  const CostTools& tools_;
};

void read_use(const std::string& log, Placement& placement) {
  placement.cells = used(log, "ICESTORM_LC", &placement.of);
  placement.memories = used(log, "ICESTORM_RAM");
  placement.multipliers = used(log, "ICESTORM_DSP");
}

} // namespace

Placement place_on_ice40(const fs::path& design, const CostTools& tools, int seeds, std::size_t workers,
                         const std::function<void(const std::string&)>& tell) {
  const Placer placer(design, tools);
  Placement placement;
  for (const Device& device : devices) {
    tell(fmt::format("the whole for {}", device.name));
    placement = {};
    placement.device = device.name;
    bool dsp = device.dsp;
    if (!placer.synthesise(dsp)) {
      if (!dsp || !placer.synthesise(dsp = false)) {
        placement.why = "yosys failed";
        continue;
      }
      placement.without_dsp = true;
    }
    std::vector<std::string> logs(static_cast<std::size_t>(seeds));
    logs[0] = placer.place(device, dsp, 1);
    read_use(logs[0], placement);
    placement.fits = last_mhz(logs[0]) > 0;
    if (!placement.fits) {
      placement.why = first_error(logs[0]);
      continue;
    }
    std::vector<std::function<void()>> jobs;
    for (int seed = 2; seed <= seeds; ++seed)
      jobs.emplace_back(
          [&, seed] { logs[static_cast<std::size_t>(seed) - 1] = placer.place(device, dsp, seed); });
    do_jobs(jobs, workers);
    for (const std::string& log : logs)
      if (const double mhz = last_mhz(log); mhz > 0) placement.mhz.push_back(mhz);
    return placement;
  }
  return placement;
}

} // namespace hopmesh::machine
