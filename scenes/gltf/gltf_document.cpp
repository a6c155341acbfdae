// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_document.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "scenes/gltf/gltf_schema.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <deque>
#include <limits>
#include <string_view>

#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

/// Nesting beyond this is no scene; it would exhaust the stack of recursive readers.
constexpr int kMaxDepth = 64;

constexpr size_t kGlbHeaderBytes = 12;
constexpr size_t kGlbChunkHeaderBytes = 8;
constexpr uint32_t kGlbMagic = 0x46546C67;        // "glTF"
constexpr uint32_t kGlbChunkJson = 0x4E4F534A;    // "JSON"
constexpr uint32_t kGlbChunkBinary = 0x004E4942;  // "BIN"

/// A text of another library as a part of one line.
std::string OneLine(std::string text) {
  constexpr size_t kMaxLength = 200;
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20; }, ' ');
  if (text.size() > kMaxLength) {
    text = text.substr(0, kMaxLength) + "...";
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) {
    text.pop_back();
  }
  return text;
}

/// Little-endian, as all of glTF; so is every machine that this program is built for.
uint32_t Uint32At(std::string_view bytes, size_t offset) {
  static_assert(std::endian::native == std::endian::little);
  uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof(value));
  return value;
}

bool IsGlb(std::string_view bytes) {
  return bytes.size() >= sizeof(uint32_t) && Uint32At(bytes, 0) == kGlbMagic;
}

/// The JSON chunk of a GLB file, whose framing is checked (glTF 2.0, section 4.4).
std::string_view GlbJson(std::string_view bytes, const std::string& origin) {
  if (bytes.size() < kGlbHeaderBytes + kGlbChunkHeaderBytes) {
    throw InputError("{}: GLB file of {} bytes is too short", origin, bytes.size());
  }
  if (Uint32At(bytes, 4) != 2) {
    throw InputError("{}: GLB version {}, expected 2", origin, Uint32At(bytes, 4));
  }
  const size_t length = Uint32At(bytes, 8);
  if (length > bytes.size()) {
    throw InputError(
        "{}: truncated: the header tells {} bytes, the file has {}", origin, length, bytes.size());
  }
  std::string_view json;
  size_t offset = kGlbHeaderBytes;
  for (int chunk = 0; chunk < 2 && offset < length; ++chunk) {
    if (length - offset < kGlbChunkHeaderBytes) {
      throw InputError("{}: GLB chunk {} has no header", origin, chunk);
    }
    const size_t chunk_length = Uint32At(bytes, offset);
    const uint32_t type = Uint32At(bytes, offset + 4);
    offset += kGlbChunkHeaderBytes;
    if (chunk_length > length - offset || chunk_length % 4 != 0) {
      throw InputError(
          "{}: GLB chunk {} of {} bytes does not fit: {} are left, and it must be a multiple of 4",
          origin,
          chunk,
          chunk_length,
          length - offset);
    }
    if (type != (chunk == 0 ? kGlbChunkJson : kGlbChunkBinary)) {
      throw InputError("{}: GLB chunk {} has type 0x{:08X}, expected {}",
                       origin,
                       chunk,
                       type,
                       chunk == 0 ? "JSON" : "BIN");
    }
    if (chunk == 0) {
      json = bytes.substr(offset, chunk_length);
    }
    offset += chunk_length;
  }
  return json;
}

nlohmann::json ParseJson(std::string_view text, const std::string& origin) {
  const auto check_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kMaxDepth) {
      throw InputError("{}: JSON nested more than {} deep", origin, kMaxDepth);
    }
    return true;
  };
  try {
    return nlohmann::json::parse(text, check_depth);
  } catch (const nlohmann::json::exception& error) {
    throw InputError("{}: not valid JSON: {}", origin, OneLine(error.what()));
  }
}

/// What the call-backs of tinygltf are told.
struct Files {
  std::string origin;
  /// byteLength of the buffers in files of their own, in order: tinygltf loads buffers first, one
  /// after the other.
  std::deque<size_t> buffer_sizes;
};

/// tinygltf looks beside the glTF file first and then in the working folder, which we do not want.
bool FileExists(const std::string& path, void* user_data) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError(
        "{}: there is no file {}", static_cast<Files*>(user_data)->origin, OneLine(path));
  }
  return true;
}

std::string SamePath(const std::string& path, void*) { return path; }

bool ReadWholeFile(std::vector<unsigned char>* out,
                   std::string*,
                   const std::string& path,
                   void* user_data) {
  Files& files = *static_cast<Files*>(user_data);
  const std::string bytes = ReadFile(path);
  size_t size = bytes.size();
  if (!files.buffer_sizes.empty()) {
    // A buffer's file may be longer than the buffer (glTF 2.0, section 3.6.1.1).
    size = files.buffer_sizes.front();
    files.buffer_sizes.pop_front();
    if (bytes.size() < size) {
      throw InputError(
          "{}: {} has {} bytes, the buffer {}", files.origin, path, bytes.size(), size);
    }
  }
  out->assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  return true;
}

// The parameters are those of tinygltf's call-back.
// NOLINTNEXTLINE(readability-function-size)
bool KeepImageBytes(tinygltf::Image* image,
                    int,
                    std::string*,
                    std::string*,
                    int,
                    int,
                    const unsigned char* bytes,
                    int size,
                    void*) {
  image->image.assign(bytes, bytes + size);
  return true;
}

Files ExternalFiles(const nlohmann::json& root, const std::string& origin) {
  Files files{origin, {}};
  const auto buffers = root.find("buffers");
  for (size_t i = 0; buffers != root.end() && i < buffers->size(); ++i) {
    const nlohmann::json& buffer = (*buffers)[i];
    const std::string uri = buffer.value("uri", "");
    if (!uri.empty() && !tinygltf::IsDataURI(uri)) {
      files.buffer_sizes.push_back(buffer["byteLength"].get<size_t>());
    }
  }
  return files;
}

}  // namespace

tinygltf::Model ReadGltfDocument(const std::filesystem::path& path) {
  const std::string origin = path.string();
  const std::string bytes = ReadFile(path);
  if (bytes.size() > std::numeric_limits<uint32_t>::max()) {
    throw InputError("{}: more than 4 GiB", origin);
  }
  const bool is_glb = IsGlb(bytes);
  if (!is_glb && path.extension() == ".glb") {
    throw InputError("{}: does not begin with 'glTF', as a GLB file must", origin);
  }
  const std::string_view json = is_glb ? GlbJson(bytes, origin) : std::string_view{bytes};
  const nlohmann::json root = ParseJson(json, origin);
  CheckGltfJson(root, is_glb, origin);

  Files files = ExternalFiles(root, origin);
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({&FileExists, &SamePath, &ReadWholeFile, nullptr, &files});
  loader.SetImageLoader(&KeepImageBytes, nullptr);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  const std::string folder = std::filesystem::absolute(path).parent_path().string();
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool is_loaded =
      is_glb ? loader.LoadBinaryFromMemory(&model,
                                           &error,
                                           &warning,
                                           reinterpret_cast<const unsigned char*>(bytes.data()),
                                           size,
                                           folder)
             : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
  if (!is_loaded) {
    throw InputError("{}: {}", origin, OneLine(error.empty() ? "is not a glTF file" : error));
  }
  return model;
}

}  // namespace pfseq
