// The table of levels: everything that can answer a step, what it can do, and how it is made. A new level is
// a row in level.cpp; nobody else compares names.
#pragma once

#include "sim/engine/engine.h"
#include "sim/levels/array_motion.h"
#include "sim/levels/prepared.h"
#include "sim/levels/waves/wave_request.h"

namespace hopmesh::levels {

/// What an array may be asked beside its bits: a wave, and threads of the engine.
struct PortRequest {
  WaveRequest wave;
  engine::Options engine;
  bool quiet = false;       ///< no word on what only costs time: a study would say it for each point
  bool all_threads = false; ///< as many as asked for, even where fewer would be faster
};

enum class Kind {
  reference, ///< the algorithm in double, sweep by sweep
  array,     ///< fixed-point, behind a bus
  rival      ///< another integrator of the scene, in double
};

/// One of several ways in which a level computes the same array.
struct Way {
  std::string name;
  engine::Options engine;
  std::uint64_t one_in = 1; ///< takes part in one of so many cases of a campaign
};

struct Level {
  std::string name;
  Kind kind;
  const char* words;    ///< for people, in a phrase
  bool can_resume;      ///< its runs go on from a checkpoint
  bool can_wave;        ///< its signals can be written to a wave
  bool checked;         ///< `run` asks the reference beside every step unless told otherwise
  bool made_ahead;      ///< all its arrays are made before one is used (SystemC elaborates once a process)
  std::uint64_t one_in; ///< slow: beside others, one of so many cases of a campaign
  /// Makes its array; null where there is none.
  std::unique_ptr<ArrayPort> (*make_port)(const spec::ArraySpec&, const spec::Topology&, const PortRequest&);
  std::vector<Way> (*ways)(); ///< for a campaign; null where there is one way only

  bool has_codes() const { return kind == Kind::array; }
  bool has_bus() const { return make_port != nullptr; }
};

/// In the order in which people are told of them.
const std::vector<Level>& levels();
/// The names of those of some kinds.
std::vector<std::string> level_names(std::initializer_list<Kind> kinds);
/// All of them: everything that can fly a scene.
std::vector<std::string> method_names();
/// The row of a name. Throws input::InputError where no level, or none of these kinds, has it; `flag` is
/// where it stood.
const Level& level_named(const std::string& name, const std::string& flag,
                         std::initializer_list<Kind> kinds = {Kind::reference, Kind::array, Kind::rival});
/// The level that runs when nobody names one, and the one that judges it.
const Level& default_level();
const Level& reference_row();

/// A level made ready to move a mesh. `array` and `port` are null where the level has no bus.
struct Ready {
  const Level* level = nullptr;
  std::unique_ptr<ArrayPort> port;
  std::unique_ptr<Motion> motion;
  ArrayMotion* array = nullptr;
};

/// `check`: ask the reference beside every step, where the level can. `prepared` must outlive it.
Ready make_ready(const Level& level, const Prepared& prepared, bool check, const PortRequest& request);

} // namespace hopmesh::levels
