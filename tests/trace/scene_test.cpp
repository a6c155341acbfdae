// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/scene.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/simple_scenes.h"

#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string FaultAfter(const std::function<void(Scene&)>& change) {
  Scene scene = *BoxScene(Vec3f(-1, -1, -1), Vec3f(1, 1, 1));
  scene.Validate("box.glb");
  change(scene);
  return MessageOf<InputError>([&] { scene.Validate("box.glb"); });
}

TEST(SceneValidate, NamesOriginMeshAndFault) {
  EXPECT_THAT(FaultAfter([](Scene& s) { s.meshes[0].triangles[3][1] = 8; }),
              AllOf(HasSubstr("box.glb: mesh 0"), HasSubstr("vertex index 8 of 8 vertices")));
  EXPECT_THAT(FaultAfter([](Scene& s) { s.meshes[0].material_idx = 1; }),
              HasSubstr("material 1 of 1"));
  EXPECT_THAT(FaultAfter([](Scene& s) { s.meshes[0].normals.resize(3); }),
              HasSubstr("3 normals for 8 positions"));
  EXPECT_THAT(FaultAfter([](Scene& s) { s.meshes[0].texcoords.resize(3); }),
              HasSubstr("3 texture coordinates for 8 positions"));
  EXPECT_THAT(FaultAfter([](Scene& s) {
                s.meshes[0].positions_m[2].y() = std::numeric_limits<float>::quiet_NaN();
              }),
              HasSubstr("a position is not finite"));
  EXPECT_THAT(FaultAfter([](Scene& s) { s.materials[0].normal_texture_idx = 0; }),
              HasSubstr("texture 0 of 0"));
  EXPECT_THAT(FaultAfter([](Scene& s) {
                s.materials[0].roughness = std::numeric_limits<float>::infinity();
              }),
              HasSubstr("a factor is not finite"));
  EXPECT_THAT(FaultAfter([](Scene& s) { s.meshes[0].triangles.clear(); }),
              HasSubstr("holds no triangle"));
  EXPECT_THAT(FaultAfter([](Scene& s) { s.textures.resize(1); }),
              HasSubstr("texture 0 '' is empty"));
}

TEST(Scene, CountsTrianglesOfAllMeshes) {
  Scene scene = *BoxScene(Vec3f(-1, -1, -1), Vec3f(1, 1, 1));
  scene.meshes.push_back(Quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}));
  EXPECT_EQ(scene.NumTriangles(), 14U);
}

}  // namespace
}  // namespace pfseq
