// SPDX-License-Identifier: Apache-2.0
#include "link/key.h"

#include <fmt/format.h>
#include <nettle/hmac.h>
#include <nettle/memops.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace navcal::link {
namespace {

constexpr std::size_t kDigits = 64;
constexpr std::size_t kShortest = 16;
constexpr std::size_t kLongest = 1024;
constexpr std::string_view kPurpose = "navcal link 1";

using Digest = std::array<std::uint8_t, 32>;

Digest hmac(std::string_view key, const Buffer& text) {
  hmac_sha256_ctx context;
  hmac_sha256_set_key(&context, key.size(), reinterpret_cast<const std::uint8_t*>(key.data()));
  hmac_sha256_update(&context, text.size(), text.data());
  Digest digest{};
  hmac_sha256_digest(&context, digest.size(), digest.data());
  return digest;
}

int value_of(char digit) {
  constexpr std::string_view kHexadecimal = "0123456789abcdef";
  const auto at = kHexadecimal.find(digit >= 'A' && digit <= 'F' ? static_cast<char>(digit - 'A' + 'a') : digit);
  return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

}  // namespace

Tag SessionKey::tag(Direction direction, Bytes covered) const {
  Buffer text{static_cast<std::uint8_t>(direction)};
  text.insert(text.end(), covered.begin(), covered.end());
  const Digest digest = hmac({reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}, text);
  Tag tag{};
  std::copy_n(digest.begin(), tag.size(), tag.begin());
  return tag;
}

bool SessionKey::verifies(Direction direction, Bytes covered, Bytes given) const {
  const Tag right = tag(direction, covered);
  return given.size() == right.size() && memeql_sec(given.data(), right.data(), right.size()) != 0;
}

Key Key::from_text(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) throw std::runtime_error("the key is empty");
  text = text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
  if (text.size() > kLongest)
    throw std::runtime_error(fmt::format("the key is longer than {} characters", kLongest));
  if (text.size() == kDigits && std::ranges::all_of(text, [](char c) { return value_of(c) >= 0; })) {
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); i += 2)
      bytes.push_back(static_cast<char>(value_of(text[i]) << 4 | value_of(text[i + 1])));
    return Key(std::move(bytes), true);
  }
  if (text.size() < kShortest)
    throw std::runtime_error(
        fmt::format("the key has {} characters; it needs {} or more, or {} hexadecimal digits", text.size(),
                    kShortest, kDigits));
  return Key(std::string(text), false);
}

Key Key::from_file(const std::filesystem::path& file) {
  const auto failed = [&](const std::string& why) { return std::runtime_error(file.string() + ": " + why); };
  struct stat info {};
  if (::stat(file.c_str(), &info) != 0) throw failed(std::strerror(errno));
  if (!S_ISREG(info.st_mode)) throw failed("not a file");
  if ((info.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    throw failed("others than its owner have access; chmod 600 ends that");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw failed("cannot be read");
  std::string text(kLongest + 16, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  try {
    return from_text(text);
  } catch (const std::runtime_error& error) {
    throw failed(error.what());
  }
}

std::array<std::uint8_t, 32> Key::of_mavlink() const {
  Digest digest{};
  const auto* const first = reinterpret_cast<const std::uint8_t*>(bytes_.data());
  if (is_digits_) {
    std::copy_n(first, digest.size(), digest.begin());
    return digest;
  }
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, bytes_.size(), first);
  sha256_digest(&context, digest.size(), digest.data());
  return digest;
}

SessionKey Key::session(const Nonce& vehicle, const Nonce& host) const {
  Buffer text(kPurpose.begin(), kPurpose.end());
  text.insert(text.end(), vehicle.begin(), vehicle.end());
  text.insert(text.end(), host.begin(), host.end());
  return SessionKey(hmac(bytes_, text));
}

Nonce random_nonce() {
  Nonce nonce{};
  if (::getrandom(nonce.data(), nonce.size(), 0) != static_cast<ssize_t>(nonce.size()))
    throw std::runtime_error("the kernel gives no random numbers");
  return nonce;
}

}  // namespace navcal::link
