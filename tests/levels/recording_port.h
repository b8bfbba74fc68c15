// An array that keeps every transfer: what a host asked of its bus, in order.
#pragma once

#include "tests/support/soft_array.h"

namespace hopmesh::tests {

/// A transfer, or a wait, which has no words.
struct Transfer {
  char kind = 'w'; ///< r, w, or . for a wait
  std::uint32_t address = 0;
  std::vector<std::uint32_t> words;

  bool operator==(const Transfer& other) const {
    return kind == other.kind && address == other.address && words == other.words;
  }
};

class RecordingPort : public SoftArray {
 public:
  using SoftArray::SoftArray;

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override {
    const int error = SoftArray::read(address, words, count);
    all.push_back({'r', address, {words, words + count}});
    return error;
  }
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override {
    all.push_back({'w', address, {words, words + count}});
    return SoftArray::write(address, words, count);
  }
  int wait_for_irq() override {
    all.push_back({'.', 0, {}});
    return SoftArray::wait_for_irq();
  }

  std::vector<Transfer> all;
};

/// Each word as a transfer of its own.
inline std::vector<Transfer> word_by_word(const std::vector<Transfer>& all) {
  std::vector<Transfer> single;
  for (const Transfer& t : all) {
    if (t.words.empty()) single.push_back(t);
    for (std::uint32_t k = 0; k < t.words.size(); ++k)
      single.push_back({t.kind, t.address + 4 * k, {t.words[k]}});
  }
  return single;
}

} // namespace hopmesh::tests
