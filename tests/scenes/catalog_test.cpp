// SPDX-License-Identifier: Apache-2.0
#include "scenes/catalog.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "scenes/gltf/gltf_writer.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <string>

namespace pfseq {
namespace {

TEST(Catalog, BuildsTheCanyonWhenNoFileIsNamed) {
  SequenceSpec spec;
  spec.scene.canyon.detail = 0.0;
  const Scene scene = LoadScene(spec, ".");
  EXPECT_GT(scene.NumTriangles(), 100U);
}

TEST(Catalog, FindsTheFileFromTheFolderOfTheDescription) {
  const TempFolder folder;
  Scene scene;
  scene.materials.resize(1);
  Mesh mesh;
  mesh.positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh};
  WriteFileAtomically(folder / "models/one.glb", GlbBytes(scene));
  SequenceSpec spec;
  spec.scene.gltf = "models/one.glb";
  EXPECT_EQ(LoadScene(spec, folder.Path()).NumTriangles(), 1U);
  spec.scene.gltf = (folder / "models/one.glb").string();
  EXPECT_EQ(LoadScene(spec, "elsewhere").NumTriangles(), 1U);
  spec.scene.gltf = "models/two.glb";
  EXPECT_THAT(MessageOf<InputError>([&] { LoadScene(spec, folder.Path()); }),
              testing::HasSubstr("models/two.glb"));
}

}  // namespace
}  // namespace pfseq
