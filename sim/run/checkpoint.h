// The checkpoint of a run: all that is needed to go on with it bit for bit, in one file. Lines of text that
// are checked one by one, then the state in binary. docs/use/results-folder.md has its keys.
#pragma once

#include "sim/files/grey_picture.h"
#include "sim/files/stream_rest.h"
#include "sim/levels/mover.h"
#include "sim/scene/scene_file.h"

#include <map>
#include <optional>

namespace hopmesh::run {

inline constexpr const char* checkpoint_name = "checkpoint";

/// A file of the results folder that grows with the steps, as far as it is safe.
struct NamedMark {
  std::string name;
  files::StreamMark mark;
};

struct Checkpoint {
  std::string program; ///< which wrote it: version and commit
  std::string level, command;
  bool check = false;                 ///< the reference is asked
  std::uint64_t every = 0;            ///< a checkpoint is due after so many steps; 0: only when interrupted
  std::uint64_t asked = 0;            ///< steps asked for instead of the scene's; 0: the scene's
  double wall_seconds = 0;            ///< spent so far
  std::uint64_t mesh = 0;             ///< mesh_hash of the mesh as built
  std::optional<std::uint64_t> image; ///< picture_hash of the picture that pulls
  std::string scene, array;           ///< their texts
  std::vector<levels::SignalRange> ranges; ///< seen so far; without formats
  std::vector<NamedMark> streams;
  levels::StepState state;

  std::string file;                ///< it was read from
  std::map<std::string, int> line; ///< where a key, a stream or a part of the state stands there

  /// A mistake of what stands at a key.
  input::InputError error(const std::string& key, const std::string& found,
                          const std::string& expected) const;
};

/// The program that is running.
std::string this_program();

/// Replaces the file in one instant. Throws record::WriteError.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Throws scene::InputError with file and line for whatever is not as it was written, or was written by
/// another program.
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// XXH64 of everything in a mesh.
std::uint64_t mesh_hash(const scene::Mesh& mesh);

/// XXH64 of what a picture shows, whatever the format of its file.
std::uint64_t picture_hash(const files::GreyPicture& picture);

} // namespace hopmesh::run
