// The hunt for files that the program stumbles over: a short share of it, and proof that a hunt finds what it
// looks for. The long campaign is tests/campaigns/run.
#include "sim/input/input_error.h"
#include "tests/campaigns/mutants/hunt.h"
#include "tests/campaigns/mutants/repairs.h"
#include "tests/support/files.h"

#include <csignal>
#include <gmock/gmock.h>
#include <stdexcept>

namespace hopmesh::tests {
namespace {

using namespace campaigns;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::atomic<bool> nobody_stops{false};

Hunted hunted(const std::vector<Reader>& readers, const Hunt& plan) {
  return hunt(
      readers, plan, [](std::uint64_t) {}, nobody_stops);
}

/// A reader with every fault there is, each for a word of its own.
void stumble(const fs::path& folder) {
  const std::string text = content_of(folder / "m");
  if (text == "sound") return;
  if (text == "bad") throw input::InputError("m:1: found \"bad\", expected \"sound\"");
  if (text == "defect") throw std::logic_error("a defect");
  if (text == "two lines") throw input::InputError("m:\nbad");
  if (text == "crash") std::raise(SIGSEGV);
  if (text == "memory") throw std::bad_alloc();
  for (volatile bool for_ever = text == "hang"; for_ever;) {
  }
}

const Reader stumbling{
    "stumbling", "m",     {"sound", "bad", "defect", "crash", "sound", "two lines", "hang", "memory", "bad"},
    "",          stumble, nullptr,
    false};

TEST(Mutants, AHuntFindsEveryKindOfFault) {
  const Folder folder;
  Hunt plan;
  plan.mutants = stumbling.seeds.size(), plan.batch = 5, plan.children = 2;
  plan.processor_seconds = 1, plan.out = folder / "found";
  const Hunted found = hunted({stumbling}, plan);
  EXPECT_EQ(found.of[0].read, 2u);
  EXPECT_EQ(found.of[0].refused, 2u);
  EXPECT_EQ(found.of[0].faults, 5u);
  EXPECT_EQ(found.next, plan.mutants);
  ASSERT_EQ(found.faults.size(), 5u);
  EXPECT_THAT(found.faults[0], HasSubstr("a defect"));
  EXPECT_THAT(found.faults[1], ::testing::ContainsRegex("signal 11|SEGV"));
  EXPECT_THAT(found.faults[2], HasSubstr("no single line"));
  EXPECT_THAT(found.faults[3], HasSubstr("a hang"));
  EXPECT_THAT(found.faults[4], HasSubstr("memory"));
  EXPECT_EQ(content_of(folder / "found/stumbling-3/m"), "crash");
}

TEST(Mutants, AreTheSameWheneverTheyAreAskedFor) {
  const Reader reader{"words", "m", {"one 1\ntwo 2\n", "three 3\n"}, "", nullptr, nullptr, false};
  std::size_t changed = 0;
  for (std::uint64_t k = 2; k < 300; ++k) {
    const std::string mutant = mutant_at(reader, 7, k);
    EXPECT_EQ(mutant, mutant_at(reader, 7, k));
    changed += mutant != reader.seeds[0] && mutant != reader.seeds[1];
  }
  EXPECT_GT(changed, 250u);
  EXPECT_NE(mutant_at(reader, 7, 5), mutant_at(reader, 8, 5));
}

// Any bytes, however short, and often.
TEST(Mutants, EveryChangeTakesAnyBytes) {
  Random random(20261130);
  const Seeds seeds{"", "a", "\n", "\n\n", "12", std::string(3, '\0'), "v 1 2\nf 1 2 3\n"};
  for (const Change& change : changes()) {
    std::size_t changed = 0;
    for (int k = 0; k < 2000; ++k) {
      const std::string before = seeds[1 + below(seeds.size() - 1, random)];
      std::string bytes = before;
      change.apply(bytes, seeds, random);
      changed += bytes != before;
      EXPECT_LT(bytes.size(), 5000u) << change.name;
    }
    EXPECT_GT(changed, 200u) << change.name;
  }
}

std::string repaired(std::string bytes, void (*repair)(std::string&)) {
  repair(bytes);
  return bytes;
}

// What a repair writes is what the program writes: a sound file stays as it was.
TEST(Mutants, RepairsLeaveSoundFilesAlone) {
  const Folder folder;
  std::size_t files = 0;
  for (const Reader& reader : all_readers(folder.path())) {
    if (!reader.repair) continue;
    for (const std::string& seed : reader.seeds) {
      EXPECT_TRUE(repaired(seed, reader.repair) == seed) << reader.name;
      ++files;
    }
  }
  EXPECT_GT(files, 10u);
}

/// So many mutants of each must be read or refused; and each must read its first seeds, or it would be blind.
void expect_no_fault(const std::vector<Reader>& readers, std::uint64_t mutants) {
  const Folder folder;
  Hunt plan;
  plan.seed = 20261130, plan.mutants = mutants, plan.batch = 200, plan.children = 2,
  plan.out = folder / "found";
  const Hunted found = hunted(readers, plan);
  EXPECT_THAT(found.faults, ::testing::IsEmpty());
  for (std::size_t r = 0; r < readers.size(); ++r) {
    EXPECT_EQ(found.of[r].read + found.of[r].refused, mutants) << readers[r].name;
    EXPECT_TRUE(found.of[r].read > 0 || readers[r].name.find("manifest") != std::string::npos)
        << readers[r].name;
    // Without a study that can be read, a chart is named after its folder.
    const bool is_only_a_title = readers[r].name == "study beside results";
    EXPECT_EQ(found.of[r].refused > 0, !is_only_a_title) << readers[r].name;
  }
}

TEST(Mutants, OfEveryFileAreReadOrRefused) {
  const Folder folder;
  expect_no_fault(all_readers(folder.path()), 200);
}

TEST(Mutants, InWholeProcessesAreReadOrRefused) {
  const Folder folder;
  const std::vector<Reader> programs = all_programs(folder.path());
  Hunt plan;
  plan.seed = 20261130, plan.mutants = 4, plan.batch = 4, plan.children = 2, plan.out = folder / "found";
  const Hunted found = hunted(programs, plan);
  EXPECT_THAT(found.faults, ::testing::IsEmpty());
}

} // namespace
} // namespace hopmesh::tests
