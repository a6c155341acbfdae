// SPDX-License-Identifier: Apache-2.0
// Writes .npz files for tests, as NumPy does.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

namespace pfseq {

class NpzBuilder {
 public:
  explicit NpzBuilder(bool is_deflated = false) : is_deflated_(is_deflated) {}

  /// type as NumPy spells it: "<f4", "|u1", "<i8".
  template <typename T>
  NpzBuilder& Add(const std::string& name,
                  const std::string& type,
                  const std::string& shape,
                  const std::vector<T>& values,
                  bool fortran_order = false) {
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': {}, }}",
                                     type,
                                     fortran_order ? "True" : "False",
                                     shape);
    header.resize((header.size() + 10 + 64) / 64 * 64 - 11, ' ');
    header += '\n';
    std::string npy("\x93NUMPY\x01\x00", 8);
    Put<uint16_t>(npy, static_cast<uint16_t>(header.size()));
    npy += header;
    const size_t begin = npy.size();
    npy.resize(begin + values.size() * sizeof(T));
    std::memcpy(npy.data() + begin, values.data(), values.size() * sizeof(T));
    AddEntry(name + ".npy", npy);
    return *this;
  }

  std::string Bytes() const {
    std::string bytes = files_ + directory_;
    Put<uint32_t>(bytes, 0x06054b50);
    Put<uint32_t>(bytes, 0);
    Put<uint16_t>(bytes, count_);
    Put<uint16_t>(bytes, count_);
    Put<uint32_t>(bytes, static_cast<uint32_t>(directory_.size()));
    Put<uint32_t>(bytes, static_cast<uint32_t>(files_.size()));
    Put<uint16_t>(bytes, 0);
    return bytes;
  }

 private:
  template <typename T>
  static void Put(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  void AddEntry(const std::string& name, const std::string& plain) {
    std::string packed = plain;
    if (is_deflated_) {
      packed.resize(compressBound(plain.size()) + 64);
      z_stream stream = {};
      deflateInit2(&stream, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
      stream.avail_in = static_cast<uInt>(plain.size());
      stream.next_out = reinterpret_cast<Bytef*>(packed.data());
      stream.avail_out = static_cast<uInt>(packed.size());
      deflate(&stream, Z_FINISH);
      packed.resize(stream.total_out);
      deflateEnd(&stream);
    }
    const auto offset = static_cast<uint32_t>(files_.size());
    const auto put_common = [&](std::string& to) {
      Put<uint16_t>(to, 20);
      Put<uint16_t>(to, 0);
      Put<uint16_t>(to, is_deflated_ ? 8 : 0);
      Put<uint32_t>(to, 0);
      Put<uint32_t>(to, 0);
      Put<uint32_t>(to, static_cast<uint32_t>(packed.size()));
      Put<uint32_t>(to, static_cast<uint32_t>(plain.size()));
      Put<uint16_t>(to, static_cast<uint16_t>(name.size()));
      Put<uint16_t>(to, 0);
    };
    Put<uint32_t>(files_, 0x04034b50);
    put_common(files_);
    files_ += name + packed;
    Put<uint32_t>(directory_, 0x02014b50);
    Put<uint16_t>(directory_, 20);
    put_common(directory_);
    directory_.append(10, '\0');
    Put<uint32_t>(directory_, offset);
    directory_ += name;
    ++count_;
  }

  bool is_deflated_;
  std::string files_;
  std::string directory_;
  uint16_t count_ = 0;
};

}  // namespace pfseq
