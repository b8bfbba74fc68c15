// From the files of a run to what its pictures need.
#pragma once

#include "sim/pictures/run_view.h"
#include "sim/run/run_facts.h"
#include "sim/run/run_totals.h"
#include "sim/run/simulation.h"

#include <filesystem>

namespace hopmesh::run {

inline constexpr std::size_t most_frames = 240;            ///< shown in the report; glTF takes fewer of them
inline constexpr std::size_t most_frame_bytes = 64u << 20; ///< of all frames together, but for two at least

inline constexpr std::size_t most_points = 4000;          ///< of a curve in the report
inline constexpr std::size_t most_report_nodes = 150'000; ///< finer meshes are drawn coarser there

/// The rows of positions.npy that the report shows: evenly, first and last included.
std::vector<std::size_t> rows_shown(std::size_t rows, std::size_t nodes);

/// What pictures of the mesh take off its places, which they keep in single precision: the middle of the mesh
/// as it starts, where that is far from the scene's origin; else nothing.
std::array<double, 3> picture_origin(const scene::Mesh& mesh);

/// Frames are read back from positions.npy.
pictures::RunView run_picture(const RunFacts& facts, const levels::BuiltMesh& mesh, const RunResult& result,
                              const std::filesystem::path& positions, std::string manifest);

/// Of so many steps the report's curves show one in this number, and the last.
std::size_t steps_a_point(const StepLog& rows);
StepRows rows_drawn(const StepLog& rows);

/// What a browser can bear: a mesh of more than most_report_nodes with its nodes merged, and told so.
pictures::RunView report_view(pictures::RunView view);

/// The curves of the columns, where the run has what they are about.
std::vector<pictures::Series> series_of(const RunFacts& facts, const StepRows& rows,
                                        const StepColumns& columns = step_columns());

/// "The run", "Accuracy" and "Codes seen": the figures that the end of a run prints.
std::vector<std::pair<std::string, std::vector<pictures::Figure>>>
run_tables(const RunFacts& facts, const levels::BuiltMesh& mesh, const RunResult& result,
           const std::vector<levels::SignalRange>& ranges);

} // namespace hopmesh::run
