// Fills the page's template. Everything of the run travels in one JSON block, read by the page's own scripts,
// which put it on the page as text only; so no name or message of a run can become markup or code.
#include "sim/pictures/report.h"

#include "sim/pictures/assets.h"
#include "sim/pictures/base64.h"
#include "sim/pictures/svg_canvas.h"

#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

namespace hopmesh::pictures {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "typed arrays in browsers are little endian");

/// JSON in ASCII without < > &: nothing in it can end the script element it stands in.
std::string safe(const nlohmann::json& json) {
  const std::string text = json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size() + 64);
  for (const char c : text) {
    const char* const code = c == '<' ? "\\u003c" : c == '>' ? "\\u003e" : c == '&' ? "\\u0026" : nullptr;
    code ? out += code : out += c;
  }
  return out;
}

/// The object's text without its closing brace, so that members can follow.
std::string opened(const nlohmann::json& object) {
  std::string text = safe(object);
  text.pop_back();
  return text;
}

/// A further member of an object that has some. Large arrays go straight into the file, as base64 digits,
/// which need no escaping.
template <class Fill> void put_array(files::OutputFile& file, std::string_view name, Fill fill) {
  file.write(",\"");
  file.write(name);
  file.write("\":\"");
  Base64Writer digits(file);
  fill(digits);
  digits.end();
  file.write("\"");
}

template <class T>
void put_array(files::OutputFile& file, std::string_view name, const std::vector<T>& values) {
  put_array(file, name, [&](Base64Writer& out) { out.values(values); });
}

void put_mesh(files::OutputFile& file, const RunView& view) {
  put_array(file, "triangles", [&](Base64Writer& out) {
    for (const auto& triangle : view.triangles)
      for (const ViewCorner& corner : triangle) out.value(corner.node);
  });
  put_array(file, "uv", [&](Base64Writer& out) {
    for (const auto& triangle : view.triangles)
      for (const ViewCorner& corner : triangle) out.value(corner.u), out.value(corner.v);
  });
  put_array(file, "springs", [&](Base64Writer& out) {
    for (const ViewSpring& spring : view.springs) out.value(spring.node);
  });
  put_array(file, "restLengths", [&](Base64Writer& out) {
    for (const ViewSpring& spring : view.springs) out.value(spring.rest_length);
  });
}

void put_motion(files::OutputFile& file, const RunView& view) {
  put_array(file, "frames", [&](Base64Writer& out) {
    for (const auto& frame : view.frames) out.values(frame);
  });
  put_array(file, "frameTimes", view.frame_times);
  put_array(file, "frameSteps", view.frame_steps);
  put_array(file, "stepTimes", view.step_times);
  file.write(",\"series\":[");
  for (const Series& series : view.series) {
    file.write((&series == view.series.data() ? "" : ",") +
               opened({{"name", series.name}, {"unit", series.unit}}));
    put_array(file, "values", series.values);
    file.write("}");
  }
  file.write("]");
}

nlohmann::json words_of(const RunView& view) {
  nlohmann::json run{{"title", view.title}, {"subtitle", view.subtitle}, {"outcome", view.outcome},
                     {"good", view.good},   {"rested", view.rested},     {"manifest", view.manifest},
                     {"up", view.up},       {"nodes", view.nodes}};
  run["pinned"] = nlohmann::json::array();
  for (std::size_t n = 0; n < view.pinned.size(); ++n)
    if (view.pinned[n]) run["pinned"].push_back(n);
  run["drawings"] = nlohmann::json::array();
  for (const Drawing& drawing : view.drawings)
    run["drawings"].push_back({{"title", drawing.title}, {"svg", drawing.svg}});
  run["tables"] = nlohmann::json::array();
  for (const auto& [title, figures] : view.tables) {
    auto rows = nlohmann::json::array();
    for (const Figure& figure : figures) rows.push_back({figure.name, figure.value});
    run["tables"].push_back({{"title", title}, {"figures", rows}});
  }
  return run;
}

void put_data(files::OutputFile& file, const RunView& view) {
  file.write(opened(words_of(view)));
  file.write(",\"crest\":\"");
  if (view.crest && !view.triangles.empty()) {
    file.write("data:image/png;base64,");
    Base64Writer digits(file);
    digits.bytes(asset("crest.png").data(), asset("crest.png").size());
    digits.end();
  }
  file.write("\"");
  put_mesh(file, view);
  put_motion(file, view);
  file.write("}");
}

void put_three(files::OutputFile& file, const std::filesystem::path& folder) {
  std::error_code absent;
  const auto bytes = std::filesystem::file_size(folder / "three.min.js", absent);
  std::string text(absent ? 0 : bytes, ' ');
  std::ifstream source(folder / "three.min.js", std::ios::binary);
  source.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(source.gcount()));
  if (text.empty()) return file.write("// three.js was not found: the page draws on a 2-D canvas.");
  file.write(asset("three_license.js"));
  // In a script "<\/" means the same as "</", but does not end the element.
  std::size_t begin = 0;
  for (std::size_t at; (at = text.find("</script", begin)) != std::string::npos; begin = at + 1) {
    file.write(std::string_view(text).substr(begin, at + 1 - begin));
    file.write("\\");
  }
  file.write(std::string_view(text).substr(begin));
}

/// The page's scripts share one scope that nothing outside can see.
void put_script(files::OutputFile& file) {
  file.write("(function () {\n\"use strict\";\n");
  for (const char* name :
       {"data.js", "camera.js", "surface.js", "view_webgl.js", "view_canvas.js", "charts.js", "page.js"}) {
    file.write("\n");
    file.write(asset(name));
  }
  file.write("})();\n");
}

using Parts = std::map<std::string, std::function<void(files::OutputFile&)>>;

/// Fills in the template's {{names}}; what is put in is not searched for further ones.
void fill(files::OutputFile& file, const std::string& page, const Parts& parts) {
  std::size_t at = 0;
  for (std::size_t open; (open = page.find("{{", at)) != std::string::npos;) {
    const std::size_t close = page.find("}}", open);
    file.write(std::string_view(page).substr(at, open - at));
    parts.at(page.substr(open + 2, close - open - 2))(file);
    at = close + 2;
  }
  file.write(std::string_view(page).substr(at));
}

} // namespace

void write_report(const RunView& view, const std::filesystem::path& path,
                  const std::filesystem::path& three_folder) {
  files::OutputFile page(path);
  fill(page, asset("report.html"),
       {{"title", [&](files::OutputFile& file) { file.write(escaped(view.title)); }},
        {"css", [](files::OutputFile& file) { file.write(asset("report.css")); }},
        {"data", [&](files::OutputFile& file) { put_data(file, view); }},
        {"three", [&](files::OutputFile& file) { put_three(file, three_folder); }},
        {"script", put_script}});
  page.commit();
}

} // namespace hopmesh::pictures
