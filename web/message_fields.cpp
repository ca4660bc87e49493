// SPDX-License-Identifier: Apache-2.0
#include "web/message_fields.h"

#include "protocols/decimal.h"

namespace navcal::web {
namespace {

/// What follows `"key":`; empty when the key is not there.
std::string_view after_key(std::string_view message, std::string_view key) {
  for (auto at = message.find(key); at != std::string_view::npos; at = message.find(key, at + 1)) {
    const auto end = at + key.size();
    if (at > 0 && message[at - 1] == '"' && message.substr(end, 2) == "\":") return message.substr(end + 2);
  }
  return {};
}

}  // namespace

std::string_view member_text(std::string_view message, std::string_view key) {
  const std::string_view value = after_key(message, key);
  if (!value.starts_with('"')) return value.substr(0, value.find_first_of(",}"));
  for (std::size_t i = 1; i < value.size(); ++i) {
    if (value[i] == '\\') {
      ++i;
    } else if (value[i] == '"') {
      return value.substr(1, i - 1);
    }
  }
  return {};
}

std::optional<double> member_number(std::string_view message, std::string_view key) {
  return protocols::real(member_text(message, key));
}

}  // namespace navcal::web
