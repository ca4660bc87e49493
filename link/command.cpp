// SPDX-License-Identifier: Apache-2.0
#include "link/command.h"

#include "link/fields.h"

namespace navcal::link {
namespace {

constexpr double kTimeoutStep_s = 0.01;
constexpr double kFinStep_deg = 0.01;
constexpr std::size_t kHolderBytes = 64;
constexpr std::size_t kErrorBytes = 160;

template <class Fields, class Content>
void lay_out_command(Fields& fields, Content& command) {
  fields.number(command.number);
  if (command.kind == Command::Kind::lease) {
    fields.number(command.priority);
    fields.template scaled<std::uint16_t>(command.timeout_s, kTimeoutStep_s);
  } else if (command.kind == Command::Kind::order) {
    fields.template scaled<std::int32_t>(command.shaft_rpm, 1);
    for (auto& fin_deg : command.fins_deg) fields.template scaled<std::int16_t>(fin_deg, kFinStep_deg);
  }
  if (command.kind == Command::Kind::lease || command.kind == Command::Kind::stop)
    fields.text(command.holder, kHolderBytes);
}

void lay_out_answer(auto& fields, auto& answer) {
  fields.number(answer.number);
  fields.flags(answer.is_ok, answer.is_shaped, answer.is_in_charge);
  fields.text(answer.error, kErrorBytes);
}

}  // namespace

Buffer encode_command(const Command& command) {
  FieldWriter out;
  out.put(static_cast<std::uint8_t>(command.kind));
  lay_out_command(out, command);
  return std::move(out).take();
}

std::optional<Command> decode_command(Bytes payload) {
  FieldReader in(payload);
  Command command;
  command.kind = static_cast<Command::Kind>(in.get<std::uint8_t>());
  if (command.kind < Command::Kind::lease || command.kind > Command::Kind::stop) return std::nullopt;
  lay_out_command(in, command);
  return in.is_all() ? std::optional(std::move(command)) : std::nullopt;
}

Buffer encode_answer(const CommandAnswer& answer) {
  FieldWriter out;
  lay_out_answer(out, answer);
  return std::move(out).take();
}

std::optional<CommandAnswer> decode_answer(Bytes payload) {
  FieldReader in(payload);
  CommandAnswer answer;
  lay_out_answer(in, answer);
  return in.is_all() ? std::optional(std::move(answer)) : std::nullopt;
}

}  // namespace navcal::link
