// What an array costs: measured by tools where they are installed, else by the fitted model; every figure
// says which.
#pragma once

#include "sim/levels/prepared.h"
#include "sim/run/machine_info.h"

#include <filesystem>
#include <functional>

namespace hopmesh::run {

struct CostOrder {
  StepLoad step;       ///< whose energy is told
  bool measure = true; ///< by tools, where they are
  bool place = true;   ///< on an iCE40, which may take minutes
  std::size_t workers = 1;
  std::filesystem::path out; ///< for cost.json and what tools write; empty: neither stays
};

struct CostReport {
  std::vector<FigureTable> tables;
  std::string json;  ///< the same figures as an object
  std::string point; ///< the measured parts, as a line of points.csv under its heading; empty: not measured
  std::vector<std::string> notes; ///< which tools are missing, what could not be measured
};

/// `tell`: what is being measured, from any thread. Throws files::WriteError.
CostReport array_cost(const levels::Prepared& prepared, const CostOrder& order,
                      const std::function<void(const std::string&)>& tell);

/// Of the model alone: for info, and the columns of a study.
FigureTable cost_table(const spec::ArraySpec& array, const spec::Topology& topology, const StepLoad& step);

} // namespace hopmesh::run
