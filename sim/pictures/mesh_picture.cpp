#include "sim/pictures/mesh_picture.h"

#include "sim/files/output_file.h"
#include "sim/pictures/coarse_view.h"
#include "sim/pictures/mesh_shapes.h"
#include "sim/pictures/svg_canvas.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::pictures {
namespace {

constexpr std::uint32_t faint = 0xb4bfcc;

std::string path_of(const Shape& shape) {
  std::string d;
  for (const Seen& p : shape.point) d += fmt::format("{}{:.2f} {:.2f}", d.empty() ? 'M' : 'L', p.x, p.y);
  return d + (shape.point.size() == 3 ? "Z" : "");
}

std::string svg_of(const Shape& shape) {
  if (shape.point.size() == 1)
    return fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"#{:06x}\" stroke=\"none\"/>\n",
                       shape.point[0].x, shape.point[0].y, shape.size, shape.colour);
  if (shape.point.size() == 2)
    return fmt::format("<path d=\"{}\" stroke=\"#{:06x}\" stroke-width=\"{}\" stroke-opacity=\"1\"/>\n",
                       path_of(shape), shape.colour, shape.size);
  return fmt::format("<path d=\"{}\" fill=\"#{:06x}\"/>\n", path_of(shape), shape.colour);
}

std::size_t count_shapes(const RunView& view) {
  std::size_t count = 0;
  MeshShapes(view).end([&](const Shape&) { ++count; });
  return count;
}

// The farthest first, so that what is near lies over it.
void write_shapes(const MeshShapes& shapes, files::OutputFile& file) {
  std::string d;
  shapes.start([&](const Shape& shape) { d += path_of(shape); });
  if (!d.empty())
    file.write(
        fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#{:06x}\" stroke-width=\"1\"/>\n", d, faint));
  std::vector<Shape> end;
  shapes.end([&](const Shape& shape) { end.push_back(shape); });
  std::stable_sort(end.begin(), end.end(),
                   [](const Shape& a, const Shape& b) { return a.nearness() < b.nearness(); });
  file.write("<g stroke=\"#10243c\" stroke-opacity=\"0.4\" stroke-width=\"0.6\" stroke-linejoin=\"round\" "
             "stroke-linecap=\"round\">\n");
  for (const Shape& shape : end) file.write(svg_of(shape));
  file.write("</g>\n");
}

} // namespace

void write_mesh_picture(const RunView& view, const std::filesystem::path& path) {
  RunView coarse;
  const RunView* drawn = &view;
  for (double cubes = 64; count_shapes(*drawn) > most_shapes; cubes /= 1.25)
    drawn = &(coarse = coarse_view(view, cubes));
  const MeshShapes shapes(*drawn);
  files::OutputFile file(path);
  file.write(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
                         "height=\"{1}\">\n<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" "
                         "fill=\"#fff\"/>\n",
                         shapes.width(), shapes.height(), escaped(view.title)));
  write_shapes(shapes, file);
  file.write("</svg>\n");
  file.commit();
}

} // namespace hopmesh::pictures
