// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_command.h"

#include <algorithm>

#include "protocols/checked_line.h"
#include "protocols/oncore_aid.h"
#include "protocols/oncore_encode.h"

namespace navcal::protocols::oncore {
namespace {

constexpr std::array kWithRate{kHa, kHb, kEa, kBa, kBb, kBo, kHn, kEq};
constexpr std::array kWithoutRate{kCf, kCj, kGj};

FrameId id_of(const std::uint8_t* frame) {
  const char letters[2] = {static_cast<char>(frame[2]), static_cast<char>(frame[3])};
  return FrameId(std::string_view(letters, 2));
}

template <class List>
bool contains(const List& list, FrameId id) {
  return std::find(list.begin(), list.end(), id) != list.end();
}

std::size_t command_length(FrameId id) {
  if (contains(kWithRate, id)) return 8;
  if (id == kGa) return kGaLength;
  if (id == kGb) return kGbLength;
  return contains(kWithoutRate, id) ? 7 : 0;
}

}  // namespace

std::vector<std::uint8_t> encode_poll(FrameId id, std::uint8_t rate) {
  return contains(kWithoutRate, id) ? encode_frame(id, {}) : encode_frame(id, Bytes(&rate, 1));
}

Scan CommandScanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available >= 2 && first[1] != '@') return Scan::not_a_frame();
  if (available < 4) return Scan::incomplete(7 - available);
  const FrameId id = id_of(first);
  const std::size_t length = command_length(id);
  if (length == 0) return Scan::not_a_frame();
  if (available < length) return Scan::incomplete(length - available);
  const bool intact = xor_of(Bytes(first + 2, length - 5)) == first[length - 3] && first[length - 2] == '\r' &&
                      first[length - 1] == '\n';
  return intact ? Scan::frame(length, id) : Scan::bad_checksum();
}

std::optional<Command> parse_command(Bytes frame) {
  const Scan found = CommandScanner::scan(frame.data(), frame.data() + frame.size());
  if (found.kind != Scan::Kind::frame || found.length != frame.size() || frame[0] != '@') return std::nullopt;
  if (contains(kWithoutRate, found.id)) return Command{found.id, std::nullopt};
  if (!contains(kWithRate, found.id)) return std::nullopt;
  return Command{found.id, frame[4]};
}

}  // namespace navcal::protocols::oncore
