// Test vectors: jobs and their answers, phase by phase, as a text that cores which are not ours can read,
// fill in and be judged by. docs/use/test-vectors.md describes the file.
#pragma once

#include "sim/cosim/divergence.h"
#include "sim/cosim/vector_lines.h"
#include "sim/files/output_file.h"

#include <optional>
#include <string>

namespace hopmesh::cosim {

inline constexpr const char* vectors_header = "hopmesh-vectors 4";

struct VectorCase {
  std::string name; ///< one line
  ArrayJob job;
};

/// Nothing has the file's name before commit().
class VectorWriter {
 public:
  explicit VectorWriter(const std::filesystem::path& path, spec::ArrayTable table = spec::array_keys);

  void comment(const std::string& text);
  /// `bus`: of an array built for the job, which gives the answers; none: a blank case, to be filled in.
  void add(const VectorCase& a_case, const hm_bus* bus);
  void commit() { file_.commit(); }

 private:
  void write_job(const VectorCase& a_case);
  void write_answers(const ArrayJob& job, const hm_bus& bus);

  files::OutputFile file_;
  const spec::ArrayTable table_;
};

/// A line of answers. `fire`: V of the neurons of a phase, in the order of the phase's line; else `end`.
struct AnswerLine {
  int line = 0;
  bool end = false;
  std::uint64_t sweep = 0, phase = 0, cycle = 0;
  Codes codes;
  spec::Relaxation run; ///< of `end`
};

/// Reads a file line by line, however long it is; throws input::InputError with the line of a mistake.
class VectorReader {
 public:
  explicit VectorReader(const std::string& path, spec::ArrayTable table = spec::array_keys);

  /// The next case, up to its answers (those of the case before are skipped); false at the end of the file.
  bool next(VectorCase& a_case);
  /// The next line of answers of this case; nothing may follow its `end`. Throws where a case was left blank.
  AnswerLine answer();

 private:
  std::int32_t code(const std::string& word) const;
  void skip_answers();
  void read_links(spec::Topology& topology);
  void check_links(const spec::Topology& topology, const std::vector<int>& lines) const;
  void read_stop(ArrayJob& job);
  void read_momentum(ArrayJob& job);
  void read_neurons(ArrayJob& job);
  void read_phases(const ArrayJob& job);

  VectorLines lines_;
  const spec::ArrayTable table_;
  spec::Phases phases_;
  std::uint64_t next_sweep_ = 1, next_phase_ = 0;
  bool in_answers_ = false;
};

/// The first wrong line of a case, in words: file and line, where it is in the run, found, expected, and the
/// neuron's inputs. "" if every line is right. `lines` counts the right ones.
std::string check_answers(const std::string& path, VectorReader& reader, const VectorCase& a_case,
                          const hm_bus& bus, std::uint64_t& lines);

} // namespace hopmesh::cosim
