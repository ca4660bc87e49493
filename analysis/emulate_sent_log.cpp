// SPDX-License-Identifier: Apache-2.0
#include "analysis/emulate_sent_log.h"

#include "analysis/failure.h"

namespace navcal::analysis {

SentLog::SentLog(const std::filesystem::path& file, const std::vector<config::PortSettings>& ports)
    : writer_(ports), file_(file) {
  if (!file_) throw Failure(Exit::failed, file.string() + ": cannot be written");
  writer_.begin(line_);
  file_ << line_ << std::flush;
}

void SentLog::comment(std::string_view text) {
  line_.clear();
  record::CaptureWriter::comment(line_, text);
  file_ << line_ << std::flush;
}

void SentLog::add(std::uint16_t port, record::Direction direction, std::int64_t utc_ns, protocols::Bytes bytes) {
  line_.clear();
  writer_.bytes(line_, port, direction, utc_ns, bytes);
  // Flushed line by line: whoever compares may look while we run.
  file_ << line_ << std::flush;
}

}  // namespace navcal::analysis
