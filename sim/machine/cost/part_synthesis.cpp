#include "sim/machine/cost/part_synthesis.h"

#include "sim/machine/rtl/rtl_text.h"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <mutex>
#include <regex>
#include <sstream>

namespace hopmesh::machine {

namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double clock_mhz = 100; ///< at which OpenSTA tells watts

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

/// Of a module whose name was made by yosys, for its scripts.
std::string module_called(const std::string& list, const std::string& name) {
  std::istringstream lines(list);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t from = line.find_first_not_of(' ');
    if (from == std::string::npos) continue;
    std::string module = line.substr(from);
    if (module == name ||
        (module.size() > name.size() && module.substr(module.size() - name.size() - 1) == "\\" + name))
      return module;
  }
  return "";
}

double sum_of(const std::map<std::string, double>& cells, const std::string& pattern) {
  const std::regex names(pattern);
  double sum = 0;
  for (const auto& [name, count] : cells)
    if (std::regex_match(name, names)) sum += count;
  return sum;
}

/// The last number behind `word` at the beginning of a line; `column` counts numbers.
std::vector<double> numbers_behind(const std::string& text, const std::string& word, std::size_t column) {
  std::vector<double> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first;
    if (!(words >> first) || first != word) continue;
    double number = nan;
    for (std::size_t k = 0; k <= column; ++k) words >> number;
    found.push_back(number);
  }
  return found;
}

class PartMeasurer {
 public:
  PartMeasurer(const fs::path& design, const CostTools& tools)
      : tools_(tools), design_(design), folder_(design / "cost") {
    fs::create_directories(folder_);
    for (PartFigures& part : result.parts) part.fill(nan);
  }

  bool elaborate();
  void measure(Part part, Target target);

  Synthesis result;

 private:
  std::string stem(Part part, Target target) const {
    return fmt::format("{}-{}", part_names[static_cast<std::size_t>(part)],
                       target_names[static_cast<std::size_t>(target)]);
  }
  std::string opening(Part part) const;
  bool yosys(const std::string& name, const std::string& script) const;
  bool weigh(const std::string& name, PartFigures& figures) const;
  bool synthesise(const std::string& name, Part part, Target target, bool dsp, PartFigures& figures) const;
  void read_cells(const std::string& name, Target target, PartFigures& figures) const;

  const CostTools& tools_;
  const fs::path design_, folder_;
  std::string element_, stage_;
  std::mutex mutex_;
};

bool PartMeasurer::yosys(const std::string& name, const std::string& script) const {
  write(folder_ / (name + ".ys"), script);
  return run_tool({tools_.yosys, "-q", "-s", "cost/" + name + ".ys"}, design_, "cost/" + name + ".log") == 0;
}

bool PartMeasurer::elaborate() {
  std::string script;
  for (const std::string& file : rtl_files()) script += "read_verilog -sv -Irtl " + file + "\n";
  script += "blackbox hm_ram hm_rom\nhierarchy -top hopmesh_axi_top\nproc\ntee -q -o cost/modules.txt ls\n"
            "write_rtlil cost/parts.il\n";
  if (!yosys("parts", script)) return false;
  const std::string modules = file_text(folder_ / "modules.txt");
  element_ = module_called(modules, "hm_element");
  stage_ = module_called(modules, "hm_stage");
  return !element_.empty() && !stage_.empty();
}

std::string PartMeasurer::opening(Part part) const {
  std::string text = "read_rtlil cost/parts.il\n";
  if (part == Part::rest) text += fmt::format("blackbox {} {}\n", element_, stage_);
  const std::string top = part == Part::rest ? "hopmesh_axi_top" : part == Part::element ? element_ : stage_;
  return text + fmt::format("hierarchy -top {}\nrename -top part\n", top);
}

void PartMeasurer::read_cells(const std::string& name, Target target, PartFigures& figures) const {
  const std::string text = file_text(folder_ / (name + ".stat"));
  const std::map<std::string, double> cells = cells_of_stat(text);
  const auto set = [&](Figure figure, double value) { figures[static_cast<std::size_t>(figure)] = value; };
  if (target == Target::ecp5) {
    set(Figure::ecp5_lut4, sum_of(cells, "LUT4"));
    set(Figure::ecp5_carry, sum_of(cells, "CCU2C"));
    set(Figure::ecp5_ff, sum_of(cells, "TRELLIS_FF"));
    set(Figure::ecp5_dsp, sum_of(cells, "MULT18X18D"));
  } else if (target == Target::ice40) {
    set(Figure::ice40_lut4, sum_of(cells, "SB_LUT4"));
    set(Figure::ice40_carry, sum_of(cells, "SB_CARRY"));
    set(Figure::ice40_ff, sum_of(cells, "SB_DFF.*"));
    set(Figure::ice40_dsp, sum_of(cells, "SB_MAC16"));
  } else {
    std::smatch area;
    static const std::regex words("Chip area for (?:top )?module '\\\\part': ([0-9.]+)");
    if (std::regex_search(text, area, words)) set(Figure::um2, std::stod(area[1]));
  }
}

