// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/file.h"

#include "renderer/core/error.h"

#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <openssl/evp.h>
#include <unistd.h>

namespace pfseq {
namespace {

std::string ReasonOf(int error_number) { return std::generic_category().message(error_number); }

/// A file descriptor that is closed, and whose file is removed unless it was kept.
class PartialFile {
 public:
  explicit PartialFile(std::filesystem::path path)
      : path_(std::move(path)),
        descriptor_(open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {}
  ~PartialFile() {
    if (descriptor_ >= 0) {
      close(descriptor_);
      unlink(path_.c_str());
    }
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  bool IsOpen() const { return descriptor_ >= 0; }

  /// Errors appear as the errno value; 0 for success.
  int Write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = write(descriptor_, bytes.data(), bytes.size());
      if (written < 0) {
        if (errno == EINTR) {
          continue;
        }
        return errno;
      }
      bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return 0;
  }

  /// Closes and gives the file its final name.
  int Rename(const std::filesystem::path& final_path) {
    const int close_result = close(descriptor_);
    descriptor_ = -1;
    if (close_result != 0 || rename(path_.c_str(), final_path.c_str()) != 0) {
      const int error_number = errno;
      unlink(path_.c_str());
      return error_number;
    }
    return 0;
  }

 private:
  std::filesystem::path path_;
  int descriptor_;
};

std::string HexText(std::span<const unsigned char> bytes) {
  std::string text;
  for (const unsigned char byte : bytes) {
    text += fmt::format("{:02x}", byte);
  }
  return text;
}

/// SHA-256 over any number of pieces.
class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    if (context_ == nullptr || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
      throw SystemError("cannot start SHA-256");
    }
  }

  void Add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }

  std::string Hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    return HexText(std::span(digest.data(), size));
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string ReadFile(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    throw InputError("{}: expected a file, found a folder", path.string());
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw InputError("cannot read {}: {}", path.string(), ReasonOf(errno));
  }
  std::error_code no_size;
  const uintmax_t size_bytes = std::filesystem::file_size(path, no_size);
  std::string bytes;
  if (no_size) {
    bytes.assign(std::istreambuf_iterator<char>(stream), {});  // a pipe, for example
  } else {
    bytes.resize(size_bytes);
    stream.read(bytes.data(), static_cast<std::streamsize>(size_bytes));
    bytes.resize(static_cast<size_t>(stream.gcount()));
  }
  if (stream.bad()) {
    throw InputError("cannot read {}: {}", path.string(), ReasonOf(errno));
  }
  return bytes;
}

void WriteFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::error_code error;
  if (path.has_parent_path()) {
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) {
      throw SystemError("cannot make folder {}: {}", path.parent_path().string(), error.message());
    }
  }
  // The process id keeps two runs that write the same file apart: the last rename wins, and both
  // are whole.
  PartialFile file(path.string() + "." + std::to_string(getpid()) + std::string(kPartialSuffix));
  int error_number = file.IsOpen() ? file.Write(bytes) : errno;
  if (error_number == 0) {
    error_number = file.Rename(path);
  }
  if (error_number != 0) {
    throw SystemError("cannot write {}: {}", path.string(), ReasonOf(error_number));
  }
}

void WriteFileAtomically(const std::filesystem::path& path, std::string_view text) {
  WriteFileAtomically(path, std::as_bytes(std::span(text)));
}

std::string Sha256Hex(std::string_view bytes) {
  Sha256 hash;
  hash.Add(bytes);
  return hash.Hex();
}

std::string Sha256HexOfFile(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw InputError("cannot read {}: {}", path.string(), ReasonOf(errno));
  }
  Sha256 hash;
  std::vector<char> block(size_t{1} << 20);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) ||
         stream.gcount() > 0) {
    hash.Add(std::string_view(block.data(), static_cast<size_t>(stream.gcount())));
  }
  if (stream.bad()) {
    throw InputError("cannot read {}: {}", path.string(), ReasonOf(errno));
  }
  return hash.Hex();
}

}  // namespace pfseq
