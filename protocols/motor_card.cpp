// SPDX-License-Identifier: Apache-2.0
#include "protocols/motor_card.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "protocols/checked_line.h"
#include "protocols/text_fields.h"

namespace navcal::protocols::motor_card {
namespace {

constexpr auto kLayOutStatus = [](auto& line, auto& status) {
  line.number(status.sequence);
  line.number(status.rpm_commanded);
  line.number(status.rpm);
  line.number(status.fins_deg, Print{1});
  line.number(status.current_A, Print{2});
};

constexpr auto kLayOutCommand = [](auto& line, auto& command) {
  line.number(command.rpm);
  line.number(command.fins_deg, Print{1});
};

template <class Message, class LayOut>
std::optional<Message> decoded(Bytes frame, FrameId id, LayOut lay_out) {
  const std::string_view body = body_of(frame);
  const std::size_t name = id.view().size();
  if (!body.starts_with(id.view()) || body.substr(name, 1) != ",") return std::nullopt;
  return content_of<Message>(LineReader(body.substr(name + 1), decimal), lay_out);
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

std::optional<Status> decode_status(Bytes frame) { return decoded<Status>(frame, kMcs, kLayOutStatus); }
std::optional<Command> decode_command(Bytes frame) { return decoded<Command>(frame, kMcc, kLayOutCommand); }

std::vector<std::uint8_t> encode_status(const Status& status) {
  return checked_line(line_of(kMcs.view(), status, kLayOutStatus));
}
std::vector<std::uint8_t> encode_command(const Command& command) {
  return checked_line(line_of(kMcc.view(), command, kLayOutCommand));
}

}  // namespace navcal::protocols::motor_card
