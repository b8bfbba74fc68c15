// The table of levels: whoever can answer a step of a scene, what it can do, and how it is made. A new level
// is a port (array_port.h) and a row in level.cpp; nobody else compares names.
//
// What every level must do is no column: a run of any of them can be resumed (Mover::restore).
#pragma once

#include "rtl_model/spec/firing.h"
#include "sim/engine/engine.h"
#include "sim/levels/array_mover.h"
#include "sim/levels/prepared.h"
#include "sim/levels/waves/wave_request.h"

#include <functional>

namespace hopmesh::levels {

enum class Kind {
  reference, ///< the algorithm in double, sweep by sweep
  array,     ///< fixed-point, behind a bus
  rival      ///< another integrator of the scene, in double
};

/// What an array may be asked beside its bits.
struct PortRequest {
  WaveRequest wave;
  engine::Options engine;
  bool all_threads = false; ///< as many as asked for, even where fewer would be faster
  bool remarks = false;     ///< tells stderr what costs time and no bit; a study would say it at each point
  bool at_once = false; ///< nothing may be made ready for it that takes a while: a campaign has many arrays
};

/// A neuron of an array whose longest row has so many taps, laid open: any firing, one after the other.
using OpenNeuron = std::function<spec::FiringSteps(const spec::FiringInputs&)>;

/// A setting in which a level computes the same bits.
struct Variant {
  std::string name = {}; ///< "" for the only one
  engine::Options engine = {};
  std::uint64_t one_in = 1; ///< takes part in one of so many cases of a campaign
};

/// A level in one of its variants, as a campaign takes it.
struct Way {
  std::string name;
  /// Makes an array; null where this way cannot have it.
  std::function<std::unique_ptr<ArrayPort>(const spec::ArraySpec&, const spec::Topology&)> make;
  bool made_ahead = false;  ///< all arrays of a process are made before the first is used
  std::uint64_t one_in = 1; ///< takes part in one of so many cases of a campaign
};

/// A row of the table.
struct Level {
  std::string name;
  Kind kind = Kind::array;
  std::string words{}; ///< for people: what it is, in a phrase

  /// Makes its array; empty where there is none.
  std::function<std::unique_ptr<ArrayPort>(const spec::ArraySpec&, const spec::Topology&, const PortRequest&)>
      make_port = nullptr;
  /// Makes its motion of a scene; empty where make_port is not: an array moves a scene by the firmware.
  std::function<std::unique_ptr<Mover>(const Prepared&)> make_mover = nullptr;
  std::vector<Variant> variants = {{}};
  /// Lays one of its neurons open; empty where it cannot.
  std::function<OpenNeuron(const spec::ArraySpec&, std::size_t taps)> open_neuron = nullptr;

  bool can_wave = false;    ///< its registers can be written to a wave
  bool checked = true;      ///< `run` asks the reference beside every step, unless told otherwise
  bool made_ahead = false;  ///< all arrays of a process are made before the first is used
  std::uint64_t one_in = 1; ///< slow: in one of so many cases of a campaign, and in `compare` when named
  bool named_only = false;  ///< takes part where somebody names it
  /// Makes ready what takes a while, for networks of usual size; empty where nothing does.
  std::function<void(const spec::ArraySpec&)> make_ready = nullptr;

  bool has_codes() const { return kind == Kind::array; }
  bool has_bus() const { return make_port != nullptr; }
};

/// In the order in which people are told of them.
const std::vector<Level>& levels();

using Kinds = std::initializer_list<Kind>;
inline constexpr Kinds any_kind{Kind::reference, Kind::array, Kind::rival};
/// What relaxes a network sweep by sweep.
inline constexpr Kinds sweeping{Kind::reference, Kind::array};

std::vector<std::string> level_names(Kinds kinds = any_kind);
/// Those that `compare` holds beside each other when nobody says which: what sweeps and is not slow.
std::vector<std::string> compared_names();
/// Those that a campaign holds beside each other then.
std::vector<std::string> campaign_names();

/// The row of a name. Throws input::InputError where no level of these kinds has it; `where` it stood.
const Level& level_named(const std::string& name, const std::string& where, Kinds kinds = any_kind);
/// Runs when nobody names a level.
const Level& default_level();
/// Levels with a bus in all their variants. The first takes part in every case.
std::vector<Way> ways_of(const std::vector<const Level*>& levels);

/// A level made ready to move a mesh. `array` and `port` are null where the level has no bus.
struct ReadyLevel {
  const Level* level = nullptr;
  std::unique_ptr<ArrayPort> port;
  std::unique_ptr<Mover> mover;
  ArrayMover* array = nullptr; ///< is `mover`
};

/// `check`: ask the reference beside every step, where the level can. Level and `prepared` must outlive it.
ReadyLevel make_ready(const Level& level, const Prepared& prepared, bool check = false,
                      const PortRequest& request = {});

} // namespace hopmesh::levels
