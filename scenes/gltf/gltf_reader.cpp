// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_reader.h"

#include "renderer/core/error.h"
#include "scenes/gltf/gltf_accessor.h"
#include "scenes/gltf/gltf_axes.h"
#include "scenes/gltf/gltf_document.h"
#include "scenes/gltf/gltf_material.h"
#include "scenes/gltf/gltf_sun.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace pfseq {
namespace {

/// A file may show a mesh at many nodes; beyond this the scene would not fit any memory.
constexpr size_t kMaxVertices = size_t{1} << 28;
constexpr size_t kMaxTriangles = size_t{1} << 28;

/// Normals further from unit length than rounding can bring them are normalised.
constexpr float kUnitLengthTolerance = 1e-3F;

using Triangle = std::array<uint32_t, 3>;

/// The transform of a node alone (glTF 2.0, section 3.5.3).
Eigen::Affine3d ParentFromNode(const tinygltf::Node& node, const std::string& where) {
  Eigen::Affine3d parent_from_node = Eigen::Affine3d::Identity();
  if (!node.matrix.empty()) {
    const Eigen::Map<const Eigen::Matrix4d> matrix(node.matrix.data());
    if (matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
      throw InputError("{}: the matrix is not affine", where);
    }
    parent_from_node.matrix() = matrix;
    return parent_from_node;
  }
  if (!node.translation.empty()) {
    parent_from_node.translate(Eigen::Map<const Vec3d>(node.translation.data()));
  }
  if (!node.rotation.empty()) {
    Eigen::Quaterniond rotation(
        node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (!(rotation.norm() > 0.0)) {
      throw InputError("{}: the rotation is not a quaternion", where);
    }
    rotation.normalize();
    parent_from_node.rotate(rotation);
  }
  if (!node.scale.empty()) {
    parent_from_node.scale(Eigen::Map<const Vec3d>(node.scale.data()));
  }
  return parent_from_node;
}

/// Triangles of `num_corners` corners in sequence (glTF 2.0, section 3.7.2.1); none for points and
/// lines.
std::vector<Triangle> TrianglesOfSequence(int mode, size_t num_corners, const std::string& where) {
  std::vector<Triangle> triangles;
  const auto count = static_cast<uint32_t>(num_corners);
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (num_corners % 3 != 0) {
      throw InputError("{}: {} corners of triangles, expected a multiple of 3", where, num_corners);
    }
    triangles.reserve(num_corners / 3);
    for (uint32_t i = 0; i < count; i += 3) {
      triangles.push_back({i, i + 1, i + 2});
    }
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (uint32_t i = 0; i + 2 < count; ++i) {
      triangles.push_back({i, i + 1 + i % 2, i + 2 - i % 2});
    }
  } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    for (uint32_t i = 0; i + 2 < count; ++i) {
      triangles.push_back({i + 1, i + 2, 0});
    }
  }
  return triangles;
}

class SceneBuilder {
 public:
  SceneBuilder(const tinygltf::Model& model, const std::string& origin)
      : model_(model), origin_(origin), materials_(ReadGltfMaterials(model, origin)) {}

  Scene Build() {
    CheckTotals();
    AddNodes();
    scene_.materials = std::move(materials_.materials);
    scene_.textures = std::move(materials_.textures);
    scene_.Validate(origin_);
    return std::move(scene_);
  }

