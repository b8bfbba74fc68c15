#include "sim/run/checkpoint.h"

#include "sim/files/csv.h"
#include "sim/files/output_file.h"
#include "sim/input/number.h"
#include "sim/input/whole_file.h"
#include "sim/run/checked_lines.h"
#include "version.h"

#include <array>
#include <cstring>
#include <fmt/format.h>
#include <xxhash.h>

namespace hopmesh::run {

namespace {

const std::string magic = "hopmesh-checkpoint", format_version = "3";
constexpr std::size_t most_bytes = std::size_t{1} << 32; // four million nodes take a tenth of it

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "values are written as they lie in memory");

// ---- writing

/// Line breaks in a command would end its line.
std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) out += c == '\n' ? "\\n" : c == '\\' ? "\\\\" : std::string(1, c);
  return out;
}

void add_lines(CheckedLines& lines, const std::string& key, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.add(key, text.substr(at, end - at));
    at = end + 1;
  }
}

std::string header_of(const Checkpoint& c) {
  CheckedLines lines;
  lines.add(magic, format_version);
  lines.add("program", c.program);
  lines.add("command", escaped(c.command));
  lines.add("level", c.level);
  lines.add("check", c.check ? "1" : "0");
  lines.add("every", std::to_string(c.every));
  lines.add("asked", std::to_string(c.asked));
  lines.add("wall_seconds", files::shortest(c.wall_seconds));
  add_lines(lines, "scene", c.scene);
  add_lines(lines, "array", c.array);
  lines.add("mesh", fmt::format("{:016x}", c.mesh));
  if (c.image) lines.add("image", fmt::format("{:016x}", *c.image));
  for (const levels::SignalRange& r : c.ranges)
    lines.add("range", fmt::format("{} {} {}", r.signal, r.least, r.largest));
  for (const NamedMark& s : c.streams)
    lines.add("stream", fmt::format("{} {} {:016x}", s.name, s.mark.bytes, s.mark.check));
  lines.add("steps", std::to_string(c.state.step));
  for (const auto& [name, values] : levels::parts_of(c.state))
    lines.add(name,
              fmt::format("{} {:016x}", values->size(), levels::hash_on(0, values->data(), values->size())));
  lines.add("binary", "in this order, float64, little endian");
  return lines.text();
}

// ---- reading

/// The keys of a checkpoint in their order.
class Reading {
 public:
  Reading(const std::string& text, Checkpoint& into) : lines_(text, into.file), c_(into) {}

  void all(const std::string& text) {
    expect_magic(text);
    expect(magic, format_version);
    expect("program", this_program());
    c_.command = unescaped(text_of("command"));
    c_.level = text_of("level");
    c_.check = number("check") != 0;
    c_.every = number("every");
    c_.asked = number("asked");
    read_number("wall_seconds", text_of("wall_seconds"), c_.wall_seconds);
    c_.scene = texts("scene");
    c_.array = texts("array");
    read_number("mesh", text_of("mesh"), c_.mesh, 16);
    if (lines_.next_is("image")) read_number("image", text_of("image"), c_.image.emplace(), 16);
    while (lines_.next_is("range")) range();
    while (lines_.next_is("stream")) stream();
    c_.state.step = number("steps");
    state();
  }

 private:
  // Before any check: a file of another kind is not a damaged one.
  void expect_magic(const std::string& text) const {
    const std::size_t after_check = text.find(' ') + 1;
    if (text.compare(after_check, magic.size(), magic) != 0)
      throw input::input_error(c_.file, 1, "", input::in_quotes(text.substr(0, text.find('\n'))),
                               "a checkpoint of hopmesh");
  }

  std::string text_of(const std::string& key) {
    std::string value(lines_.value(key));
    c_.line.emplace(key, lines_.line());
    return value;
  }

  std::uint64_t number(const std::string& key) {
    const std::uint64_t value = lines_.count(key);
    c_.line.emplace(key, lines_.line());
    return value;
  }

  template <class Number, class... Base>
  void read_number(const std::string& key, std::string_view text, Number& value, Base... base) const {
    if (!input::parse_number(text, value, base...))
      throw lines_.error(key, input::in_quotes(text), "a number");
  }

  void expect(const std::string& key, const std::string& wanted) {
    const std::string found = text_of(key);
    if (found != wanted) throw lines_.error(key, input::in_quotes(found), '"' + wanted + '"');
  }

  std::string texts(const std::string& key) {
    std::string all = text_of(key) + '\n';
    while (lines_.next_is(key)) all += text_of(key) + '\n';
    return all;
  }

