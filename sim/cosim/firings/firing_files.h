// Files of firings: lines of words, a table in CSV, or a folder of memories that Verilog's $readmemh reads.
// docs/use/test-vectors.md describes them.
#pragma once

#include "sim/cosim/firings/firing_columns.h"
#include "sim/cosim/vector_lines.h"

#include <filesystem>
#include <memory>

namespace hopmesh::cosim {

inline constexpr const char* firings_header = "hopmesh-neurons 2";
inline constexpr const char* firings_list = "array.txt"; ///< of a folder of memories: what its array is

enum class FiringFormat { text, csv, memh };
inline constexpr std::array<const char*, 3> firing_format_names{"text", "csv", "memh"};

/// Nothing has its final name before commit().
class FiringWriter {
 public:
  virtual ~FiringWriter() = default;
  virtual void add(const Firing& firing) = 0;
  virtual void commit() = 0;
};

struct FiringTask {
  std::string name;   ///< one line
  bool blank = false; ///< without answers: a core fills them in
};

/// Throws files::WriteError; input::InputError where a blank folder would keep answers of somebody.
std::unique_ptr<FiringWriter> make_firing_writer(FiringFormat format, const std::filesystem::path& path,
                                                 const NeuronShape& shape, const FiringTask& task);
std::unique_ptr<FiringWriter> make_lines_writer(bool csv, const std::filesystem::path& path,
                                                const NeuronShape& shape, const FiringTask& task);
std::unique_ptr<FiringWriter> make_memories_writer(const std::filesystem::path& folder,
                                                   const NeuronShape& shape, const FiringTask& task);

/// Throws input::InputError for what is no file of firings.
class FiringReader {
 public:
  virtual ~FiringReader() = default;
  /// False at the end.
  virtual bool next(FiringRow& row) = 0;
  /// Of the row at hand, for messages.
  virtual std::string place() const = 0;
  [[noreturn]] virtual void fail(const std::string& found, const std::string& expected) const = 0;
  virtual const NeuronShape& shape() const = 0;
};

/// A folder is one of memories; whether a file is CSV, its first line says.
std::unique_ptr<FiringReader> open_firings(const std::string& path);
std::unique_ptr<FiringReader> open_firing_lines(const std::string& path);
std::unique_ptr<FiringReader> open_firing_memories(const std::string& folder);

/// Lines between the first and the firings, and back.
std::string shape_lines(const std::string& name, const NeuronShape& shape);
NeuronShape read_shape(VectorLines& lines);

} // namespace hopmesh::cosim
