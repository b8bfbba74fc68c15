#include "tests/support/vcd.h"

#include <fstream>
#include <sstream>

namespace hopmesh::tests {
namespace {

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : in_(file) {
    if (!in_) throw std::runtime_error("cannot read " + file.string());
  }

  Vcd read() {
    header();
    std::string word;
    while (in_ >> word) value_or_time(word);
    return vcd_;
  }

 private:
  [[noreturn]] static void bad(const std::string& what) { throw std::runtime_error("no VCD: " + what); }

  std::vector<std::string> until_end() {
    std::vector<std::string> words;
    std::string word;
    while (in_ >> word && word != "$end") words.push_back(word);
    if (word != "$end") bad("a section without $end");
    return words;
  }

  void header() {
    std::string word;
    std::vector<std::string> scope;
    while (in_ >> word && word != "$enddefinitions") {
      const auto words = until_end();
      if (word == "$timescale") set_timescale(words);
      if (word == "$scope") scope.push_back(words.at(1));
      if (word == "$upscope") scope.pop_back();
      if (word == "$var") add(words, scope);
    }
    if (word != "$enddefinitions" || !until_end().empty() || !scope.empty())
      bad("its definitions do not end");
    if (unit_ == 0) bad("no time scale");
  }

  void set_timescale(const std::vector<std::string>& words) {
    std::string text;
    for (const auto& w : words) text += w;
    std::istringstream in(text);
    std::string unit;
    if (!(in >> unit_ >> unit) || (unit != "ps" && unit != "ns" && unit != "us")) bad("time scale " + text);
    unit_ *= unit == "ps" ? 1 : unit == "ns" ? 1000 : 1000000;
  }

  /// wire 16 aaab V [15:0]
  void add(const std::vector<std::string>& words, const std::vector<std::string>& scope) {
    std::string name;
    for (const auto& s : scope) name += s + ".";
    name += words.at(3);
    if (vcd_.signals.count(name) || by_code_.count(words[2])) bad(name + " twice");
    Vcd::Signal& s = vcd_.signals[name];
    s.width = std::stoi(words[1]);
    by_code_[words[2]] = &s;
  }

  void value_or_time(const std::string& word) {
    if (word == "$comment") return void(until_end());
    if (word == "$dumpvars") return void(initial_ = true);
    if (word == "$end" && initial_) return void(initial_ = false);
    if (word[0] == '#') return time(std::stoull(word.substr(1)) * unit_);
    std::string digits = word.substr(0, 1), code = word.substr(1);
    if (word[0] == 'b') digits = code, in_ >> code;
    const auto found = by_code_.find(code);
    if (found == by_code_.end() || digits.find_first_not_of("01") != std::string::npos)
      bad(word + " " + code);
    note(*found->second, value_of(digits, found->second->width));
  }

  void time(std::uint64_t picoseconds) {
    if (!vcd_.times.empty() && picoseconds <= vcd_.times.back())
      bad("time goes back to " + std::to_string(picoseconds));
    vcd_.times.push_back(picoseconds);
  }

  void note(Vcd::Signal& s, std::int64_t value) {
    if (initial_) return void(s.initial = value);
    if (vcd_.times.empty()) bad("a change before the first time");
    if (value == s.last()) bad("a change that is none");
    s.changes.push_back({vcd_.times.back(), value});
  }

  /// Leading zeros are left out; a full width that begins with 1 is negative, unless it is a single wire.
  static std::int64_t value_of(const std::string& digits, int width) {
    if (digits.size() > static_cast<std::size_t>(width)) bad(digits + " is wider than its signal");
    const bool negative = width > 1 && digits.size() == static_cast<std::size_t>(width) && digits[0] == '1';
    std::uint64_t value = negative ? ~std::uint64_t{0} : 0;
    for (char c : digits) value = value << 1 | static_cast<std::uint64_t>(c == '1');
    return static_cast<std::int64_t>(value);
  }

  std::ifstream in_;
  Vcd vcd_;
  std::map<std::string, Vcd::Signal*> by_code_;
  std::uint64_t unit_ = 0;
  bool initial_ = false;
};

} // namespace

std::vector<std::uint64_t> Vcd::Signal::rises() const {
  std::vector<std::uint64_t> times;
  for (const Change& c : changes)
    if (c.value == 1) times.push_back(c.picoseconds);
  return times;
}

const Vcd::Signal& Vcd::at(const std::string& ending) const {
  const Signal* found = nullptr;
  for (const auto& [name, signal] : signals) {
    if (name.size() < ending.size() || name.compare(name.size() - ending.size(), ending.size(), ending) != 0)
      continue;
    if (found) throw std::runtime_error(ending + " is not one signal");
    found = &signal;
  }
  if (!found) throw std::runtime_error("no signal " + ending);
  return *found;
}

Vcd read_vcd(const std::filesystem::path& file) {
  return Reader(file).read();
}

} // namespace hopmesh::tests
