// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/noise_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "base/printable.h"
#include "config/load.h"
#include "config/option_lookup.h"
#include "config/options.h"

namespace navcal::analysis {
namespace {

constexpr std::string_view kTable = "instruments";

/// The channels of one port for a key.
std::vector<const RecordedChannel*> channels_for(const NoiseReport& report, std::string_view key,
                                                 const std::string& port) {
  std::vector<const RecordedChannel*> channels;
  for (const RecordedChannel& recorded : report.channels) {
    if (recorded.channel->setting == key && recorded.port == port) channels.push_back(&recorded);
  }
  return channels;
}

std::optional<double> root_mean_square(const std::vector<const RecordedChannel*>& channels) {
  double squares = 0, count = 0;
  for (const auto* recorded : channels) {
    const auto noise = recorded->noise.to_reckon();
    if (!noise) continue;
    squares += *noise * *noise;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return std::strtod(fmt::format("{:.3g}", std::sqrt(squares / count)).c_str(), nullptr);
}

FoundSetting found_setting(const NoiseReport& report, const config::Settings& settings, const NoiseChannel& row) {
  FoundSetting found{row.setting, {}, std::nullopt};
  const std::string named = row.role ? settings.roles.chosen_name(*row.role) : "";
  for (const auto& port : settings.ports) {
    if (!named.empty() && port.name != named) continue;
    auto channels = channels_for(report, row.setting, port.name);
    const auto value = root_mean_square(channels);
    if (found.channels.empty() || (value && !found.value)) found.channels = std::move(channels);
    if (!found.value) found.value = value;
  }
  return found;
}

std::string comment_of(const FoundSetting& found) {
  if (found.channels.empty()) return "# Not determined: the recording has no such readings.\n";
  std::string comment = found.value ? "# At rest, root mean square of\n" : "# Not determined:\n";
  for (const auto* recorded : found.channels) {
    const auto noise = recorded->noise.to_reckon();
    comment += noise ? fmt::format("#   {} {:.4g} +- {:.1g}, {} readings\n", recorded->name(), *noise,
                                   recorded->noise.to_reckon_error(), recorded->noise.readings)
                     : fmt::format("#   {}: {}\n", recorded->name(), why_unknown(*recorded));
  }
  return comment;
}

/// A recording at rest shows the bias of one power-on, not how it differs from one to the next.
std::string turn_on_comment(const NoiseReport& report) {
  std::string comment;
  for (const RecordedChannel& recorded : report.channels) {
    if (recorded.channel->setting != "imu_gyro_noise_deg_s" || recorded.noise.readings == 0) continue;
    if (comment.empty())
      comment = "# Not determined by one recording. The means of this one, the Earth's turn included:\n";
    comment += fmt::format("#   {} {:.4g}\n", recorded.name(), recorded.noise.mean);
  }
  return comment;
}

/// Sets the value where the key allows it. What is beyond its range is left, with a comment.
std::string apply(const FoundSetting& found, config::Settings& settings) {
  std::string comment = comment_of(found);
  if (!found.value) return comment;
  const auto* const option = config::find(config::daemon_options(), kTable, found.key);
  config::Value value(*found.value);
  if (option == nullptr) return comment;
  if (option->adopt(value))
    return comment + fmt::format("# {:.3g} is outside the range of this key: left as it was.\n", *found.value);
  option->set(settings, value);
  return comment;
}

struct KeyComment {
  std::string_view key;
  std::string text;
};

/// The file with the comments above their keys in [instruments].
std::string with_comments(const std::string& toml, const std::vector<KeyComment>& comments) {
  std::istringstream lines(toml);
  std::string out, line;
  bool in_table = false;
  while (std::getline(lines, line)) {
    if (line.starts_with('[')) in_table = line == "[instruments]";
    if (in_table) {
      for (const auto& [key, text] : comments) {
        if (line.starts_with(std::string(key) + " = ")) out += "\n" + text;
      }
    }
    out += line + "\n";
  }
  return out;
}

}  // namespace

std::string why_unknown(const RecordedChannel& recorded) {
  const ChannelNoise& noise = recorded.noise;
  const std::string_view unit = recorded.unit;
  if (noise.to_reckon()) return "";
  if (noise.readings == 0) return "no readings at rest";
  if (noise.constant) return "constant: noise below the resolution";
  if (!noise.reading) return fmt::format("too few readings ({})", noise.readings);
  if (noise.reading->drifts)
    return fmt::format("the readings drift; they scatter by {:.3g} {} about their mean", noise.scatter, unit);
  return fmt::format("rounding hides it: below half of the resolution of {:.3g} {}", noise.resolution.value_or(0),
                     unit);
}

std::vector<FoundSetting> found_settings(const NoiseReport& report, const config::Settings& settings) {
  std::vector<FoundSetting> all;
  for (const NoiseChannel& row : noise_channels()) {
    const auto is_it = [&](const FoundSetting& found) { return found.key == row.setting; };
    if (row.setting.empty() || std::any_of(all.begin(), all.end(), is_it)) continue;
    all.push_back(found_setting(report, settings, row));
  }
  return all;
}

std::string noise_configuration(const NoiseReport& report, config::Settings settings) {
  const auto found = found_settings(report, settings);
  if (std::ranges::none_of(found, [](const auto& setting) { return setting.value.has_value(); })) return "";
  std::vector<KeyComment> comments;
  for (const FoundSetting& setting : found) comments.push_back({setting.key, apply(setting, settings)});
  comments.push_back({"imu_turn_on_bias_deg_s", turn_on_comment(report)});
  std::string head = fmt::format(
      "# The configuration of {} with the noise of its instruments at rest, found by\n"
      "# navcal noise. Keys of [instruments] without a comment are as they were.\n",
      base::printable(report.file));
  for (auto& port : settings.ports) {
    if (!port.path.empty() || !port.udev_name.empty() || !port.usb_serial.empty() || !port.address.empty())
      continue;
    port.path = "/dev/navcal/" + port.name;
    head +=
        fmt::format("# The recording does not say where {} is: replace the path of [port.{}] to use it live.\n",
                    port.name, port.name);
  }
  return head + "\n" + with_comments(config::to_toml(settings), comments);
}

}  // namespace navcal::analysis
