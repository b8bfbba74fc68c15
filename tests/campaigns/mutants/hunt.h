// Mutants by the thousand, read in child processes: whatever is neither read nor refused in a sentence is a
// fault, and is kept as a file.
#pragma once

#include "tests/campaigns/mutants/reader.h"

#include <atomic>

namespace hopmesh::campaigns {

/// What is asked of a hunt. A mutant is a function of seed, reader and number; the first numbers are the
/// reader's seeds as they are.
struct Hunt {
  std::uint64_t seed = 1, first = 0, mutants = 1000; ///< of each reader
  std::uint64_t batch = 500;                         ///< mutants that a child reads
  std::size_t children = 1;                          ///< at once
  unsigned processor_seconds = 20;                   ///< of a mutant; more is a hang
  unsigned seconds = 240;                            ///< likewise, by the clock on the wall
  std::filesystem::path out;                         ///< a folder for each fault goes here
};

/// What became of a reader's mutants.
struct Tally {
  std::uint64_t read = 0, refused = 0, faults = 0;
};

struct Hunted {
  std::vector<Tally> of;  ///< [readers]
  std::uint64_t next = 0; ///< every mutant below it is done
  bool interrupted = false;
  std::vector<std::string> faults; ///< in a line each
};

std::string mutant_at(const Reader& reader, std::uint64_t seed, std::uint64_t number);

/// "" for a sentence that people can be told: a line of printable text, not too long.
std::string fault_of_sentence(const std::string& sentence);

/// `progress` is told the number of mutants done.
Hunted hunt(const std::vector<Reader>& readers, const Hunt& plan,
            const std::function<void(std::uint64_t)>& progress, const std::atomic<bool>& stop);

} // namespace hopmesh::campaigns
