// SPDX-License-Identifier: Apache-2.0
#include "cli/device_capture.h"

#include <array>
#include <fstream>
#include <string_view>

#include "analysis/failure.h"
#include "record/log/mcap_format.h"

namespace navcal::cli {
namespace {

bool is_recording(const std::string& file) {
  std::array<char, 16> begin{};
  std::ifstream in(file, std::ios::binary);
  in.read(begin.data(), begin.size());
  const std::string_view text(begin.data(), static_cast<std::size_t>(in.gcount()));
  return text.starts_with("#capture ") || text.starts_with(record::kMcapMagic);
}

/// The name of the only port of a recording.
std::string only_port(const std::string& file) {
  std::string names;
  const auto recording = record::Recording::open(file);
  const auto& ports = recording->settings().ports;
  if (ports.size() == 1) return ports.front().name;
  for (const auto& port : ports) names += (names.empty() ? "" : ", ") + port.name;
  throw analysis::Failure(analysis::Exit::usage, file + ": --port NAME says which of its ports: " + names);
}

}  // namespace

DeviceCapture::DeviceCapture(const std::string& file, const std::string& port) {
  if (!port.empty() || (file != "-" && is_recording(file))) {
    port_ = std::make_unique<PortBytes>(file, port.empty() ? only_port(file) : port);
  } else {
    input_ = std::make_unique<Input>(file);
  }
}

analysis::TimedBytes DeviceCapture::next() {
  if (!port_) return {input_->next(), std::nullopt};
  const protocols::Bytes bytes = port_->next();
  return {bytes, port_->arrival_ns()};
}

void DeviceCapture::show(analysis::Progress& progress) const {
  if (port_) {
    port_->show(progress);
  } else {
    input_->show(progress);
  }
}

}  // namespace navcal::cli
