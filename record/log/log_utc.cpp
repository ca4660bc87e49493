// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_utc.h"

#include "record/json/json_object.h"
#include "record/json/mapping_json.h"

namespace navcal::record {
namespace {

using pipeline::UtcMapping;

enum class UtcKind : std::uint8_t { none, unbounded, bounded };

UtcKind utc_kind(const UtcMapping& mapping) {
  using enum UtcMapping::Source;
  const bool is_system = mapping.source == system || mapping.source == system_synchronised;
  if (mapping.source == none || (is_system && mapping.to_utc(mapping.at_ns) < pipeline::kFirstUtc_ns))
    return UtcKind::none;
  // A log that was made of a file has one mapping.
  const bool is_bounded = mapping.source == file || mapping.bound_ns != UtcMapping::kUnknownBound;
  return is_bounded ? UtcKind::bounded : UtcKind::unbounded;
}

}  // namespace

LogUtc::LogUtc(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) return;
  LogReader log(open_file(file), file.string());
  while (utc_kind(best_) != UtcKind::bounded) {
    const auto message = log.next();
    if (!message) break;
    if (log.channels().at(message->channel).topic != "/time") continue;
    const auto mapping = mapping_from_json(message->data);
    if (mapping && utc_kind(*mapping) > utc_kind(best_)) best_ = *mapping;
  }
}

const UtcMapping& LogUtc::in_place_of(const UtcMapping& logged) const {
  return utc_kind(logged) < utc_kind(best_) ? best_ : logged;
}

bool LogUtc::is_known() const { return utc_kind(mapping()) != UtcKind::none; }

std::string_view LogUtc::on_scale(const LogMessage& message, const LogReader& log) {
  if (log.channels().at(message.channel).topic == "/time") {
    if (const auto change = mapping_from_json(message.data)) {
      before_ = logged_;
      logged_ = *change;
    }
  }
  const auto monotonic_ns = [&](std::uint64_t time_ns) {
    return static_cast<std::int64_t>(time_ns) - log.log_offset_ns();
  };
  const std::int64_t validity_ns = monotonic_ns(message.publish_time_ns);
  const std::int64_t shift_ns = mapping().offset_ns - logged_.offset_ns;
  // A sample of before a change may be logged behind it.
  if (shift_ns == 0 && in_place_of(before_).offset_ns == before_.offset_ns) return message.data;
  text_ = message.data;
  const auto put = [this](std::string_view key, auto&& moved) {
    const std::size_t found = text_.find(key);
    if (found == std::string::npos) return;
    const std::size_t begin = found + key.size(), length = text_.find_first_of(",}", begin) - begin;
    const auto was_ns = nanoseconds(std::string_view(text_).substr(begin, length));
    if (!was_ns) return;
    std::string text;
    append_seconds(text, moved(*was_ns));
    text_.replace(begin, length, text);
  };
  put("\"time\":", [&](std::int64_t was_ns) {
    // Others are stated by the instrument, and stay.
    const bool is_mapped = was_ns == logged_.to_utc(validity_ns) || was_ns == before_.to_utc(validity_ns);
    return is_mapped ? mapping().to_utc(validity_ns) : was_ns;
  });
  put("\"arrival\":",
      [&](std::int64_t /*was_ns*/) { return mapping().to_utc(monotonic_ns(message.log_time_ns)); });
  for (const std::string_view key : {"\"asked\":", "\"sent\":", "\"echoed\":"})
    put(key, [&](std::int64_t was_ns) { return was_ns + shift_ns; });
  return text_;
}

}  // namespace navcal::record
