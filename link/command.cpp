// SPDX-License-Identifier: Apache-2.0
#include "link/command.h"

#include "link/fields.h"

namespace navcal::link {
namespace {

constexpr double kTimeoutStep_s = 0.01;
constexpr double kFinStep_deg = 0.01;
constexpr std::size_t kHolderBytes = 64;
constexpr std::size_t kErrorBytes = 160;
constexpr std::uint8_t kOk = 1;
constexpr std::uint8_t kShaped = 2;
constexpr std::uint8_t kInCharge = 4;

/// A field without a value: a sender that had none to send.
bool take(std::optional<double> field, double& value) {
  value = field.value_or(0);
  return field.has_value();
}

}  // namespace

Buffer encode_command(const Command& command) {
  FieldWriter out;
  out.put(static_cast<std::uint8_t>(command.kind));
  out.put(command.number);
  if (command.kind == Command::Kind::lease) {
    out.put(command.priority);
    out.put_scaled<std::uint16_t>(command.timeout_s, kTimeoutStep_s);
    out.put_text(command.holder, kHolderBytes);
  } else if (command.kind == Command::Kind::order) {
    out.put_scaled<std::int32_t>(command.shaft_rpm, 1);
    for (const double fin_deg : command.fins_deg) out.put_scaled<std::int16_t>(fin_deg, kFinStep_deg);
  } else if (command.kind == Command::Kind::stop) {
    out.put_text(command.holder, kHolderBytes);
  }
  return std::move(out).take();
}

std::optional<Command> decode_command(Bytes payload) {
  FieldReader in(payload);
  Command command;
  const auto kind = in.get<std::uint8_t>();
  command.number = in.get<std::uint16_t>();
  bool is_good = true;
  switch (kind) {
    case static_cast<std::uint8_t>(Command::Kind::lease):
      command.kind = Command::Kind::lease;
      command.priority = in.get<std::uint16_t>();
      is_good = take(in.get_scaled<std::uint16_t>(kTimeoutStep_s), command.timeout_s);
      command.holder = in.get_text();
      break;
    case static_cast<std::uint8_t>(Command::Kind::order):
      command.kind = Command::Kind::order;
      is_good = take(in.get_scaled<std::int32_t>(1), command.shaft_rpm);
      for (double& fin_deg : command.fins_deg)
        is_good = take(in.get_scaled<std::int16_t>(kFinStep_deg), fin_deg) && is_good;
      break;
    case static_cast<std::uint8_t>(Command::Kind::release): break;
    case static_cast<std::uint8_t>(Command::Kind::stop):
      command.kind = Command::Kind::stop;
      command.holder = in.get_text();
      break;
    default: return std::nullopt;
  }
  if (!is_good || !in.is_whole() || !in.rest().empty()) return std::nullopt;
  return command;
}

Buffer encode_answer(const CommandAnswer& answer) {
  FieldWriter out;
  out.put(answer.number);
  out.put(static_cast<std::uint8_t>((answer.is_ok ? kOk : 0) | (answer.is_shaped ? kShaped : 0) |
                                    (answer.is_in_charge ? kInCharge : 0)));
  out.put_text(answer.error, kErrorBytes);
  return std::move(out).take();
}

std::optional<CommandAnswer> decode_answer(Bytes payload) {
  FieldReader in(payload);
  CommandAnswer answer;
  answer.number = in.get<std::uint16_t>();
  const auto flags = in.get<std::uint8_t>();
  answer.is_ok = (flags & kOk) != 0;
  answer.is_shaped = (flags & kShaped) != 0;
  answer.is_in_charge = (flags & kInCharge) != 0;
  answer.error = in.get_text();
  if (!in.is_whole() || !in.rest().empty()) return std::nullopt;
  return answer;
}

}  // namespace navcal::link
