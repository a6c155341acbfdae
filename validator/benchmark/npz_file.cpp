// SPDX-License-Identifier: Apache-2.0
// The zip format: PKWARE's APPNOTE 6.3, sections 4.3.7 (local header), 4.3.12 (central directory),
// 4.3.16 (its end). The npy format: NumPy's "A simple file format for NumPy arrays", 1.0 to 3.0.
#include "validator/benchmark/npz_file.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parse_number.h"

#include <cstdint>
#include <cstring>

#include <zlib.h>

namespace pfseq {
namespace {

constexpr size_t kEndSize = 22;
constexpr size_t kEntrySize = 46;
constexpr size_t kLocalSize = 30;
constexpr uint32_t kEndMagic = 0x06054b50;
constexpr uint32_t kEntryMagic = 0x02014b50;
constexpr uint16_t kStored = 0;
constexpr uint16_t kDeflated = 8;
constexpr uint64_t kMaxBytes = uint64_t{1} << 31;

/// A file's bytes with checked access.
class Bytes {
 public:
  Bytes(std::string path, const std::string& data) : path_(std::move(path)), data_(data) {}

  [[noreturn]] void Fail(const std::string& fault) const {
    throw InputError("{}: expected an .npz file: {}", path_, fault);
  }

  template <typename T>
  T At(size_t offset) const {
    T value;
    std::memcpy(&value, Part(offset, sizeof(T)).data(), sizeof(T));
    return value;
  }

  std::string_view Part(size_t offset, size_t size) const {
    if (offset > data_.size() || size > data_.size() - offset) {
      Fail("it ends too early");
    }
    return std::string_view(data_).substr(offset, size);
  }

  size_t Size() const { return data_.size(); }

 private:
  std::string path_;
  const std::string& data_;
};

std::string Inflate(const Bytes& bytes, std::string_view packed, size_t size) {
  std::string plain(size, '\0');
  z_stream stream = {};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) {
    bytes.Fail("zlib does not start");
  }
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(plain.data());
  stream.avail_out = static_cast<uInt>(size);
  const int status = inflate(&stream, Z_FINISH);
  const size_t written = stream.total_out;
  inflateEnd(&stream);
  if (status != Z_STREAM_END || written != size) {
    bytes.Fail("damaged data");
  }
  return plain;
}

/// The value of a key in the header's Python dictionary, up to the next key.
std::string HeaderValue(const std::string& header, const std::string& key) {
  const size_t at = header.find("'" + key + "'");
  const size_t colon = at == std::string::npos ? at : header.find(':', at);
  return colon == std::string::npos ? "" : header.substr(colon + 1);
}

template <typename T>
void Convert(const Bytes& bytes, std::string_view data, std::vector<double>& values) {
  if (data.size() < values.size() * sizeof(T)) {
    bytes.Fail("an array is shorter than its shape");
  }
  for (size_t i = 0; i < values.size(); ++i) {
    T value;
    std::memcpy(&value, data.data() + i * sizeof(T), sizeof(T));
    values[i] = static_cast<double>(value);
  }
}

void ConvertType(const Bytes& bytes,
                 const std::string& type,
                 std::string_view data,
                 std::vector<double>& values) {
  if (type == "f4") {
    Convert<float>(bytes, data, values);
  } else if (type == "f8") {
    Convert<double>(bytes, data, values);
  } else if (type == "u1" || type == "b1") {
    Convert<uint8_t>(bytes, data, values);
  } else if (type == "i1") {
    Convert<int8_t>(bytes, data, values);
  } else if (type == "i2") {
    Convert<int16_t>(bytes, data, values);
  } else if (type == "u2") {
    Convert<uint16_t>(bytes, data, values);
  } else if (type == "i4") {
    Convert<int32_t>(bytes, data, values);
  } else if (type == "u4") {
    Convert<uint32_t>(bytes, data, values);
  } else if (type == "i8") {
    Convert<int64_t>(bytes, data, values);
  } else if (type == "u8") {
    Convert<uint64_t>(bytes, data, values);
  } else {
    bytes.Fail("arrays of type '" + type + "' are not supported (float32, float64, integers)");
  }
}

NpzArray ParseNpy(const Bytes& archive, std::string_view npy) {
  constexpr std::string_view kMagic("\x93NUMPY", 6);
  if (npy.size() < 12 || npy.substr(0, 6) != kMagic) {
    archive.Fail("an entry is no .npy file");
  }
  const bool is_first_version = npy[6] == 1;
  uint32_t header_size = 0;
  std::memcpy(&header_size, npy.data() + 8, is_first_version ? 2 : 4);
  const size_t header_begin = is_first_version ? 10 : 12;
  if (header_size > npy.size() - header_begin) {
    archive.Fail("it ends too early");
  }
  const std::string header(npy.substr(header_begin, header_size));
  const std::string descr = HeaderValue(header, "descr");
  const size_t quote = descr.find('\'');
  const std::string type = quote == std::string::npos ? "" : descr.substr(quote + 1, 3);
  if (type.size() != 3 || type[0] == '>') {
    archive.Fail("expected little-endian numbers");
  }
  if (HeaderValue(header, "fortran_order").find("True") < 3) {
    archive.Fail("expected arrays in C order");
  }
  NpzArray array;
  std::vector<size_t> shape;
  const std::string shape_text = HeaderValue(header, "shape");
  std::string number;
  for (size_t i = shape_text.find('(') + 1; i < shape_text.size(); ++i) {
    if (shape_text[i] >= '0' && shape_text[i] <= '9') {
      number += shape_text[i];
    } else if (!number.empty()) {
      shape.push_back(ParseNumber<size_t>(number).value_or(kMaxBytes));
      number.clear();
    }
    if (shape_text[i] == ')') {
      break;
    }
  }
  array.num_rows = shape.empty() ? 1 : shape[0];
  array.num_columns = shape.size() > 1 ? shape[1] : 1;
  if (shape.size() > 2 || array.num_rows > kMaxBytes || array.num_columns > kMaxBytes ||
      array.num_rows * array.num_columns > kMaxBytes / 8) {
    archive.Fail("expected arrays of one or two dimensions");
  }
  array.is_bytes = type.substr(1) == "u1";
  array.values.resize(array.num_rows * array.num_columns);
  ConvertType(archive, type.substr(1), npy.substr(header_begin + header_size), array.values);
  return array;
}

}  // namespace

