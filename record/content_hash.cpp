// SPDX-License-Identifier: Apache-2.0
#include "record/content_hash.h"

#include <fcntl.h>
#include <nettle/sha2.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <vector>

#include "base/descriptor.h"

namespace navcal::record {
namespace {

class Sha256 {
 public:
  Sha256() { sha256_init(&context_); }
  void update(std::string_view bytes) {
    sha256_update(&context_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  }
  [[nodiscard]] std::string digest() {
    std::array<unsigned char, SHA256_DIGEST_SIZE> bytes{};
    sha256_digest(&context_, bytes.size(), bytes.data());
    return hexadecimal(bytes);
  }

 private:
  sha256_ctx context_{};
};

}  // namespace

void append_hexadecimal(std::string& text, std::span<const unsigned char> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  for (const unsigned char byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xFU];
  }
}

std::string hexadecimal(std::span<const unsigned char> bytes) {
  std::string text;
  append_hexadecimal(text, bytes);
  return text;
}

std::string sha256_of(std::string_view text) {
  Sha256 hash;
  hash.update(text);
  return hash.digest();
}

std::string sha256_of_file(const std::filesystem::path& file) {
  const auto fail = [&] { throw std::system_error(base::last_error(), file.string()); };
  const base::Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!in) fail();
  Sha256 hash;
  std::vector<char> buffer(std::size_t{1} << 18U);
  for (;;) {
    const ssize_t count = ::read(in.get(), buffer.data(), buffer.size());
    if (count == 0) return hash.digest();
    if (count > 0) hash.update({buffer.data(), static_cast<std::size_t>(count)});
    if (count < 0 && errno != EINTR) fail();
  }
}

}  // namespace navcal::record
