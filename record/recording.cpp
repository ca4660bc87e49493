// SPDX-License-Identifier: Apache-2.0
#include "record/recording.h"

#include <fmt/format.h>

#include <deque>

#include "config/csv_map.h"
#include "protocols/text_fields.h"
#include "record/capture/capture_recording.h"
#include "record/log/log_recording.h"
#include "record/log/mcap_format.h"

namespace navcal::record {
namespace {

/// A source whose first bytes were looked at already.
class PeekedSource final : public ByteSource {
 public:
  PeekedSource(std::string peeked, std::unique_ptr<ByteSource> rest)
      : peeked_(std::move(peeked)), rest_(std::move(rest)) {}
  std::size_t read(char* to, std::size_t n) override {
    if (given_ == peeked_.size()) return rest_->read(to, n);
    const std::size_t taken = peeked_.copy(to, n, given_);
    given_ += taken;
    return taken;
  }
  [[nodiscard]] std::uint64_t size() const override { return rest_->size(); }

 private:
  std::string peeked_;
  std::size_t given_ = 0;
  std::unique_ptr<ByteSource> rest_;
};

std::string peek(ByteSource& source, std::size_t n) {
  std::string begin(n, '\0');
  std::size_t length = 0;
  while (length < n) {
    const std::size_t got = source.read(begin.data() + length, n - length);
    if (got == 0) break;
    length += got;
  }
  begin.resize(length);
  return begin;
}

/// Throws BadRecording when there is nothing to read.
std::unique_ptr<ByteSource> open_recording(const std::filesystem::path& file) {
  try {
    auto source = open_file(file);
    if (source->size() == 0) throw BadRecording(file.string() + ": the file is empty");
    return source;
  } catch (const std::system_error& error) {
    throw BadRecording(error.what());
  }
}

class CutRecording final : public Recording {
 public:
  CutRecording(std::unique_ptr<Recording> whole, const TimeWindow& window, std::string name)
      : whole_(std::move(whole)), window_(window), name_(std::move(name)) {}
  [[nodiscard]] const config::Settings& settings() const override { return whole_->settings(); }
  [[nodiscard]] const std::vector<std::string>& remarks() const override { return whole_->remarks(); }
  [[nodiscard]] double progress() const override { return whole_->progress(); }
  std::optional<Entry> next() override {
    while (ready_.empty()) {
      auto entry = whole_->next();
      if (!entry && !is_inside_)
        throw NothingInWindow(
            base::Exit::usage,
            fmt::format("{}: --from and --to leave nothing of the recording, which is {:.1f} s long", name_,
                        static_cast<double>(newest_ns_ - start_ns_.value_or(newest_ns_)) * 1e-9));
      if (!entry) return std::nullopt;
      if (const auto* change = std::get_if<MappingChange>(&*entry)) utc_offset_ns_ = change->mapping.offset_ns;
      const auto* raw = std::get_if<RawRead>(&*entry);
      if (raw != nullptr) {
        if (!start_ns_) start_ns_ = raw->time_ns;
        newest_ns_ = raw->time_ns;
        if (window_.from && is_before(raw->time_ns, *window_.from)) continue;
        if (window_.to && !is_before(raw->time_ns, *window_.to)) {
          if (is_inside_) return std::nullopt;
          continue;
        }
        for (Entry& before : held_) {
          std::visit([&](auto& one) { one.time_ns = raw->time_ns; }, before);
          ready_.push_back(std::move(before));
        }
        held_.clear();
        is_inside_ = true;
      }
      (is_inside_ ? ready_ : held_).push_back(std::move(*entry));
    }
    Entry first = std::move(ready_.front());
    ready_.pop_front();
    return first;
  }

 private:
  [[nodiscard]] bool is_before(std::int64_t time_ns, const TimeBound& bound) const {
    if (bound.utc_ns) return time_ns + utc_offset_ns_ < *bound.utc_ns;
    return static_cast<double>(time_ns - *start_ns_) * 1e-9 < bound.since_start_s;
  }

  std::unique_ptr<Recording> whole_;
  TimeWindow window_;
  std::deque<Entry> ready_, held_;
  std::optional<std::int64_t> start_ns_;
  std::int64_t utc_offset_ns_ = 0;
  bool is_inside_ = false;
  std::string name_;
  std::int64_t newest_ns_ = 0;
};

std::unique_ptr<Recording> open_whole(const std::filesystem::path& file) {
  auto source = open_recording(file);
  constexpr std::string_view kCapture = "#capture";
  const std::string begin = peek(*source, kCapture.size());
  auto whole = std::make_unique<PeekedSource>(begin, std::move(source));
  if (begin == kMcapMagic) return std::make_unique<LogRecording>(std::move(whole), file.string(), LogUtc(file));
  if (begin == kCapture) return std::make_unique<CaptureRecording>(std::move(whole), file.string());
  throw BadRecording(
      file.string() +
      ": neither a capture (\"#capture 1\") nor a log (MCAP); \"navcal log import\" reads those of other systems "
      "that it knows by their content, and with --driver NAME (navcal log import --help) a device's bytes");
}

}  // namespace

std::optional<TimeBound> parse_time_bound(const std::string& text) {
  if (const auto utc_ns = config::parse_iso_time(text)) return TimeBound{0, utc_ns};
  const auto seconds = protocols::signed_number(text);
  return seconds && *seconds >= 0 ? std::optional(TimeBound{*seconds, {}}) : std::nullopt;
}

bool is_log(const std::filesystem::path& file) {
  return peek(*open_recording(file), kMcapMagic.size()) == kMcapMagic;
}

std::unique_ptr<Recording> Recording::open(const std::filesystem::path& file, const TimeWindow& window) {
  auto whole = open_whole(file);
  if (!window.from && !window.to) return whole;
  return std::make_unique<CutRecording>(std::move(whole), window, file.string());
}

}  // namespace navcal::record