// Watts at 100 MHz times 10 ns are joules a clock.
bool PartMeasurer::weigh(const std::string& name, PartFigures& figures) const {
  std::string script = fmt::format("read_liberty {}\nread_verilog cost/{}.v\nlink_design part\n"
                                   "create_clock -name clock -period 10 {{clock}}\nreport_checks -digits 4\n",
                                   tools_.liberty, name);
  for (const char* activity : {"0", "0.25"})
    script +=
        fmt::format("set_power_activity -input -activity {} -duty 0.5\nreport_power -digits 6\n", activity);
  write(folder_ / (name + ".tcl"), script);
  const std::string log = "cost/" + name + ".sta";
  if (run_tool({tools_.sta, "-exit", "cost/" + name + ".tcl"}, design_, log) != 0) return false;
  const std::string text = file_text(design_ / log);
  const std::vector<double> watts = numbers_behind(text, "Total", 3);
  std::smatch path;
  static const std::regex arrival("([0-9.]+) +data arrival time");
  if (watts.size() < 2 || !std::regex_search(text, path, arrival)) return false;
  const double to_pj = 1e12 / (clock_mhz * 1e6);
  figures[static_cast<std::size_t>(Figure::path_ns)] = std::stod(path[1]);
  figures[static_cast<std::size_t>(Figure::idle_pj)] = watts[0] * to_pj;
  figures[static_cast<std::size_t>(Figure::active_pj)] = (watts[1] - watts[0]) * to_pj;
  return true;
}

// Buffers where a signal goes to many, which only a driving cell makes abc think of.
bool PartMeasurer::synthesise(const std::string& name, Part part, Target target, bool dsp,
                              PartFigures& figures) const {
  std::string script = opening(part);
  if (target == Target::ecp5)
    script += fmt::format("synth_ecp5 -top part\ntee -q -o cost/{}.stat stat\n", name);
  else if (target == Target::ice40)
    script += fmt::format("synth_ice40 {}-top part\ntee -q -o cost/{}.stat stat\n", dsp ? "-dsp " : "", name);
  else {
    write(folder_ / "drive.xdc", "set_driving_cell INVX1\nset_load 0.1 [all_outputs]\n");
    script += fmt::format("synth -flatten -top part\ndfflibmap -liberty {0}\n"
                          "abc -liberty {0} -constr cost/drive.xdc -D 8000\nopt_clean -purge\n"
                          "splitnets -ports\nsetundef -zero\nopt_clean -purge\n"
                          "tee -q -o cost/{1}.stat stat -liberty {0}\nwrite_verilog -noattr cost/{1}.v\n",
                          tools_.liberty, name);
  }
  if (!yosys(name, script)) return false;
  read_cells(name, target, figures);
  return target != Target::osu018 || weigh(name, figures);
}

void PartMeasurer::measure(Part part, Target target) {
  const std::string name = stem(part, target);
  PartFigures figures;
  figures.fill(nan);
  bool done = synthesise(name, part, target, true, figures);
  bool without = false;
  if (!done && target == Target::ice40) done = without = synthesise(name, part, target, false, figures);
  const std::lock_guard<std::mutex> lock(mutex_);
  result.without_dsp = result.without_dsp || without;
  if (!done) result.failed.push_back(name);
  for (std::size_t f = 0; f < figures.size(); ++f)
    if (!std::isnan(figures[f])) result.parts[static_cast<std::size_t>(part)][f] = figures[f];
}

} // namespace

std::map<std::string, double> cells_of_stat(const std::string& text) {
  const std::size_t whole = text.rfind("Number of cells:");
  std::map<std::string, double> cells;
  if (whole == std::string::npos) return cells;
  std::istringstream lines(text.substr(whole));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string name;
    double count = 0;
    if (!(words >> name >> count)) break;
    cells[name] = count;
  }
  return cells;
}

Synthesis synthesise_parts(const fs::path& design, const CostTools& tools, const std::set<Target>& targets,
                           std::size_t workers, const std::function<void(const std::string&)>& tell) {
  PartMeasurer parts(design, tools);
  if (tools.yosys.empty()) return parts.result;
  tell("elaborating");
  if (!parts.elaborate()) {
    parts.result.failed.emplace_back("elaboration");
    return parts.result;
  }
  std::vector<std::function<void()>> jobs;
  for (const Target target : targets)
    for (const Part part : {Part::rest, Part::stage, Part::element})
      jobs.emplace_back([&parts, &tell, part, target] {
        parts.measure(part, target);
        tell(fmt::format("{} for {}", part_names[static_cast<std::size_t>(part)],
                         target_names[static_cast<std::size_t>(target)]));
      });
  do_jobs(jobs, workers);
  return parts.result;
}

} // namespace hopmesh::machine
