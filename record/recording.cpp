// SPDX-License-Identifier: Apache-2.0
#include "record/recording.h"

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

}  // namespace

bool is_log(const std::filesystem::path& file) {
  return peek(*open_recording(file), kMcapMagic.size()) == kMcapMagic;
}

std::unique_ptr<Recording> Recording::open(const std::filesystem::path& file) {
  auto source = open_recording(file);
  constexpr std::string_view kCapture = "#capture";
  const std::string begin = peek(*source, kCapture.size());
  auto whole = std::make_unique<PeekedSource>(begin, std::move(source));
  if (begin == kMcapMagic) return std::make_unique<LogRecording>(std::move(whole), file.string(), LogUtc(file));
  if (begin == kCapture) return std::make_unique<CaptureRecording>(std::move(whole), file.string());
  throw BadRecording(
      file.string() +
      ": neither a capture (\"#capture 1\") nor a log (MCAP); \"navcal log import\" reads those of other systems");
}

}  // namespace navcal::record
