// The engine's figures against what was asked of it, and the roofline as a picture: from the files of
// bench_rtl and bench_engine.
#include "tests/bench/tables/bench_results.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>

namespace hopmesh::bench {
namespace {

constexpr double products_an_update = 27; ///< inputs of an inner neuron: the bias is no product

double updates(const Results& r, const std::string& name) {
  return r.median(name, "updates/s");
}

void row(const std::string& what, const std::string& asked, const std::string& measured, bool met) {
  fmt::print("  {:<64} | {:>10} | {:>9} | {}\n", what, asked, measured, met ? "yes" : "no");
}

void ratio(const std::string& what, double measured, double least, double reach) {
  row(what, fmt::format("{:g}x/{:g}x", least, reach), fmt::format("{:.3g}x", measured), measured >= least);
}

void share(const std::string& what, double measured, double least, double reach) {
  row(what, fmt::format("{:g}/{:g} %", 100 * least, 100 * reach), fmt::format("{:.0f} %", 100 * measured),
      measured >= least);
}

/// Names that are numbers, ascending: turns alternate at random, so their order in the file says nothing.
std::vector<std::string> sizes(const Results& r, const std::string& prefix) {
  std::vector<std::string> names = r.names(prefix);
  std::sort(names.begin(), names.end(), [](auto& a, auto& b) { return std::stoul(a) < std::stoul(b); });
  return names;
}

double stream_of(const Results& r, const std::string& name) {
  return updates(r, name) * r.median(name, "bytes/update");
}

void print_ratios(const Results& r) {
  const double engine = updates(r, "flag-400 rtl/engine");
  ratio("engine / RTL, Verilator", engine / updates(r, "flag-400 rtl/RTL, Verilator"), 60, 150);
  ratio("engine / SystemC, by phase", engine / updates(r, "flag-400 rtl/SystemC, by phase"), 50, 150);
  ratio("clock by clock, every register / RTL, Verilator",
        r.median("clocked/one by one", "cycles/s") / r.median("flag-400 rtl/RTL, Verilator", "cycles/s"), 10,
        25);
  ratio("engine / Eigen double reference", updates(r, "plain/400") / updates(r, "reference/double, Eigen"),
        15, 35);
  for (const char* sweeps : {"8", "16"})
    ratio(fmt::format("10^6 nodes, {} sweeps following each other / plain sweeps", sweeps),
          updates(r, fmt::format("followed 1000000/{}", sweeps)) / updates(r, "plain/1000000"), 2, 3.5);
  ratio("two threads / one at 10^4 nodes", updates(r, "threads 10000/2") / updates(r, "threads 10000/1"), 1.7,
        1.95);
  ratio("folded / one neuron an element", updates(r, "array/folded") / updates(r, "plain/400"), 0.8, 1);
  for (const char* array : {"kernel/generic", "array/32 bits", "array/rounding accumulator"})
    ratio(fmt::format("generic path / fast kernel, {}", array), updates(r, array) / updates(r, "plain/400"),
          0.05, 0.1);
}

/// From 225 nodes to 10^6, as `run` takes them: there 16 sweeps follow each other.
void print_flatness(const Results& r) {
  const double factor = updates(r, "plain/225") / updates(r, "followed 1000000/16");
  row("cost of an update at 10^6 nodes / at 225", "at most 4x", fmt::format("{:.3g}x", factor), factor <= 4);
}

void print_shares(const Results& r) {
  const double peak = r.median("roof multiply-add/int16", "products/s");
  for (const char* size : {"400", "1600"})
    share(fmt::format("of the int16 multiply-add peak, {} nodes", size),
          updates(r, fmt::format("plain/{}", size)) * products_an_update / peak, 0.15, 0.27);
  share("of the read bandwidth of L3 (2.5 MiB), 10^4 nodes",
        stream_of(r, "plain/10000") / r.median("roof read KiB/2560", "bytes/s"), 0.7, 0.9);
  share("of the read bandwidth of memory (256 MiB), 10^6 nodes",
        stream_of(r, "plain/1000000") / r.median("roof read KiB/262144", "bytes/s"), 0.7, 0.9);
}

void print_curve(const Results& r) {
  fmt::print("\n  {:>9} | {:>12} | {:>12} | {:>10}\n", "nodes", "updates/s", "ns/update", "GB/s");
  for (const std::string& size : sizes(r, "plain"))
    fmt::print("  {:>9} | {:>12.3g} | {:>12.3f} | {:>10.1f}\n", size, updates(r, "plain/" + size),
               1e9 / updates(r, "plain/" + size), stream_of(r, "plain/" + size) / 1e9);
  fmt::print("\n  {:<28} | {:>12}\n", "variant, 400 nodes", "updates/s");
  for (const char* group : {"kernel", "array"})
    for (const std::string& name : r.names(group))
      fmt::print("  {:<28} | {:>12.3g}\n", fmt::format("{}/{}", group, name),
                 updates(r, fmt::format("{}/{}", group, name)));
  fmt::print("\n  {:<28} | {:>12}\n", "roof", "GB/s");
  for (const std::string& size : sizes(r, "roof read KiB"))
    fmt::print("  {:<28} | {:>12.0f}\n", size + " KiB", r.median("roof read KiB/" + size, "bytes/s") / 1e9);
}

// ---- picture: products a second over products a byte, both logarithmic

constexpr int first_octave = -4, last_octave = 4; ///< of products a byte
const double rightmost = std::exp2(last_octave);

struct Frame {
  double left = 70, top = 40, width = 560, height = 300;
  double x(double products_a_byte) const {
    return left + width * (std::log2(products_a_byte) - first_octave) / (last_octave - first_octave);
  }
  double y(double products) const { return top + height * (1 - (std::log10(products) - 9) / 3); }
};

std::string roof_line(const Frame& f, double bytes, double peak, const std::string& name) {
  const double knee = std::min(rightmost, peak / bytes), low = std::max(std::exp2(first_octave), 1e9 / bytes);
  return fmt::format("<polyline points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\" fill=\"none\" "
                     "stroke=\"#888888\"/>\n<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"#555555\" "
                     "font-size=\"11\">{} {:.0f} GB/s</text>\n",
                     f.x(low), f.y(low * bytes), f.x(knee), f.y(knee * bytes), f.x(rightmost),
                     f.y(std::min(peak, rightmost * bytes)), f.x(0.07) + 4, f.y(0.07 * bytes) - 6, name,
                     bytes / 1e9);
}

std::string dot(const Frame& f, double products_a_byte, double products, const std::string& name,
                const char* colour) {
  return fmt::format("<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"5\" fill=\"{2}\"/>\n<text x=\"{3:.1f}\" "
                     "y=\"{4:.1f}\" fill=\"{2}\" font-size=\"12\">{5}</text>\n",
                     f.x(products_a_byte), f.y(products), colour, f.x(products_a_byte) + 9, f.y(products) + 4,
                     name);
}

std::string picture(const Results& r) {
  const Frame f;
  const double peak = r.median("roof multiply-add/int16", "products/s");
  std::string svg =
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"680\" height=\"400\" viewBox=\"0 0 680 "
                  "400\" role=\"img\" "
                  "font-family=\"sans-serif\" font-size=\"13\">\n<title>Roofline of the engine</title>\n"
                  "<rect width=\"680\" height=\"400\" rx=\"6\" fill=\"#ffffff\"/>\n<text x=\"{}\" y=\"22\" "
                  "font-weight=\"bold\" fill=\"#222222\">Roofline: 16-bit products a second over products a "
                  "byte</text>\n",
                  f.left);
  for (int k = 9; k <= 12; ++k)
    svg +=
        fmt::format("<line x1=\"{0}\" y1=\"{1:.1f}\" x2=\"{2}\" y2=\"{1:.1f}\" stroke=\"#e4e4e4\"/>\n<text "
                    "x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\" fill=\"#666666\">{5} G/s</text>\n",
                    f.left, f.y(std::pow(10, k)), f.left + f.width, f.left - 6, f.y(std::pow(10, k)) + 4,
                    std::pow(10, k - 9));
  for (int k = first_octave; k <= last_octave; ++k)
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\" fill=\"#666666\">{}</text>\n",
                       f.x(std::pow(2, k)), f.top + f.height + 20,
                       k < 0 ? fmt::format("1/{}", 1 << -k) : std::to_string(1 << k));
  const std::pair<const char*, const char*> caches[] = {
      {"32", "L1"}, {"384", "L2"}, {"2560", "L3"}, {"262144", "memory"}};
  for (const auto& [kib, name] : caches)
    svg += roof_line(f, r.median(std::string("roof read KiB/") + kib, "bytes/s"), peak, name);
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\" fill=\"#555555\" font-size=\"11\">"
                     "multiply-add peak {:.0f} G/s</text>\n",
                     f.left + f.width, f.y(peak) - 6, peak / 1e9);
  for (const std::string& size : sizes(r, "plain"))
    svg += dot(f, products_an_update / r.median("plain/" + size, "bytes/update"),
               updates(r, "plain/" + size) * products_an_update,
               size == "10000" || size == "1000000" || size == "1600" ? size + " nodes" : "", "#1f5fa8");
  const double followed = updates(r, "followed 1000000/16") * products_an_update;
  svg += dot(f, 16 * products_an_update / r.median("plain/1000000", "bytes/update"), followed,
             "10^6, 16 sweeps", "#b0541b");
  return svg + "</svg>\n";
}

void print_all(const Results& r, const std::string& picture_file) {
  fmt::print("\n  {:<64} | {:>10} | {:>9} | met?\n", "engine", "asked", "measured");
  print_ratios(r);
  print_flatness(r);
  print_shares(r);
  print_curve(r);
  if (!picture_file.empty()) std::ofstream(picture_file) << picture(r);
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  return hopmesh::bench::print_tables(argc, argv, 2, "engine_table RTL.json ENGINE.json [ROOFLINE.svg]",
                                      hopmesh::bench::print_all);
}