 private:
  std::vector<int> RootNodes() const {
    if (!model_.scenes.empty()) {
      return model_.scenes[static_cast<size_t>(std::max(model_.defaultScene, 0))].nodes;
    }
    std::vector<bool> is_child(model_.nodes.size());
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int child : node.children) {
        is_child[static_cast<size_t>(child)] = true;
      }
    }
    std::vector<int> roots;
    for (size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) {
        roots.push_back(static_cast<int>(i));
      }
    }
    return roots;
  }

  /// Visits the nodes in the order of the hierarchy: each before its children, children in their
  /// order.
  void AddNodes() {
    struct Entry {
      int node_idx;
      Eigen::Affine3d world_from_parent;
    };
    std::vector<Entry> stack;
    const auto push = [&](const std::vector<int>& nodes, const Eigen::Affine3d& world_from_parent) {
      // The last on the stack is taken first.
      for (size_t i = nodes.size(); i > 0; --i) {
        stack.push_back({nodes[i - 1], world_from_parent});
      }
    };
    push(RootNodes(), Eigen::Affine3d::Identity());
    while (!stack.empty()) {
      const Entry entry = stack.back();
      stack.pop_back();
      const tinygltf::Node& node = model_.nodes[static_cast<size_t>(entry.node_idx)];
      const std::string where =
          fmt::format("{}: nodes[{}] '{}'", origin_, entry.node_idx, node.name);
      const Eigen::Affine3d world_from_node = entry.world_from_parent * ParentFromNode(node, where);
      AddNode(node, world_from_node, where);
      push(node.children, world_from_node);
    }
  }

  void AddNode(const tinygltf::Node& node,
               const Eigen::Affine3d& world_from_node,
               const std::string& where) {
    const int light_idx = LightOfNode(node);
    if (light_idx >= 0 && !scene_.sun) {
      const tinygltf::Light& light = model_.lights[static_cast<size_t>(light_idx)];
      if (light.type == "directional") {
        scene_.sun = SunFromLight(light, world_from_node.linear(), where);
      }
    }
    if (node.mesh < 0) {
      return;
    }
    const tinygltf::Mesh& source = model_.meshes[static_cast<size_t>(node.mesh)];
    for (size_t i = 0; i < source.primitives.size(); ++i) {
      const std::string place = fmt::format("{}: meshes[{}].primitives[{}]", origin_, node.mesh, i);
      std::optional<Mesh> mesh = ReadPrimitive(source.primitives[i], place);
      if (mesh) {
        mesh->name = source.name.empty() ? node.name : source.name;
        Place(world_from_node, where, *mesh);
        scene_.meshes.push_back(std::move(*mesh));
      }
    }
  }

  static int AttributeOf(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found != primitive.attributes.end() ? found->second : -1;
  }

  static void CheckCount(size_t count,
                         size_t num_vertices,
                         const char* what,
                         const std::string& where) {
    if (count != num_vertices) {
      throw InputError("{}: {} {} for {} positions", where, count, what, num_vertices);
    }
  }

  size_t NumVertices(const tinygltf::Primitive& primitive) const {
    return model_.accessors[static_cast<size_t>(AttributeOf(primitive, "POSITION"))].count;
  }

  size_t NumCorners(const tinygltf::Primitive& primitive) const {
    return primitive.indices < 0 ? NumVertices(primitive)
                                 : model_.accessors[static_cast<size_t>(primitive.indices)].count;
  }

  /// Refuses before memory is taken.
  void CheckTotals() const {
    size_t num_vertices = 0;
    size_t num_corners = 0;
    for (const tinygltf::Node& node : model_.nodes) {
      if (node.mesh < 0) {
        continue;
      }
      for (const tinygltf::Primitive& primitive :
           model_.meshes[static_cast<size_t>(node.mesh)].primitives) {
        num_vertices += NumVertices(primitive);
        num_corners += NumCorners(primitive);
        if (num_vertices > kMaxVertices || num_corners > 3 * kMaxTriangles) {
          throw InputError(
              "{}: more than {} vertices or {} triangles", origin_, kMaxVertices, kMaxTriangles);
        }
      }
    }
  }

  /// In the axes of glTF and the node's frame; nothing when it has no triangle.
  std::optional<Mesh> ReadPrimitive(const tinygltf::Primitive& primitive,
                                    const std::string& where) {
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
      return std::nullopt;
    }
    const size_t num_vertices = NumVertices(primitive);
    Mesh mesh;
    mesh.triangles = TrianglesOfSequence(primitive.mode, NumCorners(primitive), where);
    if (mesh.triangles.empty()) {
      return std::nullopt;
    }
    mesh.positions_m = ReadVec3Accessor(model_,
                                        AttributeOf(primitive, "POSITION"),
                                        VertexAttribute::kPosition,
                                        where + ".attributes.POSITION");
    if (primitive.indices >= 0) {
      FollowIndices(primitive.indices, where + ".indices", mesh);
    }
    const int normal_idx = AttributeOf(primitive, "NORMAL");
    if (normal_idx >= 0) {
      mesh.normals = ReadVec3Accessor(
          model_, normal_idx, VertexAttribute::kNormal, where + ".attributes.NORMAL");
      CheckCount(mesh.normals.size(), num_vertices, "normals", where);
    }
    mesh.material_idx =
        primitive.material >= 0 ? primitive.material : materials_.default_material_idx;
    ReadTexcoords(primitive, where, mesh);
    return mesh;
  }

  void FollowIndices(int accessor_idx, const std::string& where, Mesh& mesh) const {
    const std::vector<uint32_t> indices = ReadIndexAccessor(model_, accessor_idx, where);
    const size_t num_vertices = mesh.positions_m.size();
    const auto too_large =
        std::ranges::find_if(indices, [&](uint32_t index) { return index >= num_vertices; });
    if (too_large != indices.end()) {
      throw InputError("{}: vertex {} of {}", where, *too_large, num_vertices);
    }
    for (Triangle& triangle : mesh.triangles) {
      for (uint32_t& corner : triangle) {
        corner = indices[corner];
      }
    }
  }

  void ReadTexcoords(const tinygltf::Primitive& primitive,
                     const std::string& where,
                     Mesh& mesh) const {
    const TexcoordMapping& mapping = materials_.texcoords[static_cast<size_t>(mesh.material_idx)];
    const std::string name = fmt::format("TEXCOORD_{}", mapping.set);
    const int accessor_idx = AttributeOf(primitive, name);
    if (accessor_idx < 0) {
      return;
    }
    mesh.texcoords = ReadVec2Accessor(
        model_, accessor_idx, VertexAttribute::kTexcoord, where + ".attributes." + name);
    CheckCount(mesh.texcoords.size(), mesh.positions_m.size(), "texture coordinates", where);
    if (!mapping.IsIdentity()) {
      for (Vec2f& texcoord : mesh.texcoords) {
        texcoord =
            (mapping.scale_rotation * texcoord.cast<double>() + mapping.offset).cast<float>();
      }
    }
  }

  /// From the node's frame in the axes of glTF to the world.
  static void Place(const Eigen::Affine3d& world_from_node, const std::string& where, Mesh& mesh) {
    const bool is_identity = world_from_node.matrix() == Eigen::Matrix4d::Identity();
    for (Vec3f& position : mesh.positions_m) {
      if (!is_identity) {
        position = (world_from_node * position.cast<double>()).cast<float>();
        if (!position.allFinite()) {
          throw InputError("{}: the transform takes a position beyond all bounds", where);
        }
      }
      position = WorldFromGltf(position);
    }
    PlaceNormals(is_identity, world_from_node.linear(), mesh);
    if (world_from_node.linear().determinant() < 0.0) {
      for (Triangle& triangle : mesh.triangles) {
        std::swap(triangle[1], triangle[2]);
      }
    }
  }

  /// Normals turn with the inverse transpose; its cofactors do the same without a division, up to
  /// the sign of the determinant. Normals that leave no direction are given up: the mesh is shaded
  /// flat.
  static void PlaceNormals(bool is_identity, const Eigen::Matrix3d& linear, Mesh& mesh) {
    Eigen::Matrix3d cofactors;
    cofactors << linear.col(1).cross(linear.col(2)), linear.col(2).cross(linear.col(0)),
        linear.col(0).cross(linear.col(1));
    if (linear.determinant() < 0.0) {
      cofactors = -cofactors;
    }
    for (Vec3f& normal : mesh.normals) {
      if (!is_identity || std::abs(normal.norm() - 1.0F) > kUnitLengthTolerance) {
        const Vec3d turned = (cofactors * normal.cast<double>()).stableNormalized();
        if (!(std::abs(turned.norm() - 1.0) < kUnitLengthTolerance)) {
          mesh.normals.clear();
          return;
        }
        normal = turned.cast<float>();
      }
      normal = WorldFromGltf(normal);
    }
  }

  const tinygltf::Model& model_;
  const std::string& origin_;
  GltfMaterials materials_;
  Scene scene_;
};

}  // namespace

Scene ReadGltf(const std::filesystem::path& path) {
  const std::string origin = path.string();
  const tinygltf::Model model = ReadGltfDocument(path);
  return SceneBuilder(model, origin).Build();
}

std::string ReadGltfCopyright(const std::filesystem::path& path) {
  return ReadGltfDocument(path).asset.copyright;
}

}  // namespace pfseq
