// SPDX-License-Identifier: Apache-2.0
#include "analysis/device_guess.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/device_check.h"
#include "analysis/device_guess_parts.h"
#include "base/failure.h"

namespace navcal::analysis {
namespace {

using protocols::described::ByteOrder;
using protocols::described::Checksum;

/// More would take long and show nothing new.
constexpr std::size_t kMostBytes = std::size_t{2} << 20;
/// Shares of a capture that make it a text, and that make a guess worth writing.
constexpr double kTextShare = 0.95, kLeastCoverage = 0.3;

bool is_text(protocols::Bytes capture) {
  const auto printable = std::count_if(capture.begin(), capture.end(), [](std::uint8_t byte) {
    return (byte >= ' ' && byte < 0x7F) || byte == '\t' || byte == '\r' || byte == '\n';
  });
  const auto ends = std::count(capture.begin(), capture.end(), std::uint8_t{'\n'});
  return static_cast<double>(printable) > kTextShare * static_cast<double>(capture.size()) && ends >= 3;
}

std::string rate_line(std::size_t frames, std::optional<double> seconds) {
  if (!seconds || *seconds <= 0 || frames < 3)
    return "# rate_Hz = 10  # frames a second; 0 or nothing: not periodic\n";
  return fmt::format("rate_Hz = {:.3g}  # {} frames in {:.1f} s\n", static_cast<double>(frames - 1) / *seconds,
                     frames, *seconds);
}

std::string head(std::string_view form, std::string_view rate) {
  return fmt::format(
      "# Begun from a capture by `navcal devices new`. What is left to do: meaning and unit of the fields, with "
      "the help\n"
      "# of the device's manual, and line speed and latency. docs/devices.md has all keys, and\n"
      "# `navcal devices check THIS_FILE CAPTURE` shows what the description finds.\n"
      "name = \"unknown device\"\nform = \"{}\"\n# baud = 9600\n{}"
      "# latency_ms = 0      # from the measurement to the first byte on the wire\n# latency_std_ms = 10\n",
      form, rate);
}

std::string length_line(const protocols::described::Length& length) {
  if (length.fixed != 0) return fmt::format("length = {}\n", length.fixed);
  return fmt::format("length = {{ at = {}, type = \"{}\", byte_order = \"{}\", add = {} }}\n", length.at,
                     name_of(length.type), length.byte_order == ByteOrder::big ? "big" : "little", length.add);
}

std::string checksum_line(const std::optional<Checksum>& checksum) {
  if (!checksum) return "checksum = \"none\"  # none of those with a name fits, at any place near the end\n";
  return fmt::format("checksum = {{ kind = \"{}\", from = {}, at = {}, byte_order = \"{}\" }}\n",
                     name_of(checksum->sum), checksum->from, checksum->at,
                     checksum->byte_order == ByteOrder::big ? "big" : "little");
}

/// The likeliest framing, and its checksum: of those that fit about as well, the one that has a checksum.
std::string binary_description(protocols::Bytes capture, std::optional<double> seconds) {
  const auto framings = find_framings(capture);
  if (framings.empty() || framings.front().coverage < kLeastCoverage)
    throw base::Failure(base::Exit::bad_input,
                        "no pair of bytes comes back at one distance, or at one that a number behind it states: "
                        "is the line speed right, and is the capture long enough?");
  constexpr double kAboutAsWell = 0.9;
  const Framing* chosen = &framings.front();
  std::optional<Checksum> checksum;
  for (const Framing& framing : framings) {
    if (framing.coverage < kAboutAsWell * framings.front().coverage) continue;
    checksum = find_checksum(framing);
    if (!checksum) continue;
    chosen = &framing;
    break;
  }
  return head("binary", rate_line(chosen->frames.size(), seconds)) +
         fmt::format("\n[[frame]]  # {} frames, {:.1f} % of the bytes\nid = \"FRAME\"\nsync = \"{}\"\n",
                     chosen->frames.size(), 100 * chosen->coverage, hex_of(chosen->sync)) +
         length_line(chosen->length) + checksum_line(checksum) +
         "# Give each a meaning and a unit, such as meaning = \"rate.x\", unit = \"deg/s\", scale = 0.01; take "
         "out what is none.\n"
         "field = [\n" +
         field_lines(*chosen, checksum) + "]\n";
}

std::string text_description(protocols::Bytes capture, std::optional<double> seconds) {
  char separator = ',';
  const std::string frames = text_frames(capture, separator);
  if (frames.empty()) throw base::Failure(base::Exit::bad_input, "no kind of line comes back three times");
  const auto lines = static_cast<std::size_t>(std::count(capture.begin(), capture.end(), std::uint8_t{'\n'}));
  const std::string separator_line = separator == ',' ? "" : fmt::format("separator = \"{}\"\n", separator);
  return head("text", rate_line(lines, seconds)) + separator_line + frames;
}

}  // namespace

std::string guess_description(protocols::Bytes capture, std::optional<double> seconds) {
  if (capture.empty()) throw base::Failure(base::Exit::bad_input, "the capture is empty");
  const protocols::Bytes looked_at = capture.first(std::min(capture.size(), kMostBytes));
  // The duration is that of the whole capture.
  if (seconds) *seconds *= static_cast<double>(looked_at.size()) / static_cast<double>(capture.size());
  return is_text(looked_at) ? text_description(looked_at, seconds) : binary_description(looked_at, seconds);
}

}  // namespace navcal::analysis
