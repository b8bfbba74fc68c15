// A strict, ordered stand-in for the host bus: the firmware must make exactly the accesses that the test
// expects, in that order. Anything extra, missing, reordered or different fails the test with both sides in
// words.
#pragma once

#include <cstdint>

extern "C" {
#include "firmware/bus.h"
}

#include <deque>
#include <string>
#include <vector>

namespace hopmesh::tests {

class BusMock {
 public:
  BusMock();
  /// Fails the test if expected accesses never came.
  ~BusMock();
  BusMock(const BusMock&) = delete;
  BusMock& operator=(const BusMock&) = delete;

  const hm_bus* bus() const { return &bus_; }

  void expect_read(std::uint32_t address, std::uint32_t answer);
  void expect_write(std::uint32_t address, std::uint32_t word);
  void expect_read_burst(std::uint32_t address, const std::vector<std::uint32_t>& answer);
  void expect_write_burst(std::uint32_t address, const std::vector<std::uint32_t>& words);
  void expect_wait();

  /// The k-th of the accesses expected so far (from 0) answers with this error, and nothing may follow it.
  void fail_at(std::size_t k, int error);
  /// The last `count` of the accesses expected so far never come.
  void drop(std::size_t count) { expected_.resize(expected_.size() - count); }
  /// Accesses expected and not yet made.
  std::size_t outstanding() const { return expected_.size(); }

 private:
  enum class Kind { read, write, read_burst, write_burst, wait };
  struct Access {
    Kind kind;
    std::uint32_t address = 0;
    std::vector<std::uint32_t> words; ///< of a write: what must come; of a read: the answer
    int result = HM_OK;
  };

  static std::string text(const Access& access);
  /// Takes the next expectation if it is of this kind and place; else complains and returns HM_ERROR_BUS.
  int take(const Access& actual, Access* taken);

  static int read(void* self, std::uint32_t address, std::uint32_t* word);
  static int write(void* self, std::uint32_t address, std::uint32_t word);
  static int read_burst(void* self, std::uint32_t address, std::uint32_t* words, std::uint32_t count);
  static int write_burst(void* self, std::uint32_t address, const std::uint32_t* words, std::uint32_t count);
  static int wait(void* self);

  hm_bus bus_;
  std::deque<Access> expected_;
  std::size_t made_ = 0;
  bool broken_ = false; ///< one complaint is enough; what follows is noise
};

} // namespace hopmesh::tests
