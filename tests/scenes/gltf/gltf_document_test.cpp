// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_document.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/scenes/gltf/gltf_builder.h"
#include "tests/support/expect_error.h"

#include <string>

namespace pfseq {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// The fault that a file of these bytes is refused for, without its path.
std::string FaultOf(const std::string& bytes, const std::string& name = "a.glb") {
  const TempFolder folder;
  WriteFileAtomically(folder / name, bytes);
  const std::string prefix = (folder / name).string() + ": ";
  const std::string text = MessageOf<InputError>([&] { ReadGltfDocument(folder / name); });
  EXPECT_THAT(text, StartsWith(prefix));
  return text.substr(std::min(prefix.size(), text.size()));
}

std::string WithWord(std::string bytes, size_t offset, uint32_t word) {
  std::memcpy(bytes.data() + offset, &word, sizeof(word));
  return bytes;
}

TEST(GltfDocument, ReadsTheBinaryChunk) {
  const TempFolder folder;
  const GltfBuilder builder;
  WriteFileAtomically(folder / "a.glb", builder.Glb());
  const tinygltf::Model model = ReadGltfDocument(folder / "a.glb");
  ASSERT_EQ(model.buffers.size(), 1U);
  EXPECT_EQ(std::string(model.buffers[0].data.begin(), model.buffers[0].data.end()), builder.bin);
}

TEST(GltfDocument, TellsTheKindOfFileByItsContent) {
  const TempFolder folder;
  WriteFileAtomically(folder / "a.gltf", GltfBuilder().Glb());
  EXPECT_NO_THROW(ReadGltfDocument(folder / "a.gltf"));
}

TEST(GltfDocument, ReadsABufferBesideTheFile) {
  const TempFolder folder;
  const GltfBuilder builder;
  const tinygltf::Model model = ReadGltfDocument(builder.WriteSeparate(folder));
  EXPECT_EQ(std::string(model.buffers[0].data.begin(), model.buffers[0].data.end()), builder.bin);
}

TEST(GltfDocument, ReadsADataUri) {
  GltfBuilder builder;
  builder.bin.clear();
  // Nine floats: 0 0 0, 1 0 0, 0 1 0.
  builder.root["buffers"] = {
      {{"byteLength", 36},
       {"uri",
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}};
  const TempFolder folder;
  WriteFileAtomically(folder / "a.gltf", builder.root.dump());
  const tinygltf::Model model = ReadGltfDocument(folder / "a.gltf");
  EXPECT_EQ(std::string(model.buffers[0].data.begin(), model.buffers[0].data.end()),
            GltfBuilder().bin);
}

TEST(GltfDocument, AcceptsABufferFileThatIsLongerThanTheBuffer) {
  const TempFolder folder;
  const GltfBuilder builder;
  const std::filesystem::path path = builder.WriteSeparate(folder);
  WriteFileAtomically(folder / "scene.bin", builder.bin + "more");
  EXPECT_EQ(ReadGltfDocument(path).buffers[0].data.size(), builder.bin.size());
}

TEST(GltfDocument, RefusesABufferFileThatIsTooShort) {
  const TempFolder folder;
  const GltfBuilder builder;
  const std::filesystem::path path = builder.WriteSeparate(folder);
  WriteFileAtomically(folder / "scene.bin", builder.bin.substr(1));
  EXPECT_THAT(MessageOf<InputError>([&] { ReadGltfDocument(path); }),
              EndsWith("scene.bin has 35 bytes, the buffer 36"));
}

TEST(GltfDocument, NamesAMissingBufferFile) {
  const TempFolder folder;
  const std::filesystem::path path = GltfBuilder().WriteSeparate(folder);
  std::filesystem::remove(folder / "scene.bin");
  EXPECT_EQ(MessageOf<InputError>([&] { ReadGltfDocument(path); }),
            path.string() + ": there is no file " + (folder / "scene.bin").string());
}

TEST(GltfDocument, DoesNotLookForFilesInTheWorkingFolder) {
  const TempFolder folder;
  const TempFolder elsewhere;
  const std::filesystem::path path = GltfBuilder().WriteSeparate(folder);
  std::filesystem::create_directory(folder / "work");
  std::filesystem::rename(folder / "scene.bin", folder / "work/scene.bin");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "work");
  EXPECT_THAT(MessageOf<InputError>([&] { ReadGltfDocument(path); }),
              HasSubstr("there is no file"));
  std::filesystem::current_path(before);
}

TEST(GltfDocument, KeepsTheBytesOfImages) {
  GltfBuilder builder;
  builder.AddView("12345678", 8);
  builder.root["images"] = {{{"bufferView", 1}, {"mimeType", "image/png"}}};
  const TempFolder folder;
  WriteFileAtomically(folder / "a.glb", builder.Glb());
  const tinygltf::Model model = ReadGltfDocument(folder / "a.glb");
  EXPECT_EQ(std::string(model.images[0].image.begin(), model.images[0].image.end()), "12345678");
}

TEST(GltfDocument, RefusesWhatIsNoGltf) {
  EXPECT_EQ(FaultOf("", "a.glb"), "does not begin with 'glTF', as a GLB file must");
  EXPECT_EQ(FaultOf("PNG and so on", "a.glb"), "does not begin with 'glTF', as a GLB file must");
  EXPECT_THAT(FaultOf("", "a.gltf"), StartsWith("not valid JSON"));
  EXPECT_THAT(FaultOf("PNG and so on", "a.gltf"), StartsWith("not valid JSON"));
  EXPECT_THAT(FaultOf("{\"asset\": {\"version\": \"2.0\"", "a.gltf"), StartsWith("not valid JSON"));
  EXPECT_THAT(FaultOf("{\"a\": 1e999}", "a.gltf"), StartsWith("not valid JSON"));
  EXPECT_THAT(FaultOf("{\"a\": \"\xff\"}", "a.gltf"), StartsWith("not valid JSON"));
}

TEST(GltfDocument, RefusesWrongFraming) {
  const std::string good = GltfBuilder().Glb();
  const auto size = static_cast<uint32_t>(good.size());
  EXPECT_EQ(FaultOf(good.substr(0, 19)), "GLB file of 19 bytes is too short");
  EXPECT_EQ(FaultOf(WithWord(good, 4, 1)), "GLB version 1, expected 2");
  EXPECT_EQ(FaultOf(good.substr(0, size - 1)),
            fmt::format("truncated: the header tells {} bytes, the file has {}", size, size - 1));
  EXPECT_THAT(FaultOf(WithWord(good, 12, 0xFFFFFFFCU)),
              StartsWith("GLB chunk 0 of 4294967292 bytes does not fit"));
  EXPECT_EQ(FaultOf(WithWord(good, 16, 7)), "GLB chunk 0 has type 0x00000007, expected JSON");
  // The chunk's own header counts: eight bytes more than there are must not be read.
  const size_t bin_header = good.size() - 36 - 8;
  EXPECT_THAT(FaultOf(WithWord(good, bin_header, 44)),
              StartsWith("GLB chunk 1 of 44 bytes does not fit: 36 are left"));
  EXPECT_EQ(FaultOf(WithWord(good, bin_header + 4, 7)),
            "GLB chunk 1 has type 0x00000007, expected BIN");
}

TEST(GltfDocument, RefusesAGlbWithoutTheBinaryChunkThatItNeeds) {
  GltfBuilder builder;
  builder.root["buffers"] = {{{"byteLength", 400}}};
  EXPECT_THAT(FaultOf(builder.Glb()), HasSubstr("byteLength"));
}

TEST(GltfDocument, RefusesBottomlessNesting) {
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  EXPECT_EQ(FaultOf("{\"extras\": " + deep + "}", "a.gltf"), "JSON nested more than 64 deep");
}

TEST(GltfDocument, TellsALongFaultInOneShortLine) {
  GltfBuilder builder;
  const std::string uri = "data:application/octet-stream;base64," + std::string(100000, '!');
  builder.root["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
  const std::string fault = FaultOf(builder.root.dump(), "a.gltf");
  EXPECT_LT(fault.size(), 300U);
  EXPECT_THAT(fault, HasSubstr("Failed to decode"));
}

}  // namespace
}  // namespace pfseq
