// SPDX-License-Identifier: Apache-2.0
#include "cli/decode_input.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/live/commands.h"
#include "record/log/mcap_format.h"

namespace navcal::cli {

PortBytes::PortBytes(const std::string& file, const std::string& port)
    : recording_(record::Recording::open(file)) {
  const auto& ports = recording_->settings().ports;
  std::string names;
  for (; port_ < ports.size(); ++port_) {
    if (ports[port_].name == port) return;
    names += (names.empty() ? "" : ", ") + ports[port_].name;
  }
  throw base::Failure(base::Exit::usage, fmt::format("{}: no port \"{}\"; its ports: {}", file, port, names));
}

protocols::Protocol PortBytes::protocol() const { return recording_->settings().ports[port_].protocol; }

protocols::Bytes PortBytes::next() {
  while (auto entry = recording_->next()) {
    auto* const read = std::get_if<record::RawRead>(&*entry);
    if (read == nullptr || read->port != port_ || read->direction != record::Direction::received) continue;
    bytes_ = std::move(read->bytes);
    arrival_ns_ = read->time_ns;
    if (!bytes_.empty()) return bytes_;
  }
  return {};
}

namespace {

[[noreturn]] void fail(const std::string& name, const char* what) {
  throw base::Failure(base::Exit::bad_input, name + ": " + what + ": " + std::system_category().message(errno));
}

}  // namespace

Input::Input(const std::string& file) : name_(file == "-" ? "standard input" : file), block_(kBlock) {
  descriptor_ = file == "-" ? STDIN_FILENO : ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail(name_, "cannot open");
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode)) {
    size_ = static_cast<std::uint64_t>(status.st_size);
  }
}

Input::~Input() {
  if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
}

protocols::Bytes Input::next() {
  while (true) {
    const ssize_t n = ::read(descriptor_, block_.data(), block_.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(name_, "cannot read");
    const protocols::Bytes bytes{block_.data(), static_cast<std::size_t>(n)};
    if (done_ == 0) refuse_recording(bytes);
    done_ += bytes.size();
    return bytes;
  }
}

/// Refuses a recording: otherwise its whole text would count as skipped bytes, without naming the mistake.
void Input::refuse_recording(protocols::Bytes first) const {
  const std::string_view text(reinterpret_cast<const char*>(first.data()), first.size());
  const bool capture = text.starts_with("#capture ");
  if (!capture && !text.starts_with(record::kMcapMagic)) return;
  throw base::Failure(base::Exit::bad_input,
                      fmt::format("{}: {}, not the bytes of one device: --port NAME decodes one of its ports, "
                                  "\"navcal log info\" lists them",
                                  name_, capture ? "a capture" : "a log"));
}

}  // namespace navcal::cli
