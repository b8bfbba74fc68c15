#include "sim/files/png.h"

#include <png.h>
#include <stdexcept>

namespace hopmesh::files {
namespace {

void write_to_string(png_structp png, png_bytep data, png_size_t bytes) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(data), bytes);
}

} // namespace

std::string encode_png(const Picture& picture) {
  std::string file;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) throw std::runtime_error("libpng cannot start");
  if (setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    throw std::runtime_error("libpng cannot encode the picture");
  }
  png_set_write_fn(png, &file, write_to_string, nullptr);
  png_set_compression_level(png, 5);
  png_set_IHDR(png, info, picture.width, picture.height, 8, PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (std::uint32_t y = 0; y < picture.height; ++y)
    png_write_row(png, picture.rgba.data() + std::size_t{y} * picture.width * 4);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return file;
}

} // namespace hopmesh::files
