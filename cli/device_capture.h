// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "analysis/device_check.h"
#include "cli/decode_input.h"
#include "cli/decode_port.h"

namespace navcal::cli {

/// Bytes of one device: a file of them (`-` is standard input), or one port of a capture or log.
class DeviceCapture {
 public:
  /// `port` may be empty when the file is no recording, or one with a single port. Throws Failure.
  DeviceCapture(const std::string& file, const std::string& port);

  /// The next bytes, with their arrival where the file has it; empty at the end.
  analysis::TimedBytes next();
  void show(analysis::Progress& progress) const;

 private:
  std::unique_ptr<PortBytes> port_;
  std::unique_ptr<Input> input_;
};

}  // namespace navcal::cli