std::map<std::string, NpzArray> ReadNpz(const std::filesystem::path& path) {
  const std::string data = ReadFile(path);
  const Bytes bytes(path.string(), data);
  // The end record is followed by a comment of at most 65535 bytes.
  size_t end = data.size();
  bool found = false;
  for (size_t back = kEndSize; back <= data.size() && back <= kEndSize + 65535; ++back) {
    if (bytes.At<uint32_t>(data.size() - back) == kEndMagic) {
      end = data.size() - back;
      found = true;
      break;
    }
  }
  if (!found) {
    bytes.Fail("no zip directory");
  }
  std::map<std::string, NpzArray> arrays;
  size_t entry = bytes.At<uint32_t>(end + 16);
  for (uint16_t left = bytes.At<uint16_t>(end + 10); left > 0; --left) {
    if (bytes.At<uint32_t>(entry) != kEntryMagic) {
      bytes.Fail("damaged zip directory");
    }
    const auto method = bytes.At<uint16_t>(entry + 10);
    const size_t packed_size = bytes.At<uint32_t>(entry + 20);
    const size_t size = bytes.At<uint32_t>(entry + 24);
    const size_t name_size = bytes.At<uint16_t>(entry + 28);
    const size_t local = bytes.At<uint32_t>(entry + 42);
    std::string name(bytes.Part(entry + kEntrySize, name_size));
    const size_t begin =
        local + kLocalSize + bytes.At<uint16_t>(local + 26) + bytes.At<uint16_t>(local + 28);
    const std::string_view packed = bytes.Part(begin, packed_size);
    if (size > kMaxBytes || (method != kStored && method != kDeflated)) {
      bytes.Fail("an entry is too large or packed in an unknown way");
    }
    if (name.ends_with(".npy")) {
      name.resize(name.size() - 4);
    }
    arrays[name] =
        method == kStored ? ParseNpy(bytes, packed) : ParseNpy(bytes, Inflate(bytes, packed, size));
    entry +=
        kEntrySize + name_size + bytes.At<uint16_t>(entry + 30) + bytes.At<uint16_t>(entry + 32);
  }
  return arrays;
}

}  // namespace pfseq
