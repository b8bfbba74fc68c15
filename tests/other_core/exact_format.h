// Number formats of a core that is not ours: every number is an exact fraction until a register takes it.
// Written from docs/hardware/number-formats.md alone.
#pragma once

#include <sstream>
#include <string>

namespace other {

using Wide = __int128;

struct Format {
  int width = 0, fraction = 0;
  std::string rounding = "SC_TRN", overflow = "SC_WRAP";
};

inline Format format_of(const std::string& text) { // fixed<W,I,Q,O>
  std::string spaced = text.substr(text.find('<') + 1);
  for (char& c : spaced)
    if (c == ',' || c == '>') c = ' ';
  std::istringstream in(spaced);
  Format f;
  int integer_bits = 0;
  in >> f.width >> integer_bits >> f.rounding >> f.overflow;
  f.fraction = f.width - integer_bits;
  return f;
}

// a / b as a whole number, b > 0.
inline Wide rounded(Wide a, Wide b, const std::string& mode) {
  Wide q = a / b, r = a % b;
  if (r < 0) q -= 1, r += b;
  const bool more = 2 * r > b, tie = 2 * r == b;
  bool up = more;
  if (mode == "SC_TRN") up = false;
  if (mode == "SC_TRN_ZERO") up = a < 0 && r != 0;
  if (mode == "SC_RND") up = more || tie;
  if (mode == "SC_RND_ZERO") up = more || (tie && a < 0);
  if (mode == "SC_RND_INF") up = more || (tie && a > 0);
  if (mode == "SC_RND_CONV") up = more || (tie && q % 2 != 0);
  return up ? q + 1 : q;
}

inline Wide in_range(Wide x, const Format& f) {
  const Wide top = (Wide{1} << (f.width - 1)) - 1, bottom = f.overflow == "SC_SAT_SYM" ? -top : -top - 1;
  if (f.overflow == "SC_WRAP") {
    const Wide turn = Wide{1} << f.width;
    x = ((x % turn) + turn) % turn;
    return x > top ? x - turn : x;
  }
  if (x >= bottom && x <= top) return x;
  return f.overflow == "SC_SAT_ZERO" ? 0 : x > top ? top : bottom;
}

// a / b * 2^places as a whole number.
inline Wide scaled(Wide a, Wide b, int places, const std::string& mode) {
  if (places >= 0)
    a *= Wide{1} << places;
  else
    b *= Wide{1} << -places;
  return rounded(a, b, mode);
}

// a / b * 2^places as a code.
inline Wide quantised(Wide a, Wide b, int places, const Format& f) {
  return in_range(scaled(a, b, places, f.rounding), f);
}

inline Wide magnitude(Wide x) {
  return x < 0 ? -x : x;
}

inline Wide low_bits(long word, int width) {
  return in_range(word, Format{width, 0, "SC_TRN", "SC_WRAP"});
}

} // namespace other
