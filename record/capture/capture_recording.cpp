// SPDX-License-Identifier: Apache-2.0
#include "record/capture/capture_recording.h"

#include "record/json/json_object.h"

namespace navcal::record {
namespace {

/// A mark as an operator sets one (docs/log-format.md).
LoggedEvent mark(std::int64_t time_ns, const std::string& text) {
  LoggedEvent event{time_ns, {}};
  JsonObject json(event.json, "EVENT");
  json.seconds("time", time_ns);
  json.seconds("monotonic", time_ns);
  json.text("severity", "info");
  json.text("name", "mark");
  json.text("port", "");
  json.text("message", text);
  return event;
}

}  // namespace

CaptureRecording::CaptureRecording(std::unique_ptr<ByteSource> source, std::string name)
    : reader_(std::move(source), std::move(name)) {
  settings_.ports = reader_.ports();
  // It does not say where its field is from: simulated recordings may be of a field that belongs to no real place.
  settings_.environment.model = false;
}

std::optional<Entry> CaptureRecording::next() {
  if (!mapping_told_) return begin();
  if (marks_.empty() && first_) {
    Entry entry = std::move(*first_);
    first_.reset();
    queue_marks(newest_ns_);
    return entry;
  }
  if (!marks_.empty()) {
    Entry entry = std::move(marks_.front());
    marks_.pop_front();
    return entry;
  }
  RawRead read;
  if (!reader_.next(read)) return std::nullopt;
  newest_ns_ = read.time_ns;
  queue_marks(newest_ns_);
  return read;
}

/// The mapping begins with the first read, and so do marks at the head of the file.
Entry CaptureRecording::begin() {
  mapping_told_ = true;
  const auto at_head = reader_.take_events();
  RawRead read;
  if (reader_.next(read)) {
    newest_ns_ = read.time_ns;
    first_ = std::move(read);
  }
  for (const std::string& text : at_head) marks_.push_back(mark(newest_ns_, text));
  return MappingChange{newest_ns_, {pipeline::UtcMapping::Source::file, 0, 0, newest_ns_}};
}

void CaptureRecording::queue_marks(std::int64_t time_ns) {
  for (const std::string& text : reader_.take_events()) marks_.push_back(mark(time_ns, text));
}

}  // namespace navcal::record
