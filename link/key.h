// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "link/frame.h"

namespace navcal::link {

using Nonce = std::array<std::uint8_t, 8>;
using Tag = std::array<std::uint8_t, kTagLength>;

enum class Direction : std::uint8_t { to_vehicle = 1, to_operator = 2 };

/// The key of one session, or of the frames outside sessions. Makes tags and checks them.
class SessionKey {
 public:
  explicit SessionKey(const std::array<std::uint8_t, 32>& bytes) : bytes_(bytes) {}
  /// The first eight bytes of HMAC-SHA-256 over the direction and `covered`.
  [[nodiscard]] Tag tag(Direction direction, Bytes covered) const;
  /// Takes the same time for every wrong tag.
  [[nodiscard]] bool verifies(Direction direction, Bytes covered, Bytes tag) const;

 private:
  std::array<std::uint8_t, 32> bytes_;
};

/// The secret that vehicle and operator share.
class Key {
 public:
  /// 64 hexadecimal digits are 32 bytes; any other text of at least 16 characters is taken as it stands. White
  /// space around it does not count. Throws std::runtime_error, which says why the text is none.
  [[nodiscard]] static Key from_text(std::string_view text);
  /// Reads a file that nobody but its owner can read or write. Throws std::runtime_error, with the file's name.
  [[nodiscard]] static Key from_file(const std::filesystem::path& file);

  /// For MAVLink: the 32 bytes of 64 digits, or the SHA-256 of another text, as ground stations make it.
  [[nodiscard]] std::array<std::uint8_t, 32> of_mavlink() const;

  /// For the frames of a session, from the random numbers of both ends: a frame of another session never fits.
  [[nodiscard]] SessionKey session(const Nonce& vehicle, const Nonce& host) const;
  /// For HELLO, which comes before there is a session.
  [[nodiscard]] SessionKey outside() const { return session({}, {}); }

 private:
  explicit Key(std::string bytes, bool is_digits) : bytes_(std::move(bytes)), is_digits_(is_digits) {}
  std::string bytes_;
  bool is_digits_;
};

/// Eight bytes from the kernel. Throws std::runtime_error when it gives none.
[[nodiscard]] Nonce random_nonce();

}  // namespace navcal::link
