// A point of a study and what came of it: a row of results.csv. A column is a member of PointRow (or of
// Point) and a line of all_result_columns; writer, charts, maps and docs walk these lines.
#pragma once

#include "sim/run/outcome.h"
#include "sim/study/stability_class.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace hopmesh::study {

/// A combination of the axes' places, with everything that runs it.
struct Point {
  std::size_t number = 0;
  std::string method;
  std::vector<std::string> labels; ///< one an axis
  std::vector<std::string> overrides;
  std::string command;
};

using Maybe = std::optional<double>;

struct PointRow {
  run::Outcome outcome = run::Outcome::crashed;
  Stability stability = Stability::stable;
  std::uint64_t steps = 0, sweeps = 0, cycles = 0, bus_cycles = 0, multiplies = 0;
  std::uint64_t memory_bits = 0, multiplier_bits = 0, divider_bits = 0;
  double array_seconds = 0, host_seconds = 0, largest_strain = 0, omega = 0;
  Maybe output_error, output_error_median, rounding_error, rounding_error_median, stopping_error;
  Maybe stopping_error_median, position_error;
  std::vector<Maybe> reference_at, truth_at, floor_at, sensitivity_at; ///< [times of the study]
  Maybe hardware_seconds, instructions, utilisation, utilisation_with_bus, area_kge, energy_joule;
  std::string sentence;
};

/// Where a column's cell comes from. Labels have a column an axis, what was measured at the study's times has
/// a column a time.
using ResultFigure = std::variant<std::size_t Point::*, std::string Point::*,
                                  std::vector<std::string> Point::*, run::Outcome PointRow::*,
                                  Stability PointRow::*, std::uint64_t PointRow::*, double PointRow::*,
                                  Maybe PointRow::*, std::vector<Maybe> PointRow::*, std::string PointRow::*>;

/// In a chart errors stand along x, the last one that says anything unless told otherwise, and work along y.
enum class Role { other, error, work };

struct ResultColumn {
  const char *name, *unit;
  const char* words; ///< its meaning, as the docs print it
  ResultFigure figure;
  Role role = Role::other;
};

/// In the order of the file.
inline constexpr ResultColumn all_result_columns[] = {
    {"point", "", "its number, from 0", &Point::number},
    {"axis", "", "its label", &Point::labels},
    {"method", "", "that ran it", &Point::method},
    {"status", "", "`finished`, `diverged`, `crashed` or `failed`", &PointRow::outcome},
    {"class", "", "what became of the motion, in a word: see [stability](#stability)", &PointRow::stability},
    {"output_error", "", "rms of V against the reference's rest of the same step, over all steps and neurons",
     &PointRow::output_error, Role::error},
    {"output_error_median", "", "rms of V over neurons, of the median step", &PointRow::output_error_median,
     Role::error},
    {"rounding_error", "",
     "the words' part of it: rms of V against the reference after as many sweeps as the array did, over all "
     "steps and neurons",
     &PointRow::rounding_error, Role::error},
    {"rounding_error_median", "", "of the median step", &PointRow::rounding_error_median, Role::error},
    {"stopping_error", "",
     "the part of where steps stopped: rms of the reference after these sweeps against its rest, over all "
     "steps and neurons",
     &PointRow::stopping_error, Role::error},
    {"stopping_error_median", "", "of the median step", &PointRow::stopping_error_median, Role::error},
    {"position_error", "m", "rms of positions against the free motion of the reference, at the end",
     &PointRow::position_error, Role::error},
    {"reference_error", "m", "rms of positions against the free motion of the reference, at time T",
     &PointRow::reference_at, Role::error},
    {"truth_error", "m", "rms of positions against the truth, at time T", &PointRow::truth_at, Role::error},
    {"truth_floor", "m",
     "what two independent solutions of the truth differ by: an error below it means nothing",
     &PointRow::floor_at},
    {"sensitivity", "m",
     "what two references that start a last place apart differ by at time T: an error below it is luck",
     &PointRow::sensitivity_at},
    {"steps", "", "done in all", &PointRow::steps},
    {"sweeps", "", "of all steps", &PointRow::sweeps, Role::work},
    {"cycles", "", "of the array, in all", &PointRow::cycles, Role::work},
    {"bus_cycles", "", "that the host held the bus, in all", &PointRow::bus_cycles, Role::work},
    {"hardware_seconds", "s",
     "cycles of array and bus together at the array's clock, and with `host.processor = \"rv32\"` its "
     "instructions at its own; of this machine's processor as host the part is not known, and in no figure; "
     "empty for methods that are no array",
     &PointRow::hardware_seconds, Role::work},
    {"instructions", "", "of an emulated host, in all; empty where nobody counts them",
     &PointRow::instructions, Role::work},
    {"array_seconds", "s", "the array's part of it, without the bus", &PointRow::array_seconds, Role::work},
    {"host_seconds", "s",
     "processor time of this machine (all threads) for the motion alone, without the reference's judgement "
     "of "
     "its steps; of an array it is that of the emulation. The one column that differs from run to run",
     &PointRow::host_seconds, Role::work},
    {"multiplies", "",
     "of all sweeps of an array (0 for other methods): one for each input, one for R·u, one by the "
     "reciprocal where there is one",
     &PointRow::multiplies, Role::work},
    {"utilisation", "",
     "cycles of multipliers that multiply weights, over all that the accumulators' multipliers have while "
     "the "
     "array works; empty for methods that are no array",
     &PointRow::utilisation},
    {"utilisation_with_bus", "", "the same over the cycles of array and bus",
     &PointRow::utilisation_with_bus},
    {"memory_bits", "",
     "weights, biases, states, links with all copies and banks, norms, reciprocals, accumulators",
     &PointRow::memory_bits},
    {"multiplier_bits", "", "of all multipliers, width times width: w·L, R·u, and s by the reciprocal",
     &PointRow::multiplier_bits},
    {"divider_bits", "", "of the subtractors of dividers", &PointRow::divider_bits},
    {"area_kge", "kGE",
     "logic and memories in OSU's 0.18 um cells by the fitted model, in thousands of gates; empty for "
     "methods "
     "that are no array",
     &PointRow::area_kge, Role::work},
    {"energy_joule", "J", "of array and bus in that technology, by the model; the host's own is in no figure",
     &PointRow::energy_joule, Role::work},
    {"largest_strain", "", "over the motion", &PointRow::largest_strain},
    {"omega", "1/s", "of the stiffest wave of the mesh at the start", &PointRow::omega},
    {"sentence", "", "how it ended", &PointRow::sentence},
    {"command", "", "that repeats the point", &Point::command}};

} // namespace hopmesh::study
