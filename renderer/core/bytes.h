// SPDX-License-Identifier: Apache-2.0
// Plain values as bytes of this machine and back.
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace pfseq {

template <typename T>
void AppendBytes(const T& value, std::string& bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Takes values off the front of a text of bytes.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  /// False, and nothing taken, where the rest is too short.
  template <typename T>
  bool Take(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes_.size() < sizeof(T)) {
      return false;
    }
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    return true;
  }

  bool IsAtEnd() const { return bytes_.empty(); }
  std::string_view Rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

}  // namespace pfseq
