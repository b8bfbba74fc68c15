// mesh.glb read back by the library's own loader, and held against the rules of glTF 2.0 that viewers depend
// on.
#include "sim/files/output_file.h"
#include "sim/pictures/gltf.h"
#include "tests/pictures/sample_run.h"
#include "tests/support/files.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <tiny_gltf.h>

namespace hopmesh::tests {
namespace {

using namespace pictures;

tinygltf::Model loaded(const RunView& view) {
  const Folder folder;
  write_glb(view, folder / "mesh.glb");
  tinygltf::Model model;
  std::string errors, warnings;
  const std::string file = content_of(folder / "mesh.glb");
  EXPECT_EQ(file.size() % 4, 0u);
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model, &errors, &warnings,
                                                        reinterpret_cast<const unsigned char*>(file.data()),
                                                        static_cast<unsigned>(file.size())));
  EXPECT_EQ(errors + warnings, "");
  return model;
}

std::vector<float> floats_of(const tinygltf::Model& model, int index) {
  const auto& accessor = model.accessors[static_cast<std::size_t>(index)];
  const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  const auto width =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  std::vector<float> values(accessor.count * width);
  EXPECT_EQ(view.byteLength, values.size() * sizeof(float));
  std::memcpy(values.data(), model.buffers[0].data.data() + view.byteOffset, view.byteLength);
  return values;
}

const tinygltf::Primitive& primitive_of(const tinygltf::Model& model) {
  return model.meshes.at(0).primitives.at(0);
}

TEST(Gltf, HoldsMeshMaterialAndMotion) {
  const auto model = loaded(sample_run(20, 240));
  const auto& primitive = primitive_of(model);
  EXPECT_EQ(model.asset.version, "2.0");
  EXPECT_EQ(model.accessors[static_cast<std::size_t>(primitive.indices)].count, 19u * 19u * 2u * 3u);
  EXPECT_EQ(floats_of(model, primitive.attributes.at("POSITION")).size(), 400u * 3u);
  EXPECT_EQ(floats_of(model, primitive.attributes.at("TEXCOORD_0")).size(), 400u * 2u);
  EXPECT_TRUE(model.materials.at(0).doubleSided);
  EXPECT_EQ(model.images.at(0).width, 512) << "the crest is inside the file";
  EXPECT_EQ(primitive.targets.size(), glb_frames_at_most - 1);
  EXPECT_EQ(model.animations.at(0).channels.at(0).target_path, "weights");
}

TEST(Gltf, EachKeyShowsItsFrame) {
  const RunView view = sample_run(5, 9);
  const auto model = loaded(view);
  const auto& sampler = model.animations.at(0).samplers.at(0);
  const auto times = floats_of(model, sampler.input), weights = floats_of(model, sampler.output);
  const auto base = floats_of(model, primitive_of(model).attributes.at("POSITION"));
  ASSERT_EQ(times.size(), 9u);
  ASSERT_EQ(weights.size(), 9u * 8u);
  for (std::size_t key = 0; key < 9; ++key) {
    EXPECT_FLOAT_EQ(times[key], static_cast<float>(view.frame_times[key]));
    std::vector<float> shown = base;
    for (std::size_t t = 0; t < 8; ++t) {
      const auto delta = floats_of(model, primitive_of(model).targets[t].at("POSITION"));
      for (std::size_t i = 0; i < shown.size(); ++i) shown[i] += weights[key * 8 + t] * delta[i];
    }
    // Vertices come in the order in which the triangles name them; vertex 0 is node 0. z-up turns to y-up.
    EXPECT_NEAR(shown[0], view.frames[key][0], 1e-5);
    EXPECT_NEAR(shown[1], view.frames[key][2], 1e-5);
    EXPECT_NEAR(shown[2], -view.frames[key][1], 1e-5);
  }
}

TEST(Gltf, BoundsAreThoseOfTheValues) {
  const auto model = loaded(sample_run(8, 6));
  std::vector<int> bounded{primitive_of(model).attributes.at("POSITION"),
                           model.animations[0].samplers[0].input};
  for (const auto& target : primitive_of(model).targets) bounded.push_back(target.at("POSITION"));
  for (const int index : bounded) {
    const auto& accessor = model.accessors[static_cast<std::size_t>(index)];
    const auto values = floats_of(model, index);
    const std::size_t width = accessor.minValues.size();
    ASSERT_EQ(width, accessor.type == TINYGLTF_TYPE_SCALAR ? 1u : 3u);
    for (std::size_t k = 0; k < width; ++k) {
      float low = std::numeric_limits<float>::infinity(), high = -low;
      for (std::size_t i = k; i < values.size(); i += width) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
      }
      EXPECT_EQ(static_cast<float>(accessor.minValues[k]), low);
      EXPECT_EQ(static_cast<float>(accessor.maxValues[k]), high);
    }
  }
}

