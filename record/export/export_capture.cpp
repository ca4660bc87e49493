// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <optional>

#include "record/capture/capture_writer.h"
#include "record/export/export.h"
#include "record/json/flat_json.h"
#include "record/recording.h"
#include "record/whole_file.h"

namespace navcal::record {
namespace {

constexpr std::uint64_t kCaptureProgressEvery = 1024;

/// An operator's mark; what the daemon says of itself belongs to the log alone.
void append_mark(std::string& text, const LoggedEvent& event) {
  const auto json = FlatJson::parse(event.json);
  if (json && json->get("name") == "mark")
    CaptureWriter::comment(text, fmt::format("event {}", json->get("message")));
}

}  // namespace

Exported export_capture(const std::filesystem::path& recording_file, const std::filesystem::path& capture,
                        const Progress& progress) {
  const auto recording = Recording::open(recording_file);
  std::optional<WholeFile> file;
  if (capture != "-") file.emplace(capture);
  const auto write = [&file](std::string& lines) {
    if (file) {
      file->write(lines);
    } else if (std::fwrite(lines.data(), 1, lines.size(), stdout) != lines.size() || std::fflush(stdout) != 0) {
      throw std::system_error(errno, std::system_category(), "standard output");
    }
    lines.clear();
  };
  CaptureWriter writer(recording->settings().ports);
  std::string text;
  writer.begin(text);
  pipeline::UtcMapping mapping;
  std::uint64_t unmapped = 0;
  std::uint64_t entries = 0;
  while (const auto entry = recording->next()) {
    if (const auto* change = std::get_if<MappingChange>(&*entry)) mapping = change->mapping;
    if (const auto* read = std::get_if<RawRead>(&*entry)) {
      if (mapping.source == pipeline::UtcMapping::Source::none) ++unmapped;
      writer.bytes(text, read->port, read->direction, mapping.to_utc(read->time_ns), read->bytes);
    }
    if (const auto* event = std::get_if<LoggedEvent>(&*entry)) append_mark(text, *event);
    if (++entries % kCaptureProgressEvery == 0) {
      progress(recording->progress());
      write(text);
    }
  }
  write(text);
  Exported exported{{}, recording->remarks()};
  if (file) {
    file->commit();
    exported.files.push_back(capture);
  }
  if (writer.raised() > 0) {
    exported.remarks.push_back(fmt::format(
        "UTC was corrected backwards: {} times were raised to that of the line before", writer.raised()));
  }
  if (unmapped > 0) {
    exported.remarks.push_back(fmt::format("{} times are monotonic: UTC was not known", unmapped));
  }
  return exported;
}

}  // namespace navcal::record
