// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "config/complaints.h"
#include "config/described/parts.h"
#include "protocols/checked_line.h"

namespace navcal::config::described {
namespace {

using protocols::described::ByteOrder;
using protocols::described::Checksum;
using protocols::described::FrameKind;
using protocols::described::kMaxFrameLength;
using protocols::described::Sum;
using protocols::described::Type;

constexpr auto kLongest = static_cast<std::int64_t>(kMaxFrameLength);
constexpr std::size_t kMaxFields = 128;
constexpr std::size_t kMaxConstants = 16;

std::vector<std::string> sum_names(bool is_text) {
  std::vector<std::string> names;
  if (is_text) names.emplace_back("nmea");
  for (std::size_t i = 0; i < protocols::described::kSumCount; ++i)
    names.emplace_back(name_of(static_cast<Sum>(i)));
  return names;
}

void read_length(TableReader& frame, FrameKind& kind, ByteOrder byte_order, std::vector<Problem>& problems) {
  const Node* node = frame.find("length");
  if (node == nullptr) {
    frame.require("length", "whole bytes, or { at = OFFSET, type = \"u8\", add = N } where the frame states it");
    return;
  }
  if (!std::holds_alternative<Table>(node->value)) {
    if (const auto fixed = frame.whole("length", 1, kLongest))
      kind.length.fixed = static_cast<std::size_t>(*fixed);
    return;
  }
  TableReader table(*node, problems);
  table.require("at", "the offset of the number in the frame");
  table.require("type", "known: u8, u16, u24, u32");
  if (const auto at = table.whole("at", 0, kLongest - 1)) kind.length.at = static_cast<std::uint16_t>(*at);
  if (const auto type = table.choice("type", {"u8", "u16", "u24", "u32"}))
    kind.length.type = protocols::described::type_named(*type).value_or(Type::u8);
  Defaults own;
  own.byte_order = byte_order;
  take_defaults(table, own);
  kind.length.byte_order = own.byte_order;
  if (const auto times = table.whole("times", 1, 16)) kind.length.times = static_cast<int>(*times);
  if (const auto add = table.whole("add", -kLongest, kLongest)) kind.length.add = static_cast<int>(*add);
  if (const auto longest = table.whole("longest", 1, kLongest))
    kind.length.longest = static_cast<std::size_t>(*longest);
  table.finish();
}

void read_constants(TableReader& frame, FrameKind& kind, std::vector<Problem>& problems) {
  const auto nodes = frame.tables("constant");
  if (nodes.size() > kMaxConstants)
    frame.complain("constant", fmt::format("{} constants; {} is the most", nodes.size(), kMaxConstants));
  for (std::size_t i = 0; i < std::min(nodes.size(), kMaxConstants); ++i) {
    TableReader table(*nodes[i], problems);
    table.require("at", "the offset of the bytes in the frame");
    table.require("bytes", "bytes in hexadecimal, such as \"A5 5A\"");
    const auto at = table.whole("at", 0, kLongest - 1);
    const auto bytes = table.bytes("bytes");
    if (bytes && bytes->empty()) table.complain("bytes", "a byte or more is expected");
    table.finish();
    if (at && bytes && !bytes->empty()) kind.constants.push_back({static_cast<std::uint16_t>(*at), *bytes});
  }
}

Sum read_sum(TableReader& table, bool is_text) {
  table.require("kind", fmt::format("known: {}", fmt::join(sum_names(is_text), ", ")));
  const auto kind = table.choice("kind", sum_names(is_text));
  if (!kind) return Sum::none;
  return *kind == "nmea" ? Sum::xor8 : protocols::described::sum_named(*kind).value_or(Sum::none);
}

void read_binary_sum(TableReader& table, Checksum& sum, ByteOrder byte_order) {
  const auto place = [&](std::string_view key, int& into) {
    if (const auto given = table.whole(key, -kLongest, kLongest)) into = static_cast<int>(*given);
  };
  sum.at = -static_cast<int>(size_of(sum.sum));
  place("at", sum.at);
  sum.to = sum.at;
  place("to", sum.to);
  if (sum.sum != Sum::none) table.require("from", "the offset of the first byte that it covers");
  place("from", sum.from);
  Defaults own;
  // The two sums are bytes, which are sent in their order whatever the order within numbers.
  own.byte_order = sum.sum == Sum::fletcher16 ? ByteOrder::big : byte_order;
  take_defaults(table, own);
  sum.byte_order = own.byte_order;
}

void read_text_sum(TableReader& table, Checksum& sum, std::size_t start_length) {
  sum.from = 1;
  if (const auto from = table.whole("from", 0, kLongest)) sum.from = static_cast<int>(*from);
  if (const auto mark = table.character("mark")) {
    const bool is_printable = *mark > ' ' && *mark < 0x7F;
    if (!is_printable || protocols::detail::kHexValue[static_cast<std::uint8_t>(*mark)] < 16)
      table.complain("mark", "a mark is a character that is no hexadecimal digit");
    sum.mark = *mark;
  }
  if (static_cast<std::size_t>(sum.from) > start_length)
    table.complain(
        "from", fmt::format("{} is beyond the start characters: covered is from there up to the mark", sum.from));
}

void read_checksum(TableReader& frame, FrameKind& kind, const Defaults& defaults, std::vector<Problem>& problems) {
  const Node* node = frame.find("checksum");
  if (node == nullptr) {
    frame.require("checksum", "{ kind = \"crc16-ccitt\", from = 2 } or \"none\"");
    return;
  }
  if (!std::holds_alternative<Table>(node->value) || node->is_list) {
    const auto word = frame.choice("checksum", defaults.is_text ? std::vector<std::string>{"none", "nmea"}
                                                                : std::vector<std::string>{"none"});
    if (word == "nmea") kind.checksum = {Sum::xor8, 1, 0, 0, ByteOrder::little, '*'};
    return;
  }
  TableReader table(*node, problems);
  kind.checksum.sum = read_sum(table, defaults.is_text);
  if (defaults.is_text) {
    read_text_sum(table, kind.checksum, kind.start.size());
  } else {
    read_binary_sum(table, kind.checksum, defaults.byte_order);
  }
  table.finish();
}

void read_binary(TableReader& frame, FrameKind& kind, const Defaults& defaults, std::vector<Problem>& problems) {
  frame.require("sync", "the bytes that a frame begins with, in hexadecimal, such as \"A5 5A\"");
  if (const auto sync = frame.bytes("sync")) {
    kind.start = *sync;
    if (kind.start.empty()) frame.complain("sync", "a frame begins with a byte or more that never change");
    if (kind.start.size() > 16) frame.complain("sync", "16 bytes are the most");
  }
  read_length(frame, kind, defaults.byte_order, problems);
  read_constants(frame, kind, problems);
}

void read_text(TableReader& frame, FrameKind& kind, const Defaults& defaults) {
  const auto is_printable = [](char c) { return c >= ' ' && c < 0x7F; };
  if (auto start = frame.text("start")) {
    if (!std::all_of(start->begin(), start->end(), is_printable) || start->size() > 32 || start->starts_with(' '))
      frame.complain("start", "at most 32 printable characters, the first no blank, are expected");
    kind.start = std::move(*start);
  }
  if (const auto count = frame.whole("fields", 1, 128)) kind.count = static_cast<std::size_t>(*count);
  if (kind.start.empty() && !frame.has("fields"))
    frame.complain("fields", "missing; a line without start characters is known by the number of its fields");
  if (const auto longest = frame.whole("longest", 8, kLongest))
    kind.length.longest = static_cast<std::size_t>(*longest);
  else
    kind.length.longest = 512;
  if (kind.start.size() + 1 >= kind.length.longest)
    frame.complain("longest", "a line is longer than its start characters");
  kind.separator = defaults.separator;
  kind.end = defaults.end;
  kind.key_sign = defaults.key_sign;
  if (kind.separator == kind.end) frame.complain("separator", "separator and end are the same character");
}

}  // namespace

void take_defaults(TableReader& table, Defaults& defaults) {
  if (!defaults.is_text) {
    if (const auto order = table.choice("byte_order", {"little", "big"}))
      defaults.byte_order = *order == "big" ? ByteOrder::big : ByteOrder::little;
    return;
  }
  if (const auto separator = table.character("separator"))
    defaults.separator = *separator == '\t' ? ' ' : *separator;
  if (const auto sign = table.character("key_sign")) defaults.key_sign = *sign;
  if (const auto end = table.text("end")) {
    const bool is_known =
        *end == "\r\n" ||
        (end->size() == 1 && (*end == "\n" || *end == "\r" || (end->front() > ' ' && end->front() < 0x7F)));
    if (!is_known)
      table.complain("end",
                     fmt::format("{} is not \"\\n\", \"\\r\\n\", \"\\r\" or a character", to_toml_text(*end)));
    else
      defaults.end = end->back();
  }
}

protocols::described::FrameKind read_frame(const Node& node, Defaults defaults, std::vector<Problem>& problems) {
  const std::size_t before = problems.size();
  FrameKind kind;
  TableReader frame(node, problems);
  frame.require("id", "a name of at most 16 characters, which decoding shows");
  if (const auto id = frame.text("id")) {
    const bool holds = !id->empty() && id->size() <= 16 && std::all_of(id->begin(), id->end(), [](char c) {
      return c > ' ' && c < 0x7F && c != '"' && c != '\\';
    });
    if (!holds)
      frame.complain("id",
                     fmt::format("{} is not 1 to 16 printable characters without blanks", to_toml_text(*id)));
    kind.id = protocols::FrameId(*id);
  }
  take_defaults(frame, defaults);
  if (defaults.is_text) {
    read_text(frame, kind, defaults);
  } else {
    read_binary(frame, kind, defaults, problems);
  }
  read_checksum(frame, kind, defaults, problems);
  auto fields = frame.tables("field");
  if (fields.size() > kMaxFields) {
    frame.complain("field", fmt::format("{} fields; {} is the most", fields.size(), kMaxFields));
    fields.resize(kMaxFields);
  }
  frame.finish();
  for (const Node* field : fields) kind.fields.push_back(read_field(*field, defaults, problems));
  // A value that is wrong in itself would seem to contradict the rest.
  if (problems.size() == before) check_frame(kind, defaults.is_text, node, fields, problems);
  return kind;
}

}  // namespace navcal::config::described
