// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/process_metrics.h"

#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

namespace navcal::web {
namespace {

std::optional<double> cpu_s() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return std::nullopt;
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::optional<double> resident_bytes() {
  std::ifstream in("/proc/self/statm");
  double total = 0, resident = 0;
  if (!(in >> total >> resident)) return std::nullopt;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

std::optional<double> open_descriptors() {
  std::error_code error;
  const std::filesystem::directory_iterator begin("/proc/self/fd", error);
  if (error) return std::nullopt;
  // The iterator's own descriptor is not counted.
  return static_cast<double>(std::distance(begin, std::filesystem::directory_iterator())) - 1;
}

}  // namespace

void append_process(Exposition& out) {
  using enum Exposition::Type;
  out.single("process_cpu_seconds_total", counter, "CPU time of navcal-web.", cpu_s());
  out.single("process_resident_memory_bytes", gauge, "Memory of navcal-web.", resident_bytes());
  out.single("process_open_fds", gauge, "Descriptors that navcal-web has open.", open_descriptors());
}

}  // namespace navcal::web