  static std::string unescaped(const std::string& text) {
    std::string out;
    for (std::size_t k = 0; k < text.size(); ++k)
      out += text[k] != '\\' || k + 1 == text.size() ? text[k] : text[++k] == 'n' ? '\n' : text[k];
    return out;
  }

  void range() {
    std::string_view text = lines_.value("range");
    levels::SignalRange& r = c_.ranges.emplace_back();
    r.signal = first_word(text);
    read_number("range", first_word(text), r.least);
    read_number("range", text, r.largest);
  }

  void stream() {
    std::string_view text = lines_.value("stream");
    NamedMark& s = c_.streams.emplace_back();
    s.name = first_word(text);
    c_.line[s.name] = lines_.line();
    read_number(s.name, first_word(text), s.mark.bytes);
    read_number(s.name, text, s.mark.check, 16);
  }

  void state() {
    const auto parts = levels::parts_of(c_.state);
    std::array<std::uint64_t, parts.size()> checks{};
    std::uint64_t doubles = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      std::uint64_t count = 0;
      const std::string line = text_of(parts[k].first);
      std::string_view text = line;
      read_number(parts[k].first, first_word(text), count);
      read_number(parts[k].first, text, checks[k], 16);
      if (count > lines_.rest().size() / sizeof(double))
        throw lines_.error(parts[k].first, std::to_string(count) + " values", "as many as the file can hold");
      parts[k].second->resize(count);
      doubles += count;
    }
    text_of("binary");
    if (lines_.rest().size() != doubles * sizeof(double))
      throw lines_.error("binary", fmt::format("{} bytes behind this line", lines_.rest().size()),
                         std::to_string(doubles * sizeof(double)));
    const char* at = lines_.rest().data();
    for (std::size_t k = 0; k < parts.size(); ++k)
      at = values(at, parts[k].first, *parts[k].second, checks[k]);
  }

  const char* values(const char* at, const std::string& name, std::vector<double>& into,
                     std::uint64_t wanted) const {
    const std::size_t bytes = into.size() * sizeof(double);
    if (bytes > 0) std::memcpy(into.data(), at, bytes);
    const std::uint64_t check = levels::hash_on(0, into.data(), into.size());
    if (check == wanted) return at + bytes;
    throw c_.error(name, fmt::format("damaged values, check {:016x}", check), fmt::format("{:016x}", wanted));
  }

  CheckedLineReader lines_;
  Checkpoint& c_;
};

} // namespace

input::InputError Checkpoint::error(const std::string& key, const std::string& found,
                                    const std::string& expected) const {
  const auto place = line.find(key);
  return input::input_error(file, place == line.end() ? 0 : place->second, key, found, expected);
}

std::string this_program() {
  return fmt::format("{} {}", version, commit);
}

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  files::OutputFile out(file);
  out.write(header_of(checkpoint));
  for (const auto& [name, values] : levels::parts_of(checkpoint.state))
    out.write(values->data(), values->size() * sizeof(double));
  out.commit();
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  Checkpoint c;
  c.file = file.string();
  const std::string text = input::read_whole_file(c.file, "a checkpoint of hopmesh", most_bytes);
  Reading(text, c).all(text);
  c.program = this_program();
  return c;
}

// ---- mesh and picture

std::uint64_t mesh_hash(const scene::Mesh& mesh) {
  static_assert(sizeof(scene::Spring) == 24 && sizeof(scene::Corner) == 12, "no padding to be hashed");
  std::uint64_t hash = mesh.planar;
  const auto add = [&](const void* data, std::size_t bytes) { hash = XXH64(data, bytes, hash); };
  add(mesh.position.data(), mesh.position.size() * sizeof(mesh.position[0]));
  add(mesh.springs.data(), mesh.springs.size() * sizeof(mesh.springs[0]));
  add(mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]));
  add(&mesh.mass, sizeof mesh.mass);
  add(&mesh.velocity, sizeof mesh.velocity);
  const std::vector<unsigned char> pinned(mesh.pinned.begin(), mesh.pinned.end());
  add(pinned.data(), pinned.size());
  return hash;
}

std::uint64_t picture_hash(const files::GreyPicture& picture) {
  const std::uint32_t size[2] = {picture.width, picture.height};
  return XXH64(picture.shade.data(), picture.shade.size() * sizeof(double), XXH64(size, sizeof size, 0));
}

} // namespace hopmesh::run
