// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <utility>

#include "config/complaints.h"
#include "config/described/description_file.h"
#include "config/option_lookup.h"
#include "config/options.h"
#include "config/reader.h"

namespace navcal::config {
namespace {

/// The entry of a key of the port, the last one where the command line says it again; nullptr: there is none.
const Entry* last_of(const std::vector<const Entry*>& entries, std::string_view key) {
  const Entry* last = nullptr;
  for (const Entry* entry : entries) {
    if (entry->keys.size() == 3 && entry->keys[2] == key) last = entry;
  }
  return last;
}

/// False when the value cannot be taken; take_port_entry() tells why.
bool holds(std::string_view key, PortSettings& port, const Entry* entry) {
  return entry == nullptr || !set(*find(port_options(), "", key), port, *entry);
}

/// Where a line of a description stands: in its file, or in the text within the configuration.
std::string place_of(const Problem& problem, const std::string& file) {
  const std::string key = problem.key.empty() ? "" : problem.key + ": ";
  return file.empty() ? fmt::format("line {}: {}{}", problem.line, key, problem.message)
                      : fmt::format("{}:{}: {}{}", file, problem.line, key, problem.message);
}

}  // namespace

void Reader::take_description(PortSettings& port, const std::vector<const Entry*>& entries) {
  const Entry* const device = last_of(entries, "device");
  const Entry* const description = last_of(entries, "description");
  const Entry* const adjust_entry = last_of(entries, "adjust");
  if (!holds("device", port, device) || !holds("description", port, description) ||
      !holds("adjust", port, adjust_entry))
    return;
  const Entry& at = description != nullptr ? *description : device != nullptr ? *device : *entries.front();
  if (device == nullptr && description == nullptr) {
    // A log that was made of a capture has none: nothing is found in the port's bytes.
    if (!folder_) return;
    problems_.push_back({at.line, at.name() + ".device", "missing; the file that describes the device"});
    return;
  }
  std::string file;
  if (description == nullptr) {
    if (!folder_)
      return complain(at, "the file is read together with a configuration file only; state description");
    const std::filesystem::path path = *folder_ / port.device;
    file = path.native();
    try {
      port.description = content_of(path);
    } catch (const Error& error) {
      return complain(at, error.problems().front());
    }
  }
  std::vector<Problem> problems;
  auto read = read_description(port.description, problems);
  for (const Problem& problem : problems) complain(at, place_of(problem, file));
  if (!problems.empty()) return;
  for (const std::string& adjustment : port.adjust) {
    if (auto wrong = adjust(read, adjustment)) complain(*adjust_entry, std::move(*wrong));
  }
  port.baud = read.baud.value_or(port.baud);
  port.rate_Hz = read.rate_Hz.value_or(port.rate_Hz);
  port.latency_s = read.latency_s.value_or(port.latency_s);
  port.latency_std_s = read.latency_std_s.value_or(port.latency_std_s);
  port.described = std::move(read);
}

}  // namespace navcal::config
