// SPDX-License-Identifier: Apache-2.0
#include "protocols/tcm2_word.h"

#include <array>
#include <string>

#include "protocols/checked_line.h"
#include "protocols/decimal.h"

namespace navcal::protocols::tcm2 {
namespace {

/// The fields that hold a decimal number, in the order of kFieldLetters.
constexpr std::array kNumbers{&Word::heading, &Word::pitch, &Word::roll,       &Word::x,
                              &Word::y,       &Word::z,     &Word::temperature};

int decimals_of(std::optional<double> Word::*field, const WordFormat& format) {
  if (field == &Word::temperature) return format.temperature;
  return field == &Word::x || field == &Word::y || field == &Word::z ? format.field : format.angles;
}

constexpr std::string_view kHchdmStart = "HCHDM,";
constexpr std::string_view kHchdmEnd = ",M";

}  // namespace

std::optional<Word> decode_word(Bytes frame) {
  std::string_view rest = body_of(frame);
  if (rest.empty()) return std::nullopt;
  Word word;
  for (std::size_t i = 0; i < kNumbers.size(); ++i) {
    if (!rest.starts_with(kFieldLetters[i])) continue;
    rest.remove_prefix(1);
    const auto value = take_decimal(rest);
    if (!value) return std::nullopt;
    word.*kNumbers[i] = value;
  }
  if (rest.starts_with(":E")) rest.remove_prefix(1);
  if (rest.starts_with('E')) {
    word.error = integer<std::uint32_t>(rest.substr(1), 16);
    if (!word.error) return std::nullopt;
    rest = {};
  }
  if (!rest.empty()) return std::nullopt;
  return word;
}

std::vector<std::uint8_t> encode_word(const Word& word, const WordFormat& format) {
  std::string body;
  for (std::size_t i = 0; i < kNumbers.size(); ++i) {
    const auto& value = word.*kNumbers[i];
    if (!value) continue;
    body += kFieldLetters[i];
    append_decimal(body, *value, decimals_of(kNumbers[i], format));
  }
  if (word.error) {
    body += 'E';
    append_hex(body, *word.error, 3);
  }
  return checked_line(body);
}

std::optional<double> decode_hchdm(Bytes frame) {
  std::string_view text = body_of(frame);
  if (!text.starts_with(kHchdmStart) || !text.ends_with(kHchdmEnd)) return std::nullopt;
  text.remove_prefix(kHchdmStart.size());
  if (text.size() < kHchdmEnd.size()) return std::nullopt;  // `HCHDM,M`: one comma serves both
  text.remove_suffix(kHchdmEnd.size());
  return decimal(text);
}

std::vector<std::uint8_t> encode_hchdm(double heading_deg) {
  std::string body(kHchdmStart);
  append_decimal(body, heading_deg, 1);
  body += kHchdmEnd;
  return checked_line(body);
}

}  // namespace navcal::protocols::tcm2
