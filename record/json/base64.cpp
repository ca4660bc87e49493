// SPDX-License-Identifier: Apache-2.0
#include "record/json/base64.h"

#include <nettle/base64.h>

#include <cstdint>

namespace navcal::record {

std::string base64(std::string_view bytes) {
  std::string text(BASE64_ENCODE_RAW_LENGTH(bytes.size()), '\0');
  base64_encode_raw(text.data(), bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  return text;
}

std::optional<std::string> from_base64(std::string_view text) {
  base64_decode_ctx context;
  base64_decode_init(&context);
  std::string bytes(BASE64_DECODE_LENGTH(text.size()), '\0');
  std::size_t length = bytes.size();
  auto* const out = reinterpret_cast<std::uint8_t*>(bytes.data());
  if (base64_decode_update(&context, &length, out, text.size(), text.data()) == 0) return std::nullopt;
  // Nettle passes over white space, which is no part of it here.
  if (base64_decode_final(&context) == 0 || BASE64_ENCODE_RAW_LENGTH(length) != text.size()) return std::nullopt;
  bytes.resize(length);
  return bytes;
}

}  // namespace navcal::record
