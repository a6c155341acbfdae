// SPDX-License-Identifier: Apache-2.0
// The stored light as bytes and back.
#include "renderer/core/bytes.h"
#include "renderer/trace/light_store.h"

namespace pfseq {
namespace {

/// How a page lies in the serialised store.
struct PageHeader {
  /// Place of its face in LightStore::faces_.
  uint32_t slot = 0;
  uint32_t page_idx = 0;
};

}  // namespace

std::string LightStore::Serialize() const {
  std::string bytes;
  AppendBytes(static_cast<uint64_t>(NumTriangles()), bytes);
  for (size_t slot = 0; slot < faces_.size(); ++slot) {
    const Face* face = faces_[slot].load(std::memory_order_acquire);
    for (uint32_t page_idx = 0; face != nullptr && page_idx < 2 * face->num_pages; ++page_idx) {
      const Page* page = face->pages[page_idx].load(std::memory_order_acquire);
      if (page == nullptr) {
        continue;
      }
      uint32_t ready = 0;
      for (size_t i = 0; i < kRecordsPerPage; ++i) {
        ready |= page->records[i].IsReady() ? 1U << i : 0U;
      }
      if (ready == 0) {
        continue;
      }
      AppendBytes(PageHeader{static_cast<uint32_t>(slot), page_idx}, bytes);
      AppendBytes(ready, bytes);
      for (size_t i = 0; i < kRecordsPerPage; ++i) {
        if ((ready >> i & 1U) != 0) {
          AppendBytes(page->records[i], bytes);
        }
      }
    }
  }
  return bytes;
}

bool LightStore::Load(std::string_view bytes) {
  // Looked through before anything is taken over.
  for (const bool is_rehearsal : {true, false}) {
    ByteReader reader(bytes);
    uint64_t num_triangles = 0;
    if (!reader.Take(num_triangles) || num_triangles != NumTriangles()) {
      return false;
    }
    while (!reader.IsAtEnd()) {
      PageHeader header;
      uint32_t ready = 0;
      if (!reader.Take(header) || !reader.Take(ready) || header.slot >= faces_.size()) {
        return false;
      }
      const auto face_idx = static_cast<uint32_t>(header.slot % NumTriangles());
      if (is_second_[face_idx] != 0) {
        return false;
      }
      Face& face = FaceAt(face_idx, static_cast<LightDetail>(header.slot / NumTriangles()));
      if (header.page_idx >= 2 * face.num_pages) {
        return false;
      }
      const bool is_front = header.page_idx < face.num_pages;
      const uint32_t first =
          (is_front ? header.page_idx : header.page_idx - face.num_pages) * kRecordsPerPage;
      for (uint32_t i = 0; i < kRecordsPerPage; ++i) {
        LightRecord stored;
        if ((ready >> i & 1U) == 0) {
          continue;
        }
        if (first + i >= face.grid.NumRecords() || !reader.Take(stored) || !stored.IsReady()) {
          return false;
        }
        if (!is_rehearsal) {
          LightRecord* record = RecordAt(face, is_front, first + i);
          if (record != nullptr) {
            Publish(stored, *record);
          }
        }
      }
    }
  }
  return true;
}

}  // namespace pfseq
