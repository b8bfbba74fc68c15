#include "sim/files/base64.h"

#include <algorithm>

namespace hopmesh::files {
namespace {

constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Two digits for every twelve bits: half as many look-ups.
struct Pairs {
  std::array<std::array<char, 2>, 4096> of{};
  Pairs() {
    for (std::size_t k = 0; k < of.size(); ++k) of[k] = {digits[k >> 6], digits[k & 63u]};
  }
};

} // namespace

void Base64Writer::bytes(const void* data, std::size_t count) {
  const auto* at = static_cast<const unsigned char*>(data);
  while (count > 0) {
    if (waiting_ == block_.size()) flush();
    const std::size_t part = std::min(count, block_.size() - waiting_);
    std::memcpy(block_.data() + waiting_, at, part);
    waiting_ += part;
    at += part;
    count -= part;
  }
}

// Whole groups only, but at the end.
void Base64Writer::flush() {
  static const Pairs pairs;
  std::array<char, 4 * 1024> text;
  const std::size_t groups = waiting_ / 3;
  for (std::size_t g = 0; g < groups; ++g) {
    const unsigned char* in = block_.data() + 3 * g;
    const unsigned bits = static_cast<unsigned>(in[0] << 16 | in[1] << 8 | in[2]);
    std::memcpy(text.data() + 4 * g, pairs.of[bits >> 12].data(), 2);
    std::memcpy(text.data() + 4 * g + 2, pairs.of[bits & 4095u].data(), 2);
  }
  file_.write(text.data(), 4 * groups);
  waiting_ = 0;
}

void Base64Writer::end() {
  const std::size_t left = waiting_ % 3;
  unsigned char last[3] = {};
  std::memcpy(last, block_.data() + waiting_ - left, left);
  flush();
  if (left == 0) return;
  const unsigned bits = static_cast<unsigned>(last[0] << 16 | last[1] << 8);
  const char text[4] = {digits[bits >> 18], digits[bits >> 12 & 63u],
                        left == 2 ? digits[bits >> 6 & 63u] : '=', '='};
  file_.write(text, 4);
}

} // namespace hopmesh::files
