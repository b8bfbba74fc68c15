// Reads the statements of an OBJ that are a surface or a graph (v, vt, f, l), and keeps an account of those
// that are not.
#include "sim/scene/obj_records.h"

#include "sim/input/count_text.h"
#include "sim/input/input_error.h"
#include "sim/input/number.h"
#include "sim/input/whole_file.h"
#include "sim/scene/limits.h"
#include "sim/scene/obj_lines.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>

namespace hopmesh::scene {

namespace {

using input::Words;

constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr double farthest = 1e15; // squares and their sums stay finite
constexpr std::size_t most_named = 6;

/// Names, looks and normals, which a mesh that moves has no use for.
const std::set<std::string_view> of_no_use{
    "",       "vn",     "g",     "o",        "s",        "mg",  "usemtl",     "mtllib",
    "usemap", "maplib", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj"};

/// What other kinds of files begin with.
struct OtherKind {
  std::string_view begins, name;
};
constexpr OtherKind other_kinds[]{
    {"ply\n", "a PLY file"},        {"ply\r", "a PLY file"},         {"solid", "an STL file"},
    {"OFF", "an OFF file"},         {"COFF", "an OFF file"},         {"glTF", "a glTF file"},
    {"Kaydara", "an FBX file"},     {"PK\x03\x04", "a ZIP archive"}, {"\x1f\x8b", "a gzip file"},
    {"#VRML", "a VRML file"},       {"BLENDER", "a Blender file"},   {"\xff\xfe", "UTF-16 text"},
    {"\xfe\xff", "UTF-16 text"},    {"<", "an XML or HTML file"},    {"{", "a JSON file"},
    {"$MeshFormat", "a Gmsh file"}, {"# vtk", "a VTK file"}};

/// Statements that were passed over: how often, and where first.
class PassedOver {
 public:
  void add(std::string_view keyword, int line) {
    auto& [count, first] = found_[std::string(keyword)];
    if (count++ == 0) first = line;
  }

  void tell(const std::string& path, std::vector<std::string>& notes) const {
    if (!found_.empty())
      notes.push_back(path + ": passed over statements that add neither vertex, face nor line: " + list());
  }

  /// What there was in place of faces.
  std::string instead() const { return found_.empty() ? "" : " but " + list(); }

 private:
  std::string list() const {
    std::vector<std::string> names;
    for (const auto& [name, what] : found_)
      if (names.size() < most_named)
        names.push_back(fmt::format("{} ({}, first in line {})", input::in_quotes(name),
                                    input::with_noun(what.first, "time"), what.second));
    if (found_.size() > most_named)
      names.push_back(input::with_noun(found_.size() - most_named, "other keyword"));
    return fmt::format("{}", fmt::join(names, ", "));
  }

  std::map<std::string, std::pair<std::uint64_t, int>> found_;
};

class RecordReader {
 public:
  explicit RecordReader(const std::string& path) { records_.path = path; }

  ObjRecords read() {
    read_statements(input::read_whole_file(records_.path, "an OBJ mesh", most_bytes));
    if (records_.faces.count() == 0 && records_.lines.count() == 0)
      fail(0, "no faces (lines \"f ...\")" + passed_over_.instead(),
           "an OBJ mesh with at least one, or with lines \"l ...\"");
    passed_over_.tell(records_.path, records_.notes);
    if (odd_textures_ > 0)
      records_.notes.push_back(fmt::format("{}: {} no number within 1e15, taken as 0 0", records_.path,
                                           odd_textures_ == 1
                                               ? "1 texture corner is"
                                               : input::grouped(odd_textures_) + " texture corners are"));
    return std::move(records_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& found, const std::string& expected) const {
    throw input::input_error(records_.path, line, "", found, expected);
  }

  void refuse_other_kinds(std::string_view text) const {
    for (const OtherKind& kind : other_kinds)
      if (text.substr(0, kind.begins.size()) == kind.begins) fail(0, std::string(kind.name), "an OBJ mesh");
    const auto zero = text.find('\0');
    if (zero == std::string_view::npos) return;
    input::LineReader lines(text.substr(0, zero + 1));
    while (lines.next()) continue;
    const bool stl = std::filesystem::path(records_.path).extension() == ".stl";
    fail(lines.number(), stl ? "an STL file" : "a byte of value 0", "an OBJ mesh, which is text");
  }

  void read_statements(const std::string& text) {
    refuse_other_kinds(text);
    ObjLines lines(text);
    while (lines.next()) {
      line_ = lines.number();
      read_statement(lines.keyword(), lines.words());
    }
  }

  void read_statement(std::string_view keyword, Words words) {
    if (keyword == "v")
      read_vertex(words);
    else if (keyword == "vt")
      read_texture(words);
    else if (keyword == "f" || keyword == "fo") // fo: the name of old files
      read_face(words);
    else if (keyword == "l")
      read_polyline(words);
    else if (of_no_use.count(keyword) == 0)
      passed_over_.add(keyword, line_);
  }

  double any_number(std::string_view word, const char* name) const {
    double x = 0;
    if (!input::parse_real(word, x))
      fail(line_, word.empty() ? "no " + std::string(name) : input::in_quotes(word),
           fmt::format("a number for {}", name));
    return x;
  }

  double number(std::string_view word, const char* name) const {
    const double x = any_number(word, name);
    if (!(std::abs(x) <= farthest))
      fail(line_, input::in_quotes(word), fmt::format("a number within 1e15 for {}", name));
    return x;
  }

  void read_vertex(Words& words) {
    const double x = number(words.next(), "x"), y = number(words.next(), "y"), z = number(words.next(), "z");
    read_behind_place(words);
    records_.position.push_back({x, y, z});
    records_.vertex_line.push_back(line_);
    if (records_.position.size() > std::size_t(most_nodes))
      fail(line_, "one vertex more", fmt::format("at most {} nodes", most_nodes));
  }

  /// A weight, which has a meaning for curves alone, or a colour.
  void read_behind_place(Words& words) const {
    std::vector<double> more;
    for (std::string_view word = words.next(); !word.empty() && more.size() < 5; word = words.next())
      more.push_back(any_number(word, "what follows x y z"));
    if (more.size() == 2 || more.size() > 4)
      fail(line_, more.size() == 2 ? "5 numbers" : "more than 7 numbers",
           "x y z, and perhaps a weight of 1 or a colour of 3 or 4 numbers");
    if (more.size() == 1 && more[0] != 1)
      fail(line_, fmt::format("a weight of {}", more[0]),
           "none, or 1: programs disagree on what other weights do to a vertex");
  }

  /// v points up in OBJ and down in pictures. A picture is no reason to refuse a mesh.
  void read_texture(Words& words) {
    std::vector<double> at{any_number(words.next(), "u")};
    for (std::string_view word = words.next(); !word.empty() && at.size() < 4; word = words.next())
      at.push_back(any_number(word, at.size() == 1 ? "v" : "w"));
    if (at.size() > 3) fail(line_, "more than 3 numbers", "u v w at most");
    at.resize(2, 0.0);
    const bool odd = !(std::abs(at[0]) <= farthest && std::abs(at[1]) <= farthest);
    if (odd) at = {0, 0}, ++odd_textures_;
    records_.texture.push_back({float(at[0]), float(1 - at[1])});
  }

  void read_face(Words& words) {
    const std::size_t count = read_run(words, records_.faces);
    if (count < 3) fail(line_, fmt::format("a face of {} corners", count), "at least three");
  }

  void read_polyline(Words& words) {
    const std::size_t count = read_run(words, records_.lines);
    if (count < 2) fail(line_, fmt::format("a line of {} points", count), "at least two");
  }

  std::size_t read_run(Words& words, ObjRuns& runs) const {
    runs.first.push_back(runs.corner.size());
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      runs.corner.push_back(corner(word));
    return runs.corner.size() - runs.first.back();
  }

  /// v, v/vt, v//vn or v/vt/vn.
  ObjCorner corner(std::string_view word) const {
    const auto slash = word.find('/');
    ObjCorner corner{index(word.substr(0, slash), records_.position.size(), word), -1, line_};
    if (slash == std::string_view::npos) return corner;
    const std::string_view rest = word.substr(slash + 1);
    const auto second = rest.find('/');
    const std::string_view texture = rest.substr(0, second);
    if (!texture.empty())
      corner.texture = index(texture, records_.texture.size(), word);
    else if (second == std::string_view::npos)
      fail(line_, input::in_quotes(word), "a texture index after the /");
    if (second != std::string_view::npos) check_normal(rest.substr(second + 1), word);
    return corner;
  }

  /// Normals are of no use to a mesh that moves, and may be missing.
  void check_normal(std::string_view digits, std::string_view word) const {
    std::int64_t any = 0;
    if (digits.find('/') != std::string_view::npos) fail(line_, input::in_quotes(word), "at most v/vt/vn");
    if (!digits.empty() && !input::parse_number(digits, any))
      fail(line_, input::in_quotes(word), "an index of a normal after the second /");
  }

  /// Indices count from 1; negative ones count back from the latest.
  std::int64_t index(std::string_view digits, std::size_t so_far, std::string_view word) const {
    std::int64_t k = 0;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    if (!input::parse_number(digits, k) || k == 0)
      fail(line_, input::in_quotes(word), "a corner v, v/vt, v//vn or v/vt/vn with indices from 1");
    if (k < 0 && k + std::int64_t(so_far) < 0)
      fail(line_, input::in_quotes(word), fmt::format("at most {} back, that many stand above", so_far));
    return k > 0 ? k - 1 : k + std::int64_t(so_far);
  }

  int line_ = 0;
  ObjRecords records_;
  PassedOver passed_over_;
  std::uint64_t odd_textures_ = 0;
};

} // namespace

ObjRecords read_obj_records(const std::string& path) {
  return RecordReader(path).read();
}

} // namespace hopmesh::scene
