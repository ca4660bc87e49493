// SPDX-License-Identifier: Apache-2.0
#include "web/recorded_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

#include "record/log/log_reader.h"
#include "record/recording.h"

namespace navcal::web {
namespace {

constexpr std::size_t kProgressEvery = 4096;
/// The configuration is not shown, and has no place in time.
constexpr std::string_view kNotShown = "/config";

}  // namespace

RecordedLog::RecordedLog(const std::filesystem::path& file, const Progress& progress) {
  if (!record::is_log(file)) throw record::BadRecording(file.string() + ": it is no log (.mcap)");
  read(file, progress);
  if (entries_.empty()) throw record::BadRecording(file.string() + ": the log has no messages to show");
  // Two ports may hand over in the other order than their bytes came.
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.time_ns < b.time_ns; });
  file_ = base::Descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
}

void RecordedLog::read(const std::filesystem::path& file, const Progress& progress) {
  record::LogReader reader(record::open_file(file), file.string());
  std::map<std::uint16_t, std::uint16_t> topic_of_channel;
  std::size_t count = 0;
  while (const auto message = reader.next()) {
    if (++count % kProgressEvery == 0 && progress) progress(reader.progress());
    const auto& channel = reader.channels().at(message->channel);
    if (channel.raw || channel.topic == kNotShown) continue;
    auto known = topic_of_channel.find(message->channel);
    if (known == topic_of_channel.end()) {
      known = topic_of_channel.emplace(message->channel, static_cast<std::uint16_t>(topics_.size())).first;
      topics_.push_back(channel.topic);
    }
    entries_.push_back({static_cast<std::int64_t>(message->log_time_ns),
                        message->offset + record::kRecordHead + record::kMessageHead,
                        static_cast<std::uint32_t>(message->data.size()), known->second});
  }
  remarks_ = reader.remarks();
}

std::string_view RecordedLog::text(const Entry& entry) {
  text_.resize(entry.length);
  const ssize_t n = ::pread(file_.get(), text_.data(), entry.length, static_cast<off_t>(entry.offset));
  return n == static_cast<ssize_t>(entry.length) ? std::string_view(text_) : std::string_view();
}

}  // namespace navcal::web
