// SPDX-License-Identifier: Apache-2.0
#include "record/export/log_tables.h"

#include <fmt/format.h>

#include <map>

#include "record/export/sensor_places.h"
#include "record/json/flat_json.h"
#include "record/log/log_reader.h"
#include "record/log/log_utc.h"
#include "record/recording.h"

namespace navcal::record {
namespace {

constexpr std::uint64_t kTablesProgressEvery = 1024;

}  // namespace

LogTables read_tables(const std::filesystem::path& log_file, const Progress& progress) {
  LogReader log(open_file(log_file), log_file.string());
  LogTables found;
  std::map<std::uint16_t, std::size_t> table_of;
  SensorPlaces places(log_file);
  LogUtc utc(log_file);
  std::uint64_t unreadable = 0;
  std::uint64_t messages = 0;
  while (const auto message = log.next()) {
    if (++messages % kTablesProgressEvery == 0) progress(log.progress());
    const LogChannel& channel = log.channels().at(message->channel);
    if (channel.raw) continue;
    if (channel.topic == "/config") {
      const auto json = FlatJson::parse(message->data);
      if (json && found.configuration.empty()) found.configuration = json->get("toml");
      continue;
    }
    const std::string_view json = utc.on_scale(*message, log);
    const auto [place, is_new] = table_of.try_emplace(message->channel, found.tables.size());
    if (is_new) found.tables.emplace_back(channel.topic);
    const auto arrival_ns = static_cast<std::int64_t>(message->log_time_ns) - log.log_offset_ns();
    const bool is_sensor = channel.topic == kSensorTopic;
    const std::string placed = is_sensor ? places.placed(json) : std::string{};
    if (!found.tables[place->second].append(is_sensor ? placed : json, utc.mapping().to_utc(arrival_ns)))
      ++unreadable;
  }
  std::erase_if(found.tables, [](const TopicTable& table) { return table.rows() == 0; });
  if (unreadable > 0) found.remarks.push_back(fmt::format("{} messages are not JSON: left out", unreadable));
  for (const auto& remark : log.remarks()) found.remarks.push_back(log.name() + ": " + remark);
  return found;
}

}  // namespace navcal::record
