// Fills the page's template. Everything of the run travels in one JSON block, read by the page's own scripts,
// which put it on the page as text only; so no name or message of a run can become markup or code.
#include "sim/record/report.h"

#include "sim/record/crest.h"
#include "sim/record/output_file.h"
#include "sim/record/report_assets.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

namespace hopmesh::record {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "typed arrays in browsers are little endian");

std::string base64(const void* data, std::size_t bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* in = static_cast<const unsigned char*>(data);
  std::string out;
  out.reserve((bytes + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes; i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes - i);
    const unsigned group = in[i] << 16 | (left > 1 ? in[i + 1] << 8 : 0) | (left > 2 ? in[i + 2] : 0);
    for (std::size_t k = 0; k < 4; ++k) out += k <= left ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}

template <class T> std::string base64(const std::vector<T>& values) {
  return base64(values.data(), values.size() * sizeof(T));
}

void put_mesh(nlohmann::json& run, const RunView& view) {
  std::vector<std::uint32_t> triangles, springs;
  std::vector<float> uv, rest_lengths;
  for (const auto& triangle : view.triangles)
    for (const ViewCorner& corner : triangle) {
      triangles.push_back(corner.node);
      uv.insert(uv.end(), {corner.u, corner.v});
    }
  for (const ViewSpring& spring : view.springs) {
    springs.insert(springs.end(), {spring.node[0], spring.node[1]});
    rest_lengths.push_back(spring.rest_length);
  }
  run["nodes"] = view.nodes;
  run["triangles"] = base64(triangles);
  run["uv"] = base64(uv);
  run["springs"] = base64(springs);
  run["restLengths"] = base64(rest_lengths);
  run["pinned"] = nlohmann::json::array();
  for (std::size_t n = 0; n < view.pinned.size(); ++n)
    if (view.pinned[n]) run["pinned"].push_back(n);
  const bool crest = view.crest && !view.triangles.empty();
  const std::string png = crest ? flag_crest() : "";
  run["crest"] = crest ? "data:image/png;base64," + base64(png.data(), png.size()) : "";
}

void put_motion(nlohmann::json& run, const RunView& view) {
  std::vector<float> frames;
  frames.reserve(view.frames.size() * view.nodes * 3);
  for (const auto& frame : view.frames) frames.insert(frames.end(), frame.begin(), frame.end());
  run["up"] = view.up;
  run["frames"] = base64(frames);
  run["frameTimes"] = base64(view.frame_times);
  run["frameSteps"] = base64(view.frame_steps);
  run["stepTimes"] = base64(view.step_times);
  run["series"] = nlohmann::json::array();
  for (const Series& series : view.series)
    run["series"].push_back(
        {{"name", series.name}, {"unit", series.unit}, {"values", base64(series.values)}});
}

void put_words(nlohmann::json& run, const RunView& view) {
  run["title"] = view.title;
  run["subtitle"] = view.subtitle;
  run["outcome"] = view.outcome;
  run["good"] = view.good;
  run["manifest"] = view.manifest;
  run["tables"] = nlohmann::json::array();
  for (const auto& [title, figures] : view.tables) {
    auto rows = nlohmann::json::array();
    for (const Figure& figure : figures) rows.push_back({figure.name, figure.value});
    run["tables"].push_back({{"title", title}, {"figures", rows}});
  }
}

/// JSON in ASCII without < > &: nothing in it can end the script element it stands in.
std::string data_block(const RunView& view) {
  nlohmann::json run;
  put_words(run, view);
  put_mesh(run, view);
  put_motion(run, view);
  const std::string text = run.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size() + 64);
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else if (c == '>')
      safe += "\\u003e";
    else if (c == '&')
      safe += "\\u0026";
    else
      safe += c;
  }
  return safe;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const char* const entity = c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : nullptr;
    entity ? out += entity : out += c;
  }
  return out;
}

std::string three_library(const std::filesystem::path& folder) {
  std::ifstream file(folder / "three.min.js", std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  // In a script "<\/" means the same as "</", but does not end the element.
  for (std::size_t at = 0; (at = text.find("</script", at)) != std::string::npos;) text.insert(at + 1, "\\");
  if (text.empty()) return "// three.js was not found: the page draws on a 2-D canvas.";
  return report_assets().at("three_license.js") + text;
}

/// The page's scripts share one scope that nothing outside can see.
std::string script() {
  std::string text = "(function () {\n\"use strict\";\n";
  for (const char* name :
       {"data.js", "camera.js", "surface.js", "view_webgl.js", "view_canvas.js", "charts.js", "page.js"})
    text += "\n" + report_assets().at(name);
  return text + "})();\n";
}

/// One walk over the template: what is put in is never looked at for further {{names}}.
std::string fill(const std::string& page, const std::map<std::string, std::string>& parts) {
  std::string out;
  std::size_t at = 0;
  for (std::size_t open; (open = page.find("{{", at)) != std::string::npos;) {
    const std::size_t close = page.find("}}", open);
    out += page.substr(at, open - at) + parts.at(page.substr(open + 2, close - open - 2));
    at = close + 2;
  }
  return out + page.substr(at);
}

} // namespace

void write_report(const RunView& view, const std::filesystem::path& path,
                  const std::filesystem::path& three_folder) {
  write_file(path, fill(report_assets().at("report.html"), {{"title", escaped(view.title)},
                                                            {"css", report_assets().at("report.css")},
                                                            {"data", data_block(view)},
                                                            {"three", three_library(three_folder)},
                                                            {"script", script()}}));
}

} // namespace hopmesh::record
