// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::ports {

/// Entry of one tty under /sys/class/tty. `root` replaces /sys in tests.
class SysfsTty {
 public:
  /// `device`: "/dev/ttyUSB0" or "ttyUSB0".
  explicit SysfsTty(std::string_view device, const std::filesystem::path& root = "/sys");

  /// "ftdi_sio", "cdc_acm", "serial8250"; empty when the tty has no device behind it.
  [[nodiscard]] std::string driver() const;
  /// FTDI adapters hold back bytes for so long; nullopt for every other driver.
  [[nodiscard]] std::optional<int> latency_timer_ms() const;
  /// False when there is no such timer or no permission to set it.
  [[nodiscard]] bool set_latency_timer_ms(int value) const;

 private:
  std::filesystem::path device_;
};

}  // namespace navcal::ports
