// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/motor_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/import/port_name.h"
#include "config/complaints.h"

namespace navcal::analysis {
namespace {

using protocols::described::Meaning;
using protocols::samples_line::LineWriter;

/// Values of one MOTOR sample, as the channels of a message give them.
struct MotorValues {
  std::optional<double> rpm, rpm_commanded, current_A;
  std::array<std::optional<double>, 3> fins_rad;

  void set(Meaning meaning, double value) {
    if (meaning == Meaning::rpm) rpm = value;
    if (meaning == Meaning::rpm_commanded) rpm_commanded = value;
    if (meaning == Meaning::motor_current) current_A = value;
    if (meaning == Meaning::fin_1) fins_rad[0] = value;
    if (meaning == Meaning::fin_2) fins_rad[1] = value;
    if (meaning == Meaning::fin_3) fins_rad[2] = value;
  }
  void write(LineWriter& line) const {
    line.number("rpm", rpm).number("rpm_commanded", rpm_commanded).number("current_A", current_A);
    if (fins_rad[0] || fins_rad[1] || fins_rad[2]) line.three("fins_rad", fins_rad);
  }
};

}  // namespace

MotorChannels::MotorChannels(config::ChannelMap map) : file_(std::move(map.file)) {
  std::vector<config::Problem> problems;
  for (config::CsvColumn& column : map.channels) {
    const std::size_t point = column.name.rfind('.');
    if (point == std::string::npos || point == 0 || point + 1 == column.name.size()) {
      problems.push_back({column.line, "column." + column.name,
                          "the name of a channel is expected: message, point, member, such as \"RCOU.C1\""});
      continue;
    }
    const std::string message = column.name.substr(0, point);
    const std::string_view port = port_name(PortKind::motor, column.instance);
    auto& groups = groups_[message];
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& of) { return of.port == port; });
    if (group == groups.end()) {
      groups.push_back({fmt::format("{} by the map", message), port, {}});
      if (column.instance > 0) groups.back().name += fmt::format(", {}", port);
      group = groups.end() - 1;
    }
    Channel channel{std::move(column), {}};
    channel.member = channel.column.name.substr(point + 1);
    group->channels.push_back(std::move(channel));
  }
  config::refuse(std::move(problems), file_);
}

bool MotorChannels::has(std::string_view message, std::string_view member) const {
  const auto groups = groups_.find(message);
  if (groups == groups_.end()) return false;
  return std::any_of(groups->second.begin(), groups->second.end(), [&](const Group& group) {
    return std::ranges::any_of(group.channels, [&](const Channel& channel) { return channel.member == member; });
  });
}

bool MotorChannels::emit(std::string_view message, const MemberReader& read, const ImportedSample& sample,
                         ImportSink& sink) {
  const auto groups = groups_.find(message);
  if (groups == groups_.end()) return false;
  bool has_any = false;
  for (Group& group : groups->second) {
    MotorValues values;
    bool has_value = false;
    for (Channel& channel : group.channels) {
      const auto number = read(channel.member);
      if (!number || !std::isfinite(*number)) continue;
      ++channel.values;
      if (channel.column.is_beyond(*number)) ++channel.beyond;
      values.set(channel.column.meaning.quantity, channel.column.value(*number));
      has_value = true;
    }
    if (!has_value) continue;
    LineWriter line("MOTOR");
    values.write(line);
    ImportedSample mapped = sample;
    mapped.message = group.name;
    mapped.port = group.port;
    sink.sample(mapped, line);
    has_any = true;
  }
  return has_any;
}

void MotorChannels::expect_all_found() const {
  std::vector<config::Problem> problems;
  for (const auto& [message, groups] : groups_) {
    for (const Group& group : groups) {
      for (const Channel& channel : group.channels) {
        if (channel.values == 0)
          problems.push_back(
              {channel.column.line, "column." + channel.column.name, "the log has no value of this channel"});
      }
    }
  }
  std::stable_sort(problems.begin(), problems.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
  config::refuse(std::move(problems), file_);
}

std::vector<std::string> MotorChannels::remarks() const {
  std::vector<std::string> remarks;
  for (const auto& [message, groups] : groups_) {
    for (const Group& group : groups) {
      for (const Channel& channel : group.channels) {
        if (channel.beyond == 0) continue;
        const auto& curve = channel.column.curve;
        remarks.push_back(fmt::format("{}: {} of {} values lie beyond {} to {}, and count as its ends",
                                      channel.column.name, channel.beyond, channel.values, curve.front().from,
                                      curve.back().from));
      }
    }
  }
  return remarks;
}

}  // namespace navcal::analysis
