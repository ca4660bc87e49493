// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string>

#include "analysis/decode_describe.h"
#include "base/line_reader.h"
#include "protocols/samples_line.h"

namespace navcal::analysis {
namespace {

namespace samples_line = protocols::samples_line;

/// A key that needs no escape and that does not stand for the frame itself.
bool is_own_key(std::string_view key) {
  constexpr std::array<std::string_view, 5> kOfFrame{"class", "protocol", "id", "offset", "length"};
  const bool is_plain = std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
  return is_plain && !key.empty() && std::find(kOfFrame.begin(), kOfFrame.end(), key) == kOfFrame.end();
}

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

void write_list(FieldWriter& fields, std::string_view key, std::string_view inside) {
  fields.begin_list(key);
  while (!inside.empty()) fields.written({}, base::trimmed(base::take_until(inside, ",")));
  fields.end_list();
}

}  // namespace

// Values stand as they were sent: times have more digits than a double.
void describe_samples(FieldWriter& fields, const protocols::Frame& frame) {
  const auto object = samples_line::Object::parse(frame.bytes);
  if (!object) return write_out_of_range(fields);
  samples_line::Fields reader(*object);
  for (std::size_t i = 0; i < object->size(); ++i) {
    const samples_line::Member& member = (*object)[i];
    if (!is_own_key(member.key) || object->find(member.key) != &member) continue;
    switch (member.kind) {
      case samples_line::Kind::text:
        if (is_ascii(member.value)) {
          fields.written(member.key, '"' + std::string(member.value) + '"');
        } else {
          fields.text(member.key, reader.text(member.key).value_or(""));
        }
        break;
      case samples_line::Kind::list:
        if (member.value.find('"') == std::string_view::npos) write_list(fields, member.key, member.value);
        break;
      default: fields.written(member.key, member.value);
    }
  }
}

}  // namespace navcal::analysis
