// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_accessor.h"

#include "renderer/core/check.h"
#include "renderer/core/error.h"
#include "scenes/gltf/gltf_schema.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace pfseq {
namespace {

std::string TypeText(const tinygltf::Accessor& accessor) {
  return fmt::format("{} components of type {}{}",
                     tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)),
                     accessor.componentType,
                     accessor.normalized ? ", normalized" : "");
}

/// Whether an attribute may have the accessor's component type.
bool IsAllowed(const tinygltf::Model& model,
               const tinygltf::Accessor& accessor,
               VertexAttribute attribute) {
  const int type = accessor.componentType;
  const bool is_integer = type != TINYGLTF_COMPONENT_TYPE_FLOAT;
  const bool is_unsigned = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    return false;
  }
  if (!is_integer ||
      (attribute == VertexAttribute::kTexcoord && is_unsigned && accessor.normalized)) {
    return true;
  }
  const bool is_quantized = std::ranges::find(model.extensionsUsed, "KHR_mesh_quantization") !=
                            model.extensionsUsed.end();
  return is_quantized &&
         (attribute != VertexAttribute::kNormal || (!is_unsigned && accessor.normalized));
}

/// One component as float (glTF 2.0, section 3.6.2.2, for the normalised ones).
template <typename Integer>
float FromInteger(const unsigned char* bytes, bool is_normalized) {
  Integer value = 0;
  std::memcpy(&value, bytes, sizeof(value));
  if (!is_normalized) {
    return static_cast<float>(value);
  }
  const double max = std::numeric_limits<Integer>::max();
  return static_cast<float>(std::max(static_cast<double>(value) / max, -1.0));
}

float IntegerComponent(const unsigned char* bytes, const tinygltf::Accessor& accessor) {
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return FromInteger<int8_t>(bytes, accessor.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return FromInteger<uint8_t>(bytes, accessor.normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return FromInteger<int16_t>(bytes, accessor.normalized);
    default:
      return FromInteger<uint16_t>(bytes, accessor.normalized);
  }
}

uint32_t UnsignedComponent(const unsigned char* bytes, size_t size) {
  uint32_t value = 0;
  std::memcpy(&value, bytes, size);
  return value;
}

/// The bytes of `count` elements in a view, `stride` apart.
struct Elements {
  std::span<const unsigned char> bytes;
  size_t stride = 0;

  const unsigned char* At(size_t idx) const { return bytes.data() + idx * stride; }
};

Elements ElementsOf(
    const tinygltf::Model& model, int view_idx, size_t offset, size_t count, size_t element_size) {
  const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(view_idx)];
  const std::vector<unsigned char>& data = model.buffers[static_cast<size_t>(view.buffer)].data;
  const size_t stride = view.byteStride == 0 ? element_size : view.byteStride;
  const size_t length = (count - 1) * stride + element_size;
  PFSEQ_CHECK(count > 0 && offset + length <= view.byteLength &&
                  view.byteOffset + view.byteLength <= data.size(),
              "{} elements at {} in a view of {} at {} of {}",
              count,
              offset,
              view.byteLength,
              view.byteOffset,
              data.size());
  return {std::span(data).subspan(view.byteOffset + offset, length), stride};
}

/// Calls read(element index, bytes) for all elements of an accessor: first those of its view, if it
/// has one, then the sparse ones that replace some.
template <typename Read>
void ForEachElement(const tinygltf::Model& model,
                    const tinygltf::Accessor& accessor,
                    const std::string& where,
                    const Read& read) {
  const size_t element_size =
      ComponentSizeBytes(accessor.componentType) *
      static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
  if (accessor.bufferView >= 0) {
    const Elements elements =
        ElementsOf(model, accessor.bufferView, accessor.byteOffset, accessor.count, element_size);
    for (size_t i = 0; i < accessor.count; ++i) {
      read(i, elements.At(i));
    }
  }
  if (!accessor.sparse.isSparse) {
    return;
  }
  const auto& sparse = accessor.sparse;
  const auto count = static_cast<size_t>(sparse.count);
  const size_t index_size = ComponentSizeBytes(sparse.indices.componentType);
  const Elements indices = ElementsOf(model,
                                      sparse.indices.bufferView,
                                      static_cast<size_t>(sparse.indices.byteOffset),
                                      count,
                                      index_size);
  const Elements values = ElementsOf(model,
                                     sparse.values.bufferView,
                                     static_cast<size_t>(sparse.values.byteOffset),
                                     count,
                                     element_size);
  for (size_t i = 0; i < count; ++i) {
    const size_t element_idx = UnsignedComponent(indices.At(i), index_size);
    if (element_idx >= accessor.count) {
      throw InputError(
          "{}: sparse index {}, expected less than {}", where, element_idx, accessor.count);
    }
    read(element_idx, values.At(i));
  }
}

template <int kSize>
std::vector<Eigen::Matrix<float, kSize, 1>> ReadVectors(const tinygltf::Model& model,
                                                        int accessor_idx,
                                                        VertexAttribute attribute,
                                                        const std::string& where) {
  using Vector = Eigen::Matrix<float, kSize, 1>;
  const tinygltf::Accessor& accessor = model.accessors[static_cast<size_t>(accessor_idx)];
  if (accessor.type != kSize || !IsAllowed(model, accessor, attribute)) {
    throw InputError("{}: accessors[{}] has {}, which this attribute must not have",
                     where,
                     accessor_idx,
                     TypeText(accessor));
  }
  std::vector<Vector> vectors(accessor.count, Vector::Zero());
  const bool is_float = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  const size_t component_size = ComponentSizeBytes(accessor.componentType);
  ForEachElement(model, accessor, where, [&](size_t idx, const unsigned char* bytes) {
    if (is_float) {
      std::memcpy(vectors[idx].data(), bytes, sizeof(Vector));
    }
    for (int k = 0; k < kSize && !is_float; ++k) {
      vectors[idx][k] = IntegerComponent(bytes + static_cast<size_t>(k) * component_size, accessor);
    }
    if (!vectors[idx].allFinite()) {
      throw InputError("{}: element {} of accessors[{}] is not finite", where, idx, accessor_idx);
    }
  });
  return vectors;
}

}  // namespace

std::vector<Vec3f> ReadVec3Accessor(const tinygltf::Model& model,
                                    int accessor_idx,
                                    VertexAttribute attribute,
                                    const std::string& where) {
  return ReadVectors<3>(model, accessor_idx, attribute, where);
}

std::vector<Vec2f> ReadVec2Accessor(const tinygltf::Model& model,
                                    int accessor_idx,
                                    VertexAttribute attribute,
                                    const std::string& where) {
  return ReadVectors<2>(model, accessor_idx, attribute, where);
}

std::vector<uint32_t> ReadIndexAccessor(const tinygltf::Model& model,
                                        int accessor_idx,
                                        const std::string& where) {
  const tinygltf::Accessor& accessor = model.accessors[static_cast<size_t>(accessor_idx)];
  const int type = accessor.componentType;
  const bool is_unsigned = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_unsigned || accessor.normalized) {
    throw InputError("{}: accessors[{}] has {}, expected unsigned integers as indices",
                     where,
                     accessor_idx,
                     TypeText(accessor));
  }
  std::vector<uint32_t> indices(accessor.count, 0);
  const size_t size = ComponentSizeBytes(type);
  ForEachElement(model, accessor, where, [&](size_t idx, const unsigned char* bytes) {
    indices[idx] = UnsignedComponent(bytes, size);
  });
  return indices;
}

}  // namespace pfseq
