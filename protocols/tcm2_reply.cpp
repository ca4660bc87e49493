// SPDX-License-Identifier: Apache-2.0
#include "protocols/tcm2_reply.h"

#include <algorithm>
#include <string>

#include "protocols/decimal.h"

namespace navcal::protocols::tcm2 {
namespace {

/// Takes `letter` and the number behind it.
std::optional<double> take_lettered(std::string_view& text, char letter) {
  if (!text.starts_with(letter)) return std::nullopt;
  text.remove_prefix(1);
  return take_decimal(text);
}

std::optional<CalibrationScore> score_in(std::string_view text) {
  const auto horizontal = take_lettered(text, 'H');
  const auto vertical = take_lettered(text, 'V');
  const auto magnitude = take_lettered(text, 'M');
  if (!horizontal || !vertical || !magnitude || !text.empty()) return std::nullopt;
  const auto is_digit = [](double value) { return value >= 0 && value <= 9; };
  if (!is_digit(*horizontal) || !is_digit(*vertical)) return std::nullopt;
  return CalibrationScore{static_cast<std::uint8_t>(*horizontal), static_cast<std::uint8_t>(*vertical),
                          *magnitude};
}

bool is_parameter(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

}  // namespace

std::optional<Reply> decode_reply(Bytes line) {
  std::string_view text(reinterpret_cast<const char*>(line.data()), line.size());
  while (text.ends_with('\n') || text.ends_with('\r')) text.remove_suffix(1);
  const bool colon = text.starts_with(':');
  if (colon) text.remove_prefix(1);
  if (const auto score = score_in(text)) return Reply{Reply::Kind::calibration, 0, {}, {}, *score};
  if (!colon) return std::nullopt;
  if (text.empty()) return Reply{};
  if (text.front() == 'E' && text.size() <= 5) {
    const auto error = integer<std::uint32_t>(text.substr(1), 16);
    return error ? std::optional(Reply{Reply::Kind::refused, *error, {}, {}, {}}) : std::nullopt;
  }
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || !is_parameter(text.substr(0, equals)) || equals + 1 == text.size()) {
    return std::nullopt;
  }
  return Reply{Reply::Kind::value, 0, text.substr(0, equals), text.substr(equals + 1), {}};
}

std::vector<std::uint8_t> encode_reply(const Reply& reply) {
  std::string text;
  switch (reply.kind) {
    case Reply::Kind::accepted: text = ":"; break;
    case Reply::Kind::refused:
      text = ":E";
      append_hex(text, reply.error, 3);
      break;
    case Reply::Kind::value:
      text = ':';
      text.append(reply.parameter).append("=").append(reply.value);
      break;
    case Reply::Kind::calibration:
      text = 'H' + std::to_string(reply.score.horizontal) + 'V' + std::to_string(reply.score.vertical) + 'M';
      append_decimal(text, reply.score.magnitude, 2);
      break;
  }
  text += "\r\n";
  return {text.begin(), text.end()};
}

}  // namespace navcal::protocols::tcm2
