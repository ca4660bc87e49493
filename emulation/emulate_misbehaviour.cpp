// SPDX-License-Identifier: Apache-2.0
#include "emulation/emulate_misbehaviour.h"

#include <algorithm>

#include "protocols/text_fields.h"

namespace navcal::emulation {
namespace {

std::optional<double> seconds(std::string_view text) {
  const auto value = protocols::signed_number(text);
  return value && *value >= 0 ? value : std::nullopt;
}

}  // namespace

std::optional<StallPlan> parse_stall(std::string_view text) {
  const auto at = text.find('@');
  if (at == std::string_view::npos) return std::nullopt;
  const auto duration = seconds(text.substr(0, at));
  const auto every = seconds(text.substr(at + 1));
  if (!duration || !every || *duration <= 0 || *every <= *duration) return std::nullopt;
  return StallPlan{*duration, *every};
}

std::optional<UnplugPlan> parse_unplug(std::string_view text) {
  const auto at = text.find('@');
  const auto plus = text.find('+', at == std::string_view::npos ? 0 : at);
  if (at == 0 || at == std::string_view::npos || plus == std::string_view::npos) return std::nullopt;
  const auto time = seconds(text.substr(at + 1, plus - at - 1));
  const auto duration = seconds(text.substr(plus + 1));
  if (!time || !duration) return std::nullopt;
  return UnplugPlan{std::string(text.substr(0, at)), *time, *duration};
}

std::size_t Misbehaviour::below(std::size_t n) {
  return std::min(static_cast<std::size_t>(random_.uniform(0, static_cast<double>(n))), n - 1);
}

std::vector<std::uint8_t> Misbehaviour::corrupt(std::vector<std::uint8_t> frame) {
  if (frame.empty() || (drop_ > 0 && random_.uniform(0, 1) < drop_)) return {};
  if (noise_ <= 0 || random_.uniform(0, 1) >= noise_) return frame;
  if (random_.uniform(0, 1) < 0.5) {
    frame[below(frame.size())] ^= static_cast<std::uint8_t>(1U << below(8));
    return frame;
  }
  std::vector<std::uint8_t> garbage(1 + below(8));
  for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>(below(256));
  frame.insert(frame.begin(), garbage.begin(), garbage.end());
  return frame;
}

}  // namespace navcal::emulation
