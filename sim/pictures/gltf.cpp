// The first frame is the mesh itself; each further frame is a morph target (the differences from the first),
// and the animation moves the weight from one target to the next.
#include "sim/pictures/gltf.h"

#include "sim/files/output_file.h"
#include "sim/pictures/assets.h"
#include "sim/pictures/surface.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <streambuf>
#include <tiny_gltf.h>

namespace hopmesh::pictures {
namespace {

Floats minus(Floats a, const Floats& b) {
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::minus<>());
  return a;
}

/// Lays values into the one buffer, each run in a view of its own on a four-byte boundary.
class Packer {
 public:
  Packer(tinygltf::Model& model, std::size_t bytes) : model_(model) {
    model_.buffers.emplace_back();
    model_.buffers[0].data.reserve(bytes);
  }

  int view(const void* data, std::size_t bytes, int target) {
    auto& store = model_.buffers[0].data;
    store.resize((store.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = store.size();
    view.byteLength = bytes;
    view.target = target;
    const auto* from = static_cast<const unsigned char*>(data);
    store.insert(store.end(), from, from + bytes);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  /// `width` floats an element (1: scalar, 2 and 3: vectors); with_bounds where the standard asks for min and
  /// max.
  int floats(const Floats& values, std::size_t width, int target, bool with_bounds) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view(values.data(), values.size() * sizeof(float), target);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = width == 1 ? TINYGLTF_TYPE_SCALAR : width == 2 ? TINYGLTF_TYPE_VEC2 : TINYGLTF_TYPE_VEC3;
    accessor.count = values.size() / width;
    if (with_bounds) set_bounds(accessor, values, width);
    return add(accessor);
  }

  int indices(const std::vector<std::uint32_t>& values) {
    tinygltf::Accessor accessor;
    accessor.bufferView =
        view(values.data(), values.size() * sizeof values[0], TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = values.size();
    return add(accessor);
  }

 private:
  static void set_bounds(tinygltf::Accessor& accessor, const Floats& values, std::size_t width) {
    accessor.minValues.assign(width, std::numeric_limits<double>::infinity());
    accessor.maxValues.assign(width, -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < values.size(); ++i) {
      accessor.minValues[i % width] = std::min<double>(accessor.minValues[i % width], values[i]);
      accessor.maxValues[i % width] = std::max<double>(accessor.maxValues[i % width], values[i]);
    }
  }
  int add(const tinygltf::Accessor& accessor) {
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  tinygltf::Model& model_;
};

void add_crest(tinygltf::Model& model, Packer& packer, tinygltf::Material& material) {
  const std::string& png = asset("crest.png");
  tinygltf::Image image;
  image.name = "crest";
  image.mimeType = "image/png";
  image.bufferView = packer.view(png.data(), png.size(), 0);
  model.images.push_back(image);
  tinygltf::Sampler sampler;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  model.samplers.push_back(sampler);
  tinygltf::Texture texture;
  texture.source = 0;
  texture.sampler = 0;
  model.textures.push_back(texture);
  material.pbrMetallicRoughness.baseColorTexture.index = 0;
}

void add_material(tinygltf::Model& model, Packer& packer, bool with_crest) {
  tinygltf::Material material;
  material.name = "cloth";
  material.doubleSided = true;
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 0.8;
  if (with_crest)
    add_crest(model, packer, material);
  else
    material.pbrMetallicRoughness.baseColorFactor = {0.18, 0.36, 0.60, 1.0};
  model.materials.push_back(material);
}

void add_animation(tinygltf::Model& model, Packer& packer, const Floats& times) {
  const std::size_t targets = times.size() - 1;
  Floats weights(times.size() * targets, 0.0f);
  for (std::size_t k = 1; k < times.size(); ++k) weights[k * targets + k - 1] = 1.0f;
  tinygltf::AnimationSampler sampler;
  sampler.input = packer.floats(times, 1, 0, true);
  sampler.output = packer.floats(weights, 1, 0, false);
  sampler.interpolation = "LINEAR";
  tinygltf::AnimationChannel channel;
  channel.sampler = 0;
  channel.target_node = 0;
  channel.target_path = "weights";
  tinygltf::Animation animation;
  animation.name = "motion";
  animation.samplers.push_back(sampler);
  animation.channels.push_back(channel);
  model.animations.push_back(animation);
  model.meshes[0].weights.assign(targets, 0.0);
}

tinygltf::Primitive primitive_of(const RunView& view, const std::vector<std::size_t>& frames,
                                 Packer& packer) {
  const Surface surface = surface_of(view);
  constexpr int vertices = TINYGLTF_TARGET_ARRAY_BUFFER;
  const Floats positions = positions_of(view, surface, frames[0]);
  const Floats normals = normals_of(surface, positions, view.nodes);
  tinygltf::Primitive primitive;
  primitive.material = 0;
  primitive.mode = surface.triangles         ? TINYGLTF_MODE_TRIANGLES
                   : surface.indices.empty() ? TINYGLTF_MODE_POINTS
                                             : TINYGLTF_MODE_LINE;
  if (!surface.indices.empty()) primitive.indices = packer.indices(surface.indices);
  primitive.attributes["POSITION"] = packer.floats(positions, 3, vertices, true);
  if (surface.triangles) {
    primitive.attributes["NORMAL"] = packer.floats(normals, 3, vertices, false);
    primitive.attributes["TEXCOORD_0"] = packer.floats(surface.uv, 2, vertices, false);
  }
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const Floats moved = positions_of(view, surface, frames[k]);
    std::map<std::string, int> target;
    target["POSITION"] = packer.floats(minus(moved, positions), 3, vertices, true);
    if (surface.triangles)
      target["NORMAL"] =
          packer.floats(minus(normals_of(surface, moved, view.nodes), normals), 3, vertices, false);
    primitive.targets.push_back(target);
  }
  return primitive;
}

/// A stream into a file, so that a large mesh is not held in memory once more.
class IntoFile : public std::streambuf {
 public:
  explicit IntoFile(files::OutputFile& file) : file_(file) {}

 protected:
  std::streamsize xsputn(const char* data, std::streamsize bytes) override {
    file_.write(data, static_cast<std::size_t>(bytes));
    return bytes;
  }
  int_type overflow(int_type c) override {
    const char byte = traits_type::to_char_type(c);
    if (!traits_type::eq_int_type(c, traits_type::eof())) file_.write(&byte, 1);
    return traits_type::not_eof(c);
  }

 private:
  files::OutputFile& file_;
};

/// JSON is UTF-8: bytes that are not become the replacement character.
std::string valid_utf8(const std::string& text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

} // namespace

std::size_t glb_frames_of(std::size_t nodes) {
  const std::size_t frame_bytes = std::max<std::size_t>(1, 6 * sizeof(float) * nodes);
  return std::clamp<std::size_t>(glb_frame_bytes_at_most / frame_bytes, 2, glb_frames_at_most);
}

std::vector<std::size_t> frames_for_glb(const RunView& view) {
  std::vector<std::size_t> good;
  for (std::size_t f = 0; f < view.frames.size(); ++f) {
    const auto& frame = view.frames[f];
    // A motion that diverged ends in such frames; far beyond 1e18 even the sums of squares overflow in
    // viewers.
    const bool finite = std::all_of(frame.begin(), frame.end(), [](float v) { return std::abs(v) < 1e18f; });
    const bool later =
        good.empty() || static_cast<float>(view.frame_times[f] - view.frame_times[good[0]]) >
                            static_cast<float>(view.frame_times[good.back()] - view.frame_times[good[0]]);
    if (finite && later && frame.size() == view.nodes * 3) good.push_back(f);
  }
  const std::size_t most = glb_frames_of(view.nodes);
  if (good.size() <= most) return good;
  std::vector<std::size_t> picked;
  for (std::size_t k = 0; k < most; ++k) picked.push_back(good[k * (good.size() - 1) / (most - 1)]);
  return picked;
}

void write_glb(const RunView& view, const std::filesystem::path& path) {
  const auto frames = frames_for_glb(view);
  if (frames.empty() || view.nodes == 0)
    throw files::WriteError(fmt::format("{}: no frame of the motion can be drawn", path.string()));
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "Hopmesh";
  // A mesh has about two triangles a node; a vertex is 32 bytes, and 24 more in each further frame.
  Packer packer(model, view.nodes * (56 + 24 * frames.size()) + asset("crest.png").size() + (1u << 16));
  add_material(model, packer, view.crest && !view.triangles.empty());
  tinygltf::Mesh mesh;
  mesh.name = valid_utf8(view.title);
  mesh.primitives.push_back(primitive_of(view, frames, packer));
  model.meshes.push_back(mesh);
  tinygltf::Node node;
  node.name = mesh.name;
  node.mesh = 0;
  if (view.origin != std::array<double, 3>{0, 0, 0}) {
    const auto origin = turned(view.up, view.origin[0], view.origin[1], view.origin[2]);
    node.translation.assign(origin.begin(), origin.end());
  }
  model.nodes.push_back(node);
  tinygltf::Scene scene;
  scene.nodes.push_back(0);
  model.scenes.push_back(scene);
  model.defaultScene = 0;

  Floats times;
  for (const auto f : frames)
    times.push_back(static_cast<float>(view.frame_times[f] - view.frame_times[frames[0]]));
  if (times.size() > 1) add_animation(model, packer, times);

  files::OutputFile file(path);
  IntoFile bytes(file);
  std::ostream stream(&bytes);
  stream.exceptions(std::ios::badbit); // lets the file's own error through
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true))
    throw files::WriteError(fmt::format("{}: the animation cannot be encoded", path.string()));
  file.commit();
}

} // namespace hopmesh::pictures