TEST(Gltf, KeepsTheRulesOfTheStandard) {
  const auto model = loaded(sample_run(8, 6));
  std::size_t end = 0;
  for (const auto& view : model.bufferViews) {
    EXPECT_EQ(view.byteOffset % 4, 0u);
    EXPECT_GE(view.byteOffset, end) << "views overlap";
    end = view.byteOffset + view.byteLength;
  }
  EXPECT_LE(end, model.buffers.at(0).data.size());
  const auto target_of = [&](int accessor) {
    return model
        .bufferViews[static_cast<std::size_t>(model.accessors[static_cast<std::size_t>(accessor)].bufferView)]
        .target;
  };
  EXPECT_EQ(target_of(primitive_of(model).indices), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  EXPECT_EQ(target_of(primitive_of(model).attributes.at("POSITION")), TINYGLTF_TARGET_ARRAY_BUFFER);
  EXPECT_EQ(target_of(model.animations[0].samplers[0].input), 0);
  const auto times = floats_of(model, model.animations[0].samplers[0].input);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end(), std::less_equal<>())) << "strictly rising";
  const auto normals = floats_of(model, primitive_of(model).attributes.at("NORMAL"));
  for (std::size_t i = 0; i < normals.size(); i += 3)
    EXPECT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1.0f, 1e-5f);
}

TEST(Gltf, VerticesSplitWhereThePictureJumps) {
  RunView view = sample_run(3, 1);
  view.triangles[0][0].u = 0.5f; // node 0 now has two places in the picture
  const auto model = loaded(view);
  EXPECT_EQ(floats_of(model, primitive_of(model).attributes.at("POSITION")).size(), 10u * 3u);
  EXPECT_TRUE(model.animations.empty()) << "one frame is no motion";
}

TEST(Gltf, FramesArePickedEvenlyAndOnlyFiniteOnes) {
  RunView view = sample_run(3, 100);
  const auto picked = frames_for_glb(view);
  ASSERT_EQ(picked.size(), glb_frames_at_most);
  EXPECT_EQ(picked.front(), 0u);
  EXPECT_EQ(picked.back(), 99u);
  for (std::size_t f = 40; f < 100; ++f) view.frames[f][5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(frames_for_glb(view).size(), 40u);
  EXPECT_EQ(loaded(view).meshes[0].primitives[0].targets.size(), 39u);
}

TEST(Gltf, LargeMeshesKeepFewerFramesWithinABudgetButTwoAtLeast) {
  EXPECT_EQ(glb_frames_of(400), glb_frames_at_most);
  EXPECT_EQ(glb_frames_of(0), glb_frames_at_most);
  std::size_t before = glb_frames_at_most;
  for (std::size_t nodes = 1000; nodes <= 1000000; nodes += 333) {
    const std::size_t frames = glb_frames_of(nodes);
    EXPECT_LE(frames, before);
    EXPECT_GE(frames, 2u);
    if (frames > 2) {
      EXPECT_LE(frames * nodes * 24, glb_frame_bytes_at_most) << nodes; // six floats a node
    }
    if (frames < glb_frames_at_most) {
      EXPECT_GT((frames + 1) * nodes * 24, glb_frame_bytes_at_most) << nodes;
    }
    before = frames;
  }
  EXPECT_EQ(before, 2u);
}

TEST(Gltf, ALargeMeshKeepsFirstAndLast) {
  const std::size_t side = 240; // 57,600 nodes: 48 frames
  RunView view = sample_run(side, 1, 1);
  for (int f = 1; f < 60; ++f) view.frames.push_back(view.frames[0]), view.frame_times.push_back(f);
  const auto picked = frames_for_glb(view);
  EXPECT_EQ(picked.size(), 48u);
  EXPECT_EQ(picked.front(), 0u);
  EXPECT_EQ(picked.back(), 59u);
}

TEST(Gltf, WithoutTrianglesTheSpringsAreDrawn) {
  RunView view = sample_run(4, 3);
  view.triangles.clear();
  const auto model = loaded(view);
  EXPECT_EQ(primitive_of(model).mode, TINYGLTF_MODE_LINE);
  EXPECT_TRUE(model.images.empty());
}

TEST(Gltf, WithoutCrestThereIsAPlainColour) {
  RunView view = sample_run(4, 3);
  view.crest = false;
  EXPECT_TRUE(loaded(view).images.empty());
}

// z-up turns to y-up, the origin with it.
TEST(Gltf, TheOriginIsTheNodesTranslation) {
  RunView view = sample_run(3, 2);
  EXPECT_TRUE(loaded(view).nodes.at(0).translation.empty());
  view.origin = {500000.25, 4600000.5, 300};
  view.up = "z";
  EXPECT_EQ(loaded(view).nodes.at(0).translation, (std::vector<double>{500000.25, 300, -4600000.5}));
}

TEST(Gltf, MotionWithoutOneGoodFrameIsRefused) {
  const Folder folder;
  RunView view = sample_run(3, 1);
  view.frames[0][0] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(write_glb(view, folder / "mesh.glb"), files::WriteError);
  EXPECT_TRUE(folder.empty());
}

TEST(Gltf, AFullDiskIsTold) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_THROW(write_glb(sample_run(30, 60), "/dev/full"), files::WriteError);
}

TEST(Gltf, TitleMayHoldAnyBytes) {
  RunView view = sample_run(3, 2);
  view.title = "flag \xff \"quoted\" </script>";
  EXPECT_EQ(loaded(view).meshes.at(0).name, "flag \xef\xbf\xbd \"quoted\" </script>");
}

TEST(Gltf, SameRunSameBytes) {
  const Folder folder;
  write_glb(sample_run(6, 10), folder / "a.glb");
  write_glb(sample_run(6, 10), folder / "b.glb");
  EXPECT_EQ(content_of(folder / "a.glb"), content_of(folder / "b.glb"));
}

} // namespace
} // namespace hopmesh::tests
