// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/ulog_format.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "analysis/import/wire_reader.h"
#include "base/line_reader.h"

namespace navcal::analysis::ulog {
namespace {

constexpr std::array<std::pair<std::string_view, std::size_t>, 12> kPlainTypes{{{"int8_t", 1},
                                                                                {"uint8_t", 1},
                                                                                {"bool", 1},
                                                                                {"char", 1},
                                                                                {"int16_t", 2},
                                                                                {"uint16_t", 2},
                                                                                {"int32_t", 4},
                                                                                {"uint32_t", 4},
                                                                                {"float", 4},
                                                                                {"int64_t", 8},
                                                                                {"uint64_t", 8},
                                                                                {"double", 8}}};
constexpr int kDeepest = 8;
constexpr std::size_t kMostElements = 65'536, kMostFields = 1000;

/// "float[4] q" without its offset and size.
std::optional<UlogField> field_of(std::string_view text) {
  const std::size_t blank = text.find(' ');
  if (blank == std::string_view::npos) return std::nullopt;
  UlogField field;
  field.name = text.substr(blank + 1);
  std::string_view type = text.substr(0, blank);
  if (const std::size_t bracket = type.find('['); bracket != std::string_view::npos) {
    const std::string_view digits = type.substr(bracket + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), field.count);
    if (error != std::errc{} || end == digits.data() + digits.size() || *end != ']' || field.count > kMostElements)
      return std::nullopt;
    type = type.substr(0, bracket);
  }
  field.type = type;
  return field;
}

double plain_number(std::string_view type, std::string_view message, std::size_t at) {
  if (type == "float") return static_cast<double>(little_endian_at<float>(message, at));
  if (type == "double") return little_endian_at<double>(message, at);
  if (type == "int8_t") return little_endian_at<std::int8_t>(message, at);
  if (type == "int16_t") return little_endian_at<std::int16_t>(message, at);
  if (type == "uint16_t") return little_endian_at<std::uint16_t>(message, at);
  if (type == "int32_t") return little_endian_at<std::int32_t>(message, at);
  if (type == "uint32_t") return little_endian_at<std::uint32_t>(message, at);
  if (type == "int64_t") return static_cast<double>(little_endian_at<std::int64_t>(message, at));
  if (type == "uint64_t") return static_cast<double>(little_endian_at<std::uint64_t>(message, at));
  return little_endian_at<std::uint8_t>(message, at);
}

}  // namespace

const UlogField* UlogFormat::find(std::string_view name) const {
  const auto found = std::ranges::find_if(fields, [&](const UlogField& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

std::optional<double> UlogFormat::number(std::string_view message, std::string_view name, std::size_t i) const {
  const UlogField* const field = find(name);
  if (field == nullptr || i >= field->count) return std::nullopt;
  const std::size_t at = field->offset + i * field->size;
  if (at + field->size > message.size()) return std::nullopt;
  return plain_number(field->type, message, at);
}

std::optional<std::uint64_t> UlogFormat::unsigned_number(std::string_view message, std::string_view name) const {
  const UlogField* const field = find(name);
  if (field == nullptr || field->type != "uint64_t" || field->offset + sizeof(std::uint64_t) > message.size())
    return std::nullopt;
  return little_endian_at<std::uint64_t>(message, field->offset);
}

void UlogFormats::learn(std::string_view definition) {
  const std::size_t colon = definition.find(':');
  if (colon == std::string_view::npos) return;
  definitions_[std::string(definition.substr(0, colon))] = definition.substr(colon + 1);
  formats_.clear();
}

const UlogFormat* UlogFormats::find(const std::string& name, int depth) {
  // Each type is laid out once; until then it has no layout, so that none contains itself.
  const auto [found, is_new] = formats_.try_emplace(name);
  if (is_new) found->second = laid_out(name, depth);
  return found->second ? &*found->second : nullptr;
}

std::optional<std::size_t> UlogFormats::size_of(const std::string& type, int depth) {
  const auto plain = std::ranges::find_if(kPlainTypes, [&](const auto& t) { return t.first == type; });
  if (plain != kPlainTypes.end()) return plain->second;
  const UlogFormat* const nested = find(type, depth + 1);
  return nested != nullptr ? std::optional(nested->size) : std::nullopt;
}

std::optional<UlogFormat> UlogFormats::laid_out(const std::string& name, int depth) {
  const auto definition = definitions_.find(name);
  if (definition == definitions_.end() || depth > kDeepest) return std::nullopt;
  UlogFormat format;
  std::string_view rest = definition->second;
  while (!rest.empty()) {
    const std::string_view text = base::take_until(rest, ";");
    if (text.empty()) continue;
    auto field = field_of(text);
    const auto size = field ? size_of(field->type, depth) : std::nullopt;
    if (!size || format.size > kMostElements || format.fields.size() == kMostFields) return std::nullopt;
    field->offset = format.size;
    field->size = *size;
    format.size += *size * field->count;
    format.fields.push_back(std::move(*field));
  }
  return format;
}

}  // namespace navcal::analysis::ulog
