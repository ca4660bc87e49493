// SPDX-License-Identifier: Apache-2.0
#include "protocols/motor_card.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "protocols/checked_line.h"
#include "protocols/decimal.h"

namespace navcal::protocols::motor_card {
namespace {

/// The fields behind the three letters; nullopt when there are not exactly N.
template <std::size_t N>
std::optional<std::array<std::string_view, N>> fields_of(Bytes frame, FrameId id) {
  std::string_view rest = body_of(frame);
  if (!rest.starts_with(id.view())) return std::nullopt;
  rest.remove_prefix(id.view().size());
  std::array<std::string_view, N> fields;
  for (auto& field : fields) {
    if (!rest.starts_with(',')) return std::nullopt;
    rest.remove_prefix(1);
    field = rest.substr(0, rest.find(','));
    rest.remove_prefix(field.size());
  }
  if (!rest.empty()) return std::nullopt;
  return fields;
}

/// An empty field leaves `value` absent; false when the field is not a number.
bool read(std::string_view field, std::optional<double>& value) {
  if (!field.empty()) value = decimal(field);
  return field.empty() || value.has_value();
}

template <std::integral T>
bool read(std::string_view field, std::optional<T>& value) {
  if (!field.empty()) value = integer<T>(field);
  return field.empty() || value.has_value();
}

void append_field(std::string& body, const std::optional<double>& value, int decimals) {
  body += ',';
  if (value) append_decimal(body, *value, decimals);
}

template <std::integral T>
void append_field(std::string& body, const std::optional<T>& value) {
  body += ',';
  if (value) body += std::to_string(*value);
}

}  // namespace

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  constexpr std::string_view kStart = "$MC";
  const auto available = static_cast<std::size_t>(last - first);
  if (!std::equal(kStart.begin(), kStart.begin() + std::min(available, kStart.size()), first)) {
    return Scan::not_a_frame();
  }
  if (available > 3 && first[3] != 'S' && first[3] != 'C') return Scan::not_a_frame();
  if (available > 4 && first[4] != ',') return Scan::not_a_frame();
  if (available < 5) return Scan::incomplete(9 - available);  // up to the comma, then `*hh<LF>`
  return scan_checked_line(first, last, kMaxFrameLength, first[3] == 'S' ? kMcs : kMcc);
}

std::optional<Status> decode_status(Bytes frame) {
  const auto fields = fields_of<7>(frame, kMcs);
  if (!fields) return std::nullopt;
  const auto& f = *fields;
  Status status;
  if (!read(f[0], status.sequence) || !read(f[1], status.rpm_commanded) || !read(f[2], status.rpm) ||
      !read(f[3], status.fins_deg[0]) || !read(f[4], status.fins_deg[1]) || !read(f[5], status.fins_deg[2]) ||
      !read(f[6], status.current_A)) {
    return std::nullopt;
  }
  return status;
}

std::optional<Command> decode_command(Bytes frame) {
  const auto fields = fields_of<4>(frame, kMcc);
  if (!fields) return std::nullopt;
  const auto rpm = integer<std::int32_t>((*fields)[0]);
  if (!rpm) return std::nullopt;
  Command command{*rpm, {}};
  for (std::size_t i = 0; i < command.fins_deg.size(); ++i) {
    const auto fin = decimal((*fields)[i + 1]);
    if (!fin) return std::nullopt;
    command.fins_deg[i] = *fin;
  }
  return command;
}

std::vector<std::uint8_t> encode_status(const Status& status) {
  std::string body(kMcs.view());
  append_field(body, status.sequence);
  append_field(body, status.rpm_commanded);
  append_field(body, status.rpm);
  for (const auto& fin : status.fins_deg) append_field(body, fin, 1);
  append_field(body, status.current_A, 2);
  return checked_line(body);
}

std::vector<std::uint8_t> encode_command(const Command& command) {
  std::string body(kMcc.view());
  body += ',';
  body += std::to_string(command.rpm);
  for (const double fin : command.fins_deg) append_field(body, fin, 1);
  return checked_line(body);
}

}  // namespace navcal::protocols::motor_card
