#include "record/capture_recording.h"

namespace navcal::record {

CaptureRecording::CaptureRecording(std::unique_ptr<ByteSource> source, std::string name)
    : reader_(std::move(source), std::move(name)) {
  settings_.ports = reader_.ports();
}

std::optional<Entry> CaptureRecording::next() {
  if (!mapping_told_) {
    mapping_told_ = true;
    RawRead read;
    if (reader_.next(read)) first_ = std::move(read);
    const std::int64_t at = first_ ? first_->time_ns : 0;
    return MappingChange{at, {pipeline::UtcMapping::Source::file, 0, 0, at}};
  }
  if (first_) {
    Entry entry = std::move(*first_);
    first_.reset();
    return entry;
  }
  RawRead read;
  if (!reader_.next(read)) return std::nullopt;
  return read;
}

}  // namespace navcal::record
