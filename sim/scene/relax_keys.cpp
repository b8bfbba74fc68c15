// The table of m as the value of a key: a list of numbers, or the word for the sequence that it stands for.
#include "sim/scene/relax_keys.h"

namespace hopmesh::scene {

namespace {

constexpr const char* fista = "fista";
constexpr input::Range of_entry{0, 1, "\"fista\", or a list of numbers from 0 to 1"};

std::vector<double> read_list(const input::TomlSource& source, const input::TomlValue& value) {
  const std::string key = "relax.momentum";
  if (const auto* word = value.as<std::string>(); word && *word == fista) return {};
  const auto* items = value.as<std::vector<input::TomlValue>>();
  if (!items || items->empty()) throw source.error(value, key, of_entry.words);
  const input::KeyReader reader(source);
  std::vector<double> list;
  for (const input::TomlValue& item : *items) list.push_back(reader.number(item, key, of_entry));
  return list;
}

std::string list_text(std::vector<double> list) {
  if (list.empty()) return '"' + std::string(fista) + '"';
  std::string text;
  for (double& entry : list) text += (text.empty() ? "" : ", ") + input::value_text(&entry);
  return '[' + text + ']';
}

} // namespace

input::Special momentum_list(std::vector<double>& list) {
  return {[&list](const auto& source, const auto& value) { list = read_list(source, value); },
          [&list] { return list_text(list); }};
}

} // namespace hopmesh::scene
