// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "record/content_hash.h"
#include "record/export/export.h"
#include "record/export/sensor_places.h"
#include "record/export/topic_columns.h"
#include "record/json/flat_json.h"
#include "record/json/json_object.h"
#include "record/log/checksum.h"
#include "record/log/log_utc.h"
#include "record/recording.h"
#include "record/whole_file.h"

namespace navcal::record {
namespace {

constexpr std::uint64_t kCsvProgressEvery = 1024;
constexpr std::size_t kFlushBytes = 64 << 10;

/// Quoted where it must be (RFC 4180).
void append_csv_text(std::string& out, std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

/// One file of the export.
struct Output {
  Output(const std::filesystem::path& path, const Topic* topic) : file(path) {
    if (topic != nullptr) columns = topic_columns(*topic);
  }
  void append_header() {
    for (const TopicColumn& column : columns)
      text.append(&column == &columns.front() ? "" : ",").append(column.title);
    text += '\n';
  }

  /// The line of one message; a member that is absent or null is empty. False when it is not JSON.
  [[nodiscard]] bool append_line(std::string_view json) {
    const auto members = FlatJson::parse(json);
    if (!members) return false;
    for (const TopicColumn& column : columns) {
      if (&column != &columns.front()) text += ',';
      append_csv_text(text, members->get(column.member));
    }
    text += '\n';
    return true;
  }

  void flush_if(std::size_t at_least) {
    if (text.size() < at_least) return;
    file.write(text);
    text.clear();
  }
  WholeFile file;
  std::vector<TopicColumn> columns;  ///< none: raw bytes, or JSON as a whole
  std::string text;
};

void append_raw_line(std::string& out, std::string_view data, const pipeline::UtcMapping& mapping) {
  const auto at = read_le<std::int64_t>(data, 1);
  append_seconds(out, mapping.to_utc(at));
  out += ',';
  append_seconds(out, at);
  out += data.front() == 0 ? ",<," : ",>,";
  const std::string_view bytes = data.substr(kRawHead, data.size() - kRawHead - kRawTail);
  append_hexadecimal(out, {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
  out += '\n';
}

class Exporter {
 public:
  Exporter(LogReader& log, const std::filesystem::path& log_file, std::filesystem::path folder)
      : log_(log), folder_(std::move(folder)), places_(log_file), utc_(log_file) {}

  void take(const LogMessage& message) {
    const LogChannel& channel = log_.channels().at(message.channel);
    if (channel.topic == "/config") {
      take_configuration(message.data);
      return;
    }
    Output& output = output_of(message.channel, channel);
    if (channel.raw) {
      append_raw_line(output.text, message.data, utc_.mapping());
      return output.flush_if(kFlushBytes);
    }
    const std::string_view data = utc_.on_scale(message, log_);
    if (!output.columns.empty()) {
      const bool is_sensor = channel.topic == kSensorTopic;
      const std::string placed = is_sensor ? places_.placed(data) : std::string{};
      if (!output.append_line(is_sensor ? placed : data)) ++unreadable_;
    } else {
      append_seconds(output.text,
                     utc_.mapping().to_utc(static_cast<std::int64_t>(message.log_time_ns) - log_.log_offset_ns()));
      output.text += ',';
      append_csv_text(output.text, std::string(data.substr(0, data.size() - kJsonTail)) + '}');
      output.text += '\n';
    }
    output.flush_if(kFlushBytes);
  }

  Exported commit() {
    Exported exported;
    for (auto& [channel, output] : outputs_) {
      output->flush_if(1);
    }
    for (auto& [channel, output] : outputs_) {
      output->file.commit();
      exported.files.push_back(output->file.path());
    }
    if (unreadable_ > 0)
      exported.remarks.push_back(fmt::format("{} messages are not JSON: left out", unreadable_));
    return exported;
  }

 private:
  static constexpr std::uint16_t kConfigurationFile = 0;  // no channel of a log has this number

  void take_configuration(std::string_view data) {
    const auto json = FlatJson::parse(data);
    if (!json || outputs_.contains(kConfigurationFile)) return;
    auto& output = outputs_[kConfigurationFile];
    output = std::make_unique<Output>(folder_ / "config.toml", nullptr);
    output->text = json->get("toml");
  }

  Output& output_of(std::uint16_t id, const LogChannel& channel) {
    auto& output = outputs_[id];
    if (output) return *output;
    const Topic* const topic = listed_topic(channel.topic);
    output = std::make_unique<Output>(folder_ / (table_name(channel.topic) + ".csv"), topic);
    if (topic != nullptr) {
      output->append_header();
    } else {
      output->text = channel.raw ? "time_s,monotonic_s,direction,bytes_hex\n" : "time_s,json\n";
    }
    return *output;
  }

  LogReader& log_;
  std::filesystem::path folder_;
  std::map<std::uint16_t, std::unique_ptr<Output>> outputs_;
  SensorPlaces places_;
  LogUtc utc_;
  std::uint64_t unreadable_ = 0;
};

}  // namespace

Exported export_csv(const std::filesystem::path& log_file, const std::filesystem::path& folder,
                    const Progress& progress) {
  LogReader log(open_file(log_file), log_file.string());
  std::filesystem::create_directories(folder);
  Exporter exporter(log, log_file, folder);
  std::uint64_t messages = 0;
  while (const auto message = log.next()) {
    exporter.take(*message);
    if (++messages % kCsvProgressEvery == 0) progress(log.progress());
  }
  Exported exported = exporter.commit();
  for (const auto& remark : log.remarks()) exported.remarks.push_back(log.name() + ": " + remark);
  return exported;
}

}  // namespace navcal::record
