// The strict bus. Addresses print with the names of the register table.
#include "tests/support/bus_mock.h"

#include "firmware/registers.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace hopmesh::tests {
namespace {

std::string hex(std::uint32_t x) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "0x%X", x);
  return digits;
}

std::string place(std::uint32_t address) {
#define HM_X(name, offset, access, reset, meaning)                                                           \
  if (address == (offset)) return #name;
  HM_REGISTERS(HM_X)
#undef HM_X
  return hex(address);
}

} // namespace

BusMock::BusMock() : bus_{this, &read, &write, &read_burst, &write_burst, &wait} {}

BusMock::~BusMock() {
  if (!broken_ && !expected_.empty())
    ADD_FAILURE() << "after " << made_ << " accesses, " << expected_.size()
                  << " never came; the next was to be " << text(expected_.front());
}

void BusMock::expect_read(std::uint32_t address, std::uint32_t answer) {
  expected_.push_back({Kind::read, address, {answer}});
}
void BusMock::expect_write(std::uint32_t address, std::uint32_t word) {
  expected_.push_back({Kind::write, address, {word}});
}
void BusMock::expect_read_burst(std::uint32_t address, const std::vector<std::uint32_t>& answer) {
  expected_.push_back({Kind::read_burst, address, answer});
}
void BusMock::expect_write_burst(std::uint32_t address, const std::vector<std::uint32_t>& words) {
  expected_.push_back({Kind::write_burst, address, words});
}
void BusMock::expect_wait() {
  expected_.push_back({Kind::wait, 0, {}});
}

void BusMock::fail_at(std::size_t k, int error) {
  expected_.resize(k + 1);
  expected_.back().result = error;
}

std::string BusMock::text(const Access& access) {
  static const char* const names[] = {"read", "write", "read burst", "write burst", "wait"};
  std::string s = names[static_cast<int>(access.kind)];
  if (access.kind == Kind::wait) return s;
  s += " " + place(access.address);
  const bool burst = access.kind == Kind::read_burst || access.kind == Kind::write_burst;
  if (burst) s += " of " + std::to_string(access.words.size());
  const bool write = access.kind == Kind::write || access.kind == Kind::write_burst;
  for (std::size_t k = 0; write && k < access.words.size(); ++k)
    s += (k == 0 ? " = " : " ") + hex(access.words[k]);
  return s;
}

int BusMock::take(const Access& actual, Access* taken) {
  if (broken_) return HM_ERROR_BUS;
  const std::string nothing = "nothing more";
  const std::string wanted = expected_.empty() ? nothing : text(expected_.front());
  if (wanted != text(actual)) {
    broken_ = true;
    ADD_FAILURE() << "access " << made_ << ": expected " << wanted << ", but came " << text(actual);
    return HM_ERROR_BUS;
  }
  *taken = expected_.front();
  expected_.pop_front();
  made_ += 1;
  return taken->result;
}

int BusMock::read(void* self, std::uint32_t address, std::uint32_t* word) {
  Access taken;
  const int result = static_cast<BusMock*>(self)->take({Kind::read, address, {0}}, &taken);
  if (result == HM_OK) *word = taken.words[0];
  return result;
}

int BusMock::write(void* self, std::uint32_t address, std::uint32_t word) {
  Access taken;
  return static_cast<BusMock*>(self)->take({Kind::write, address, {word}}, &taken);
}

int BusMock::read_burst(void* self, std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
  Access taken;
  const int result = static_cast<BusMock*>(self)->take(
      {Kind::read_burst, address, std::vector<std::uint32_t>(count)}, &taken);
  if (result == HM_OK) std::copy(taken.words.begin(), taken.words.end(), words);
  return result;
}

int BusMock::write_burst(void* self, std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  Access taken;
  return static_cast<BusMock*>(self)->take(
      {Kind::write_burst, address, std::vector<std::uint32_t>(words, words + count)}, &taken);
}

int BusMock::wait(void* self) {
  Access taken;
  return static_cast<BusMock*>(self)->take({Kind::wait, 0, {}}, &taken);
}

} // namespace hopmesh::tests
