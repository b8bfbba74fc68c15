// Bytes that are written piece by piece come back, by a decoder that knows only the alphabet.
#include "sim/pictures/base64.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace pictures;

template <class Fill> std::string written(Fill fill) {
  const Folder folder;
  files::OutputFile file(folder / "digits.txt");
  Base64Writer writer(file);
  fill(writer);
  writer.end();
  file.commit();
  return content_of(folder / "digits.txt");
}

std::string encoded(const std::string& text) {
  return written([&](Base64Writer& out) { out.bytes(text.data(), text.size()); });
}

/// Bit by bit: six of each digit, padding ends it.
std::string decoded(const std::string& digits) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bits, text;
  for (const char c : digits)
    for (int bit = 5; bit >= 0 && c != '='; --bit) bits += alphabet.find(c) >> bit & 1 ? '1' : '0';
  for (std::size_t k = 0; k + 8 <= bits.size(); k += 8)
    text += static_cast<char>(std::stoi(bits.substr(k, 8), nullptr, 2));
  return text;
}

TEST(Base64, AnyBytesOfAnyLengthComeBack) {
  for (const std::size_t length : {1, 255, 256, 3070, 3071, 3072, 3073, 3074, 6144, 10001}) {
    std::string text;
    for (std::size_t k = 0; k < length; ++k) text += static_cast<char>(k * 37 + k / 256);
    EXPECT_EQ(decoded(encoded(text)), text) << length;
    EXPECT_EQ(encoded(text).size(), (length + 2) / 3 * 4);
  }
}

TEST(Base64, PiecesAreOneText) {
  std::string all;
  const std::string digits = written([&](Base64Writer& out) {
    for (std::uint32_t k = 0; k < 5000; ++k) {
      const std::uint8_t byte = static_cast<std::uint8_t>(k);
      out.value(k);
      out.value(byte);
      out.bytes(&k, 3);
      all.append(reinterpret_cast<const char*>(&k), 4).append(1, static_cast<char>(byte));
      all.append(reinterpret_cast<const char*>(&k), 3);
    }
  });
  EXPECT_EQ(decoded(digits), all);
}

} // namespace
} // namespace hopmesh::tests
