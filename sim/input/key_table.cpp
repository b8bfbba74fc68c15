// Reading by the table: each kind of value knows how to say what it expected.
#include "sim/input/key_table.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::input {

namespace {

std::optional<spec::NumberFormat> format_in(const TomlValue& value) {
  const auto* text = value.as<std::string>();
  return text ? spec::parse_format(*text) : std::nullopt;
}

/// The mode name nearest to a word of the text that is none, for formats like fixed<16,2,SC_RDN>.
std::string nearest_mode(const std::string& text) {
  std::vector<std::string> valid(spec::rounding_names.begin(), spec::rounding_names.end());
  valid.insert(valid.end(), spec::overflow_names.begin(), spec::overflow_names.end());
  for (auto start = text.find(','); start != std::string::npos; start = text.find(',', start + 1)) {
    const auto end = text.find_first_of(",>", start + 1);
    const std::string word = text.substr(start + 1, end == std::string::npos ? end : end - start - 1);
    std::string nearest = nearest_name(word, valid);
    if (!nearest.empty() && nearest != word) return nearest;
  }
  return "";
}

std::int64_t whole(double x) {
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  return x >= static_cast<double>(most) ? most : static_cast<std::int64_t>(x);
}

/// Puts one value that the source has into its place.
struct Reading {
  KeyReader& reader;
  const Key& key;
  const TomlValue& value;

  InputError error(const std::string& expected, const std::string& nearest = "") const {
    return reader.source().error(value, key.name, expected, nearest);
  }
  double number(const TomlValue& from, const std::string& name, const Range& range) const {
    return reader.number(from, name, range);
  }

  void operator()(std::monostate) const {}
  void operator()(const Part&) const {}
  void operator()(const Special& special) const { special.read(reader.source(), value); }
  void operator()(double* at) const { *at = number(value, key.name, key.range); }
  void operator()(std::string* at) const { reader.text(key.name, *at, key.range.words); }
  void operator()(std::int64_t* at) const {
    reader.integer(key.name, *at, whole(key.range.low), whole(key.range.high));
  }

  void operator()(bool* at) const {
    if (!value.as<bool>()) throw error("true or false");
    *at = *value.as<bool>();
  }

  /// Without a range, any integer: rules judge it later, and none of them reaches this far.
  void operator()(int* at) const {
    constexpr std::int64_t far = 1'000'000;
    std::int64_t wide = 0;
    if (std::isfinite(key.range.low))
      (*this)(&wide);
    else if (const auto* any = value.as<std::int64_t>())
      wide = std::clamp(*any, -far, far);
    else
      throw error("an integer");
    *at = static_cast<int>(wide);
  }

  void operator()(Vector3* at) const {
    const auto* items = value.as<std::vector<TomlValue>>();
    if (!items || items->size() != at->size()) throw error("three numbers, [x, y, z]");
    for (std::size_t k = 0; k < at->size(); ++k)
      (*at)[k] = number((*items)[k], fmt::format("{}[{}]", key.name, k), any_real);
  }

  template <typename T> void operator()(std::optional<T>* at) const {
    T read{};
    (*this)(&read);
    *at = read;
  }

  void operator()(const spec::Choice& choice) const {
    const std::vector<std::string> names(choice.names, choice.names + choice.count);
    const auto* name = value.as<std::string>();
    const auto at = name ? std::find(names.begin(), names.end(), *name) : names.end();
    if (at == names.end()) throw error(one_of(names), name ? nearest_name(*name, names) : "");
    *choice.at = static_cast<std::uint8_t>(at - names.begin());
  }

  void operator()(const Worded& worded) const {
    const auto* word = value.as<std::string>();
    if (word && *word != worded.word) throw error(key.range.words, nearest_name(*word, {worded.word}));
    worded.number->reset();
    if (!word) *worded.number = number(value, key.name, key.range);
  }

  void operator()(spec::NumberFormat* at) const {
    const auto format = format_in(value);
    const auto* text = value.as<std::string>();
    if (!format)
      throw error("a format such as \"fixed<16,2,SC_RND,SC_SAT>\"", text ? nearest_mode(*text) : "");
    *at = *format;
  }

  void operator()(const spec::Accumulator& accumulator) const {
    const auto* text = value.as<std::string>();
    const auto format = format_in(value);
    *accumulator.exact = text && *text == "exact";
    if (*accumulator.exact) return;
    if (!format) throw error("\"exact\" or a format such as \"fixed<40,12,SC_TRN,SC_SAT>\"");
    *accumulator.format = *format;
  }
};

} // namespace

void make_parts(const TomlSource& source, const Keys& keys) {
  for (const Key& key : keys) {
    const auto* part = std::get_if<Part>(&key.place);
    const TomlValue* table = part ? source.find(key.name) : nullptr;
    if (!table || !table->as<TomlTable>()) continue;
    if (part->required && !source.find(key.name + "." + part->required))
      throw input_error(source.file_of(table->line), table->line, key.name, part->found, part->expected);
    part->make();
  }
}

void read_keys(KeyReader& reader, const Keys& keys) {
  for (const Key& key : keys) {
    if (std::holds_alternative<Part>(key.place)) continue;
    if (const TomlValue* value = reader.value(key.name)) std::visit(Reading{reader, key, *value}, key.place);
  }
}

void refuse_beside(const TomlSource& source, const Keys& keys) {
  for (const Key& key : keys) {
    const When& when = key.when;
    const TomlValue* value = source.find(key.name);
    if (!value || when.holds || when.otherwise == Otherwise::told) continue;
    if (when.otherwise == Otherwise::refused)
      throw source.error(*value, key.name, fmt::format("this key only beside {}", when.beside));
    const std::string text = value_text(key.place);
    if (text != "0.0" && text != "0") throw source.error(*value, key.name, fmt::format("0: {}", when.why));
  }
}

std::string no_effect(const TomlSource& source, const TomlValue& value, const std::string& key,
                      const std::string& beside) {
  const std::string place = value.line == 0 ? "" : fmt::format(":{}", value.line);
  return fmt::format("{}{}: {}: no effect here; it counts only with {}", source.file_of(value.line), place,
                     key, beside);
}

std::vector<std::string> without_effect(const TomlSource& source, const Keys& keys, const Keys& fresh) {
  std::vector<std::string> notes;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const Key& key = keys[k];
    const TomlValue* value = source.find(key.name);
    if (!value || key.when.holds || key.when.otherwise != Otherwise::told || is_left_out(key)) continue;
    if (value->line != 0 && value_text(key.place) == value_text(fresh[k].place)) continue;
    notes.push_back(no_effect(source, *value, key.name, key.when.beside));
  }
  return notes;
}

} // namespace hopmesh::input
