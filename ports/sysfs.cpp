// SPDX-License-Identifier: Apache-2.0
#include "ports/sysfs.h"

#include <fstream>

namespace navcal::ports {

SysfsTty::SysfsTty(std::string_view device, const std::filesystem::path& root)
    : device_(root / "class" / "tty" / std::filesystem::path(device).filename() / "device") {}

std::string SysfsTty::driver() const {
  std::error_code error;
  const auto link = std::filesystem::read_symlink(device_ / "driver", error);
  return error ? std::string{} : link.filename().string();
}

std::optional<int> SysfsTty::latency_timer_ms() const {
  std::ifstream file(device_ / "latency_timer");
  int value = 0;
  if (!(file >> value)) return std::nullopt;
  return value;
}

bool SysfsTty::set_latency_timer_ms(int value) const {
  // Opened for update, so that a missing timer is not created as a file.
  std::fstream file(device_ / "latency_timer", std::ios::in | std::ios::out);
  if (!file) return false;
  file << value << std::flush;
  return static_cast<bool>(file);
}

}  // namespace navcal::ports
