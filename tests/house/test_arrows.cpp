// Arrows between rooms go one way: each #include "..." line is held against a table.
#include "tests/house/tree.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>

namespace hopmesh::tests {
namespace {

using Rooms = std::set<std::string>;

// Who may include whom, beside itself. Engine, systemc and reference never meet: engine and systemc share the
// facts (spec), never the arithmetic, and the reference knows of no array at all, so that their agreement is
// evidence. Nobody includes cli; tests may include anything.
const std::map<std::string, Rooms> allowed = {
    {"firmware", {}},
    {"rtl_model/spec", {"firmware/registers.h"}},
    {"rtl_model/systemc", {"rtl_model/spec", "firmware/registers.h"}},
    {"rtl_model/describe", {"firmware/registers.h"}},
    {"rtl_model/verilog", {}},
    {"sim/input", {"rtl_model/spec"}},
    {"sim/scene", {"rtl_model/spec", "sim/input"}},
    {"sim/reference", {"sim/scene"}},
    {"sim/rivals", {"sim/scene"}},
    {"sim/engine", {"rtl_model/spec", "firmware/registers.h", "firmware/host_bus.h"}},
    {"sim/files", {"sim/input"}},
    {"sim/pictures", {"sim/files"}},
    {"sim/machine", {"rtl_model/spec", "sim/input", "sim/pictures"}},
    {"sim/levels",
     {"rtl_model/spec", "rtl_model/systemc", "firmware", "sim/input", "sim/scene", "sim/reference",
      "sim/rivals", "sim/engine", "sim/files", "sim/machine"}},
    {"sim/run",
     {"rtl_model/spec", "sim/input", "sim/scene", "sim/files", "sim/pictures", "sim/machine", "sim/levels"}},
    {"sim/cosim", {"rtl_model/spec", "sim/input", "sim/files", "sim/levels", "sim/run"}},
    {"sim/networks", {"rtl_model/spec", "sim/input", "sim/files", "sim/pictures", "sim/levels", "sim/run"}},
    {"sim/study",
     {"rtl_model/spec", "sim/input", "sim/scene", "sim/files", "sim/pictures", "sim/machine", "sim/levels",
      "sim/run"}},
    {"sim/cli",
     {"sim/input", "sim/scene", "sim/input/standard_streams.h", "sim/levels", "sim/run", "sim/cosim",
      "sim/networks", "sim/study"}},
};

// The machines of the engine: who may include whom. All of them may include the engine's root; of the root,
// only choose.cpp includes machines. The clock-stepped machine computes with the generic one's arithmetic.
const std::map<std::string, Rooms> machines = {
    {"sim/engine/generic", {}},
    {"sim/engine/kernels", {}},
    {"sim/engine/clocked", {"sim/engine/generic"}},
};

// Oracles judge the models, so they derive everything by themselves from the pages: what the files whose
// paths begin so may reach, beside each other. Of spec that is the description of an array and its order of
// firing, and none of the facts that models share beyond that.
const std::map<std::string, Rooms> oracles = {
    {"tests/support/slow_",
     {"rtl_model/spec/number_format.h", "rtl_model/spec/array_modes.h", "rtl_model/spec/array_spec.h",
      "rtl_model/spec/relaxation.h", "rtl_model/spec/topology.h", "rtl_model/spec/colouring.h",
      "rtl_model/spec/schedule.h", "sim/cosim/array_job.h"}},
    {"tests/other_core/", {}},
};

// Which rooms may know a library from outside. Firmware knows none but <stdint.h>.
const std::vector<std::pair<std::regex, Rooms>> libraries = {
    {std::regex("systemc|tlm.*|sysc/.*"), {"rtl_model/systemc", "sim/levels", "sim/cli"}},
    {std::regex("Eigen/.*"), {"sim/reference", "sim/rivals", "sim/levels", "sim/networks"}},
    {std::regex("(cvode|nvector|sun.*)/.*"), {"sim/rivals"}},
    {std::regex("CLI/.*"), {"sim/cli"}},
    {std::regex("toml.*"), {"sim/input"}},
    {std::regex("png\\.h|tiny_gltf\\.h"), {"sim/files", "sim/pictures"}},
};

// The firmware's units by floor: a unit includes only units of floors below it. What all formulations of a
// step stand on knows none of them.
const std::vector<Rooms> firmware_floors = {{"register_fields"},
                                            {"bus", "registers", "doubles"},
                                            {"host_bus", "try"},
                                            {"network", "quantise"},
                                            {"springs", "relax", "window"},
                                            {"driver", "time_step", "residual"},
                                            {"formulation"},
                                            {"incremental"},
                                            {"refine"},
                                            {"probe", "implicit", "static"},
                                            {"integrator"}};

// Written by CMake when the build is configured, and by Verilator when a model is made.
const std::set<std::string> generated = {"version.h", "place.h", "Vhm.h", "Vhm___024root.h", "verilated.h"};

std::string room_of(const std::string& path) {
  static const std::regex shape("(firmware|(?:rtl_model|sim)/[^/]+|tests)/.*");
  std::smatch part;
  return std::regex_match(path, part, shape) ? part[1].str() : "";
}

bool may_include(const std::string& room, const std::string& included) {
  const std::string other = room_of(included);
  if (room == "tests") return true;
  const Rooms& others = allowed.at(room);
  return other == room || others.count(other) || others.count(included);
}

/// "" for a file that belongs to no machine of the engine.
std::string machine_of(const std::string& path) {
  const std::string folder = path.substr(0, path.rfind('/'));
  return machines.count(folder) ? folder : "";
}

/// Asked of files of the engine.
bool may_include_machine(const std::string& path, const std::string& included) {
  const std::string own = machine_of(path), other = machine_of(included);
  if (other.empty() || other == own) return true;
  return own.empty() ? path == "sim/engine/choose.cpp" : machines.at(own).count(other) > 0;
}

bool may_know(const std::string& room, const std::string& header) {
  if (room == "tests") return true;
  if (room == "firmware") return header == "stdint.h";
  for (const auto& [name, rooms] : libraries)
    if (std::regex_match(header, name)) return rooms.count(room) > 0;
  return true;
}

std::vector<std::string> includes_of(const std::string& text) {
  static const std::regex own("\\s*#\\s*include\\s*\"([^\"]+)\".*");
  std::vector<std::string> included;
  std::smatch part;
  for (const std::string& line : lines_of(text))
    if (std::regex_match(line, part, own)) included.push_back(part[1]);
  return included;
}

/// Everything that a file includes, and what that includes in turn.
void reach(const std::string& path, Rooms& reached) {
  for (const std::string& included : includes_of(text_of(path)))
    if (reached.insert(included).second) reach(included, reached);
}

/// What of all that an oracle reaches it may not.
Rooms out_of_bounds(const std::string& oracle, const Rooms& reached) {
  Rooms refused;
  for (const std::string& path : reached)
    if (!starts_with(path, oracle) && oracles.at(oracle).count(path) == 0) refused.insert(path);
  return refused;
}

void judge_include(const TreeFile& file, const std::string& included) {
  if (generated.count(included)) return;
  EXPECT_FALSE(room_of(included).empty())
      << file.path << ": \"" << included << "\" is not written from the root of the tree";
  EXPECT_TRUE(may_include(room_of(file.path), included)) << file.path << " includes " << included;
  EXPECT_TRUE(room_of(file.path) != "sim/engine" || may_include_machine(file.path, included))
      << file.path << " includes " << included;
}

/// Header and source; those of driver and network, which are long, have further parts.
std::string unit_of(const std::string& path) {
  const std::string stem = std::filesystem::path(path).stem().string();
  for (const char* const unit : {"driver", "network"})
    if (starts_with(stem, std::string(unit) + '_')) return unit;
  return stem;
}

std::size_t firmware_floor(const std::string& unit) {
  const auto has_unit = [&](const Rooms& floor) { return floor.count(unit) > 0; };
  const auto floor = std::find_if(firmware_floors.begin(), firmware_floors.end(), has_unit);
  return static_cast<std::size_t>(floor - firmware_floors.begin());
}

bool firmware_may_include(const std::string& file, const std::string& included) {
  return unit_of(file) == unit_of(included) ||
         firmware_floor(unit_of(file)) > firmware_floor(unit_of(included));
}

void judge_library(const TreeFile& file, const std::string& line) {
  static const std::regex outside("\\s*#\\s*include\\s*<([^>]+)>.*");
  std::smatch part;
  if (std::regex_match(line, part, outside)) {
    EXPECT_TRUE(may_know(room_of(file.path), part[1])) << file.path << " includes <" << part[1] << ">";
  }
}

TEST(Arrows, everyRoomIsInTheTable) {
  for (const TreeFile& file : tree_files({".h", ".c", ".cpp"}))
    EXPECT_TRUE(room_of(file.path) == "tests" || allowed.count(room_of(file.path))) << file.path;
}

TEST(Arrows, everyIncludeFollowsTheTable) {
  for (const TreeFile& file : tree_files({".h", ".c", ".cpp"})) {
    if (room_of(file.path) != "tests" && !allowed.count(room_of(file.path))) continue;
    for (const std::string& included : includes_of(file.text)) judge_include(file, included);
    for (const std::string& line : lines_of(file.text)) judge_library(file, line);
  }
}

// Each pair of rooms that know of each other is one more thing to keep in mind.
TEST(Arrows, joinAtMostFortyTwoPercentOfThePairsOfRooms) {
  std::set<std::pair<std::string, std::string>> joined;
  for (const TreeFile& file : tree_files({".h", ".c", ".cpp"}))
    for (const std::string& included : includes_of(file.text)) {
      const std::string room = room_of(file.path), other = room_of(included);
      if (room != other && allowed.count(room) && allowed.count(other))
        joined.insert(std::minmax(room, other));
    }
  const std::size_t rooms = allowed.size(), pairs = rooms * (rooms - 1) / 2;
  EXPECT_GT(joined.size(), rooms);
  EXPECT_LE(100 * joined.size(), 42 * pairs) << joined.size() << " of " << pairs;
}

TEST(Arrows, oraclesDeriveEverythingByThemselves) {
  for (const auto& [oracle, facts] : oracles) {
    Rooms reached;
    std::size_t files = 0;
    for (const TreeFile& file : tree_files({".h", ".cpp"}))
      if (starts_with(file.path, oracle)) reach(file.path, reached), files += 1;
    EXPECT_GT(files, 0u) << oracle;
    EXPECT_EQ(out_of_bounds(oracle, reached), Rooms{}) << oracle;
  }
}

TEST(Arrows, firmwareUnitsIncludeOnlyWhatIsBelowThem) {
  for (const TreeFile& file : tree_files({".h", ".c"})) {
    if (room_of(file.path) != "firmware") continue;
    EXPECT_LT(firmware_floor(unit_of(file.path)), firmware_floors.size()) << file.path;
    for (const std::string& included : includes_of(file.text))
      EXPECT_TRUE(firmware_may_include(file.path, included)) << file.path << " includes " << included;
  }
}

TEST(Arrows, theTableRefusesWhatItShould) {
  EXPECT_FALSE(firmware_may_include("firmware/springs.c", "firmware/formulation.h"));
  EXPECT_FALSE(firmware_may_include("firmware/probe.c", "firmware/static.h"));
  EXPECT_TRUE(firmware_may_include("firmware/integrator.c", "firmware/formulation.h"));
  EXPECT_EQ(out_of_bounds("tests/support/slow_", {"rtl_model/spec/points.h", "rtl_model/spec/schedule.h"}),
            Rooms{"rtl_model/spec/points.h"});
  EXPECT_EQ(out_of_bounds("tests/other_core/", {"rtl_model/spec/array_spec.h"}),
            Rooms{"rtl_model/spec/array_spec.h"});
  EXPECT_FALSE(may_include("sim/reference", "rtl_model/spec/array_spec.h"));
  EXPECT_FALSE(may_include("rtl_model/spec", "firmware/driver.h"));
  EXPECT_FALSE(may_include("rtl_model/systemc", "firmware/driver.h"));
  EXPECT_TRUE(may_include("rtl_model/systemc", "firmware/registers.h"));
  EXPECT_FALSE(may_include("sim/reference", "rtl_model/systemc/device.h"));
  EXPECT_FALSE(may_include("sim/study", "sim/cli/options.h"));
  for (const char* above : {"sim/run", "sim/cosim", "sim/networks", "sim/study", "sim/cli"})
    for (const char* model : {"firmware/registers.h", "rtl_model/systemc/device.h", "sim/engine/engine.h",
                              "sim/reference/reference.h", "sim/rivals/truth.h"})
      EXPECT_FALSE(may_include(above, model)) << above << ' ' << model;
  EXPECT_FALSE(may_include("sim/cli", "rtl_model/spec/array_rules.h"));
  EXPECT_FALSE(may_include("sim/cli", "sim/files/csv.h"));
  EXPECT_FALSE(may_include("sim/files", "tests/support/dut.h"));
  EXPECT_FALSE(may_include_machine("sim/engine/kernels/kernel.h", "sim/engine/generic/lane_arithmetic.h"));
  EXPECT_FALSE(may_include_machine("sim/engine/engine.cpp", "sim/engine/clocked/clocked.h"));
  EXPECT_TRUE(may_include_machine("sim/engine/clocked/clocked_beats.h", "sim/engine/generic/drive_path.h"));
  EXPECT_FALSE(may_know("sim/study", "systemc"));
  EXPECT_FALSE(may_know("firmware", "stdlib.h"));
  EXPECT_TRUE(may_know("sim/study", "vector"));
}

} // namespace
} // namespace hopmesh::tests
