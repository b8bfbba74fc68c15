// Every word written is there to be read, cut to its format, in bursts that begin and end anywhere; and words
// beside a burst stay as they were.
#include "tests/engine/engine_bench.h"

#include "tests/support/slow_fixed.h"

namespace hopmesh::tests {
namespace {

using engine::Engine;
using Words = std::vector<std::uint32_t>;

/// A memory, one of three, as a host sees it.
struct Memory {
  const char* name;
  void (Engine::*write)(std::size_t, const std::uint32_t*, std::size_t);
  void (Engine::*read)(std::size_t, std::uint32_t*, std::size_t) const;
  spec::NumberFormat format;
  std::int64_t most; ///< outputs are held within [-1, 1]
  std::size_t words;
};

std::vector<Memory> memories(const spec::ArraySpec& a, const spec::Topology& t) {
  const spec::Formats& f = a.formats;
  return {
      {"weights", &Engine::write_weights, &Engine::read_weights, f.weight, INT64_MAX, t.weight_words()},
      {"biases", &Engine::write_biases, &Engine::read_biases, f.bias, INT64_MAX, t.neurons()},
      {"outputs", &Engine::write_outputs, &Engine::read_outputs, f.state, f.state.one_raw(), t.neurons()}};
}

std::uint32_t kept(std::uint32_t word, const Memory& m) {
  spec::NumberFormat f = m.format;
  f.overflow = spec::Overflow::wrap;
  const std::int64_t code = quantise_code(static_cast<std::int32_t>(word), f.fraction_bits(), f);
  return static_cast<std::uint32_t>(std::min(std::max(code, -m.most), m.most));
}

/// Bursts at random, each seen at once, and everything seen at the end.
void abuse(Engine& e, const Memory& m, Dice& dice) {
  SCOPED_TRACE(m.name);
  Words shadow(m.words, 0);
  for (int burst = 0; burst < 60; ++burst) {
    const std::size_t first = dice.below(m.words), room = m.words - first;
    Words words(1 + dice.below(dice.one_in(3) ? room : std::min<std::size_t>(room, 17)));
    for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(dice.bits());
    (e.*m.write)(first, words.data(), words.size());
    for (std::size_t k = 0; k < words.size(); ++k) shadow[first + k] = kept(words[k], m);
    const std::size_t begin = dice.below(m.words);
    Words seen(1 + dice.below(m.words - begin));
    (e.*m.read)(begin, seen.data(), seen.size());
    ASSERT_TRUE(std::equal(seen.begin(), seen.end(), shadow.begin() + static_cast<std::ptrdiff_t>(begin)))
        << "burst " << burst << " of " << words.size() << " words from " << first;
  }
  Words all(m.words);
  (e.*m.read)(0, all.data(), all.size());
  EXPECT_EQ(all, shadow);
}

TEST(EngineMemories, KeepWhatIsWrittenInAnyBurst) {
  for (std::uint64_t seed = 700000; seed < 700060; ++seed) {
    Dice dice(seed);
    const spec::Topology topology = random_topology(dice, 60);
    const bool fast = !dice.one_in(4);
    const spec::ArraySpec array =
        fast ? random_fast_array(dice, topology, dice.mode<spec::Normaliser>(spec::normaliser_names))
             : random_array(dice, topology.most_taps());
    for (const std::string& kernel : fast ? kernels_here() : std::vector<std::string>{"auto"}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", kernel " + kernel);
      Engine e(array, topology, {1, kernel, static_cast<std::size_t>(1 + dice.below(2))});
      for (const Memory& m : memories(array, topology)) abuse(e, m, dice);
    }
  }
}

} // namespace
} // namespace hopmesh::tests
