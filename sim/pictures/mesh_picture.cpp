#include "sim/pictures/mesh_picture.h"

#include "sim/files/base64.h"
#include "sim/pictures/mesh_bitmap.h"
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

// The farthest first, so that what is near lies over it.
void write_vectors(const MeshShapes& shapes, std::vector<Shape>& end, files::OutputFile& file) {
  std::string d;
  shapes.start([&](const Shape& shape) { d += path_of(shape); });
  if (!d.empty())
    file.write(
        fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#{:06x}\" stroke-width=\"1\"/>\n", d, faint));
  std::stable_sort(end.begin(), end.end(),
                   [](const Shape& a, const Shape& b) { return a.nearness() < b.nearness(); });
  file.write("<g stroke=\"#10243c\" stroke-opacity=\"0.4\" stroke-width=\"0.6\" stroke-linejoin=\"round\" "
             "stroke-linecap=\"round\">\n");
  for (const Shape& shape : end) file.write(svg_of(shape));
  file.write("</g>\n");
}

void write_bitmap(const MeshShapes& shapes, files::OutputFile& file) {
  file.write(fmt::format("<image width=\"{}\" height=\"{}\" href=\"data:image/png;base64,", shapes.width(),
                         shapes.height()));
  const std::string png = files::encode_png(bitmap_of(shapes, 2, faint));
  files::Base64Writer digits(file);
  digits.bytes(png.data(), png.size());
  digits.end();
  file.write("\"/>\n");
}

} // namespace

void write_mesh_picture(const RunView& view, const std::filesystem::path& path) {
  const MeshShapes shapes(view);
  std::vector<Shape> few;
  shapes.end([&](const Shape& shape) {
    if (few.size() <= most_vectors) few.push_back(shape);
  });
  files::OutputFile file(path);
  file.write(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
                         "height=\"{1}\">\n<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" "
                         "fill=\"#fff\"/>\n",
                         shapes.width(), shapes.height(), escaped(view.title)));
  if (few.size() <= most_vectors)
    write_vectors(shapes, few, file);
  else
    write_bitmap(shapes, file);
  file.write("</svg>\n");
  file.commit();
}

} // namespace hopmesh::pictures
