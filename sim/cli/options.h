// What the verbs have in common: scene, array, overrides, levels; and one function a verb.
#pragma once

#include "sim/levels/waves/wave_request.h"
#include "sim/engine/engine.h"
#include "sim/scene/scene_file.h"
#include "sim/levels/array_motion.h"
#include "sim/levels/reference_motion.h"

#include <CLI/CLI.hpp>

namespace hopmesh::cli {

/// Exit codes of the program.
enum Exit : int { done = 0, differs = 1, bad_input = 2, interrupted = 130 };

struct CommonOptions {
  std::string scene, array;
  std::vector<std::string> overrides;
};

/// SCENE, --array, --set.
void add_common(CLI::App& verb, CommonOptions& options);
/// The same as a shell takes them back.
std::string words_of(const CommonOptions& options);
/// A word in quotes where a shell would ask for them.
std::string shell_word(const std::string& word);

/// A check for counts: an integer from `least` to `most` (a billion: as many steps as a scene may have),
/// refused in words that fit a line.
CLI::Validator whole_number(std::int64_t least, std::int64_t most = 1'000'000'000);
/// The same for a number above 0.
CLI::Validator positive_number();

/// out/NAME; a slash in a name must not lead elsewhere.
std::string default_folder(std::string name);

/// Reads and checks everything, the array's rules for this very mesh included. Throws scene::InputError.
struct Prepared {
  scene::Inputs inputs;
  std::unique_ptr<levels::BuiltMesh> mesh;
};
Prepared prepare(const CommonOptions& options);

/// A level made ready to move a mesh. `array` and `port` are null for the reference.
struct Level {
  std::string name;
  std::unique_ptr<levels::ArrayPort> port;
  std::unique_ptr<levels::Motion> motion;
  levels::ArrayMotion* array = nullptr;
};

/// What a level's array may be asked beside its bits: a wave, threads (engine).
struct PortRequest {
  levels::WaveRequest wave;
  engine::Options engine;
  bool quiet = false; ///< no word on what only costs time: a study would say it for each point
};

/// reference, engine, systemc, systemc-clock.
const std::vector<std::string>& level_names();
/// Those and the rivals: everything that can fly a scene.
std::vector<std::string> method_names();
/// Throws scene::InputError for a name that is none of `names`; `flag` is where it stood.
void check_level(const std::string& name, const std::string& flag, const std::vector<std::string>& names);
/// Throws scene::InputError for a name that no problem has; `where` it stood.
void check_problem(const std::string& name, const std::string& where);
/// The array of a level that is not the reference. What the engine says about its kernel goes to stderr.
std::unique_ptr<levels::ArrayPort> make_port(const std::string& level, const spec::ArraySpec& array,
                                            const spec::Topology& topology, const PortRequest& request);
/// A level or a rival.
Level make_level(const std::string& name, const Prepared& prepared, bool check, const PortRequest& request);

void add_run(CLI::App& program, int& exit_code);
void add_compare(CLI::App& program, int& exit_code);
void add_network(CLI::App& program, int& exit_code);
void add_solvers(CLI::App& program, int& exit_code);
void add_info(CLI::App& program, int& exit_code);
void add_vectors(CLI::App& program, int& exit_code);
void add_fuzz(CLI::App& program, int& exit_code);
void add_sweep(CLI::App& program, int& exit_code);
void add_chart(CLI::App& program, int& exit_code);
void add_stability(CLI::App& program, int& exit_code);
void add_solve(CLI::App& program, int& exit_code);
void add_problem(CLI::App& program, int& exit_code);
void add_budget(CLI::App& program, int& exit_code);
void add_size(CLI::App& program, int& exit_code);

} // namespace hopmesh::cli
