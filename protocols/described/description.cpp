// SPDX-License-Identifier: Apache-2.0
#include "protocols/described/description.h"

#include <algorithm>
#include <array>

namespace navcal::protocols::described {
namespace {

struct TypeInfo {
  std::string_view name{};
  std::size_t size = 0;
};

/// In the order of Type.
constexpr auto kTypes = std::to_array<TypeInfo>({{"u8", 1},
                                                 {"i8", 1},
                                                 {"u16", 2},
                                                 {"i16", 2},
                                                 {"u24", 3},
                                                 {"i24", 3},
                                                 {"u32", 4},
                                                 {"i32", 4},
                                                 {"f32", 4},
                                                 {"f64", 8},
                                                 {"decimal", 0},
                                                 {"hex", 0},
                                                 {"degrees-minutes", 0},
                                                 {"nmea", 0}});

/// Bytes that a place needs: from the front up to its end, or from the back.
std::size_t reach(int place, std::size_t size) {
  return place < 0 ? static_cast<std::size_t>(-place) : static_cast<std::size_t>(place) + size;
}

}  // namespace

std::string_view name_of(Type type) { return kTypes.at(static_cast<std::size_t>(type)).name; }

std::optional<Type> type_named(std::string_view name) {
  for (std::size_t i = 0; i < kTypes.size(); ++i) {
    if (kTypes[i].name == name) return static_cast<Type>(i);
  }
  return std::nullopt;
}

std::size_t size_of(Type type) { return kTypes.at(static_cast<std::size_t>(type)).size; }

bool has(const Description& description, Meaning meaning) {
  return std::any_of(description.kinds.begin(), description.kinds.end(), [&](const FrameKind& kind) {
    return std::any_of(kind.fields.begin(), kind.fields.end(),
                       [&](const Field& field) { return field.meaning == meaning; });
  });
}

std::size_t least_length(const FrameKind& kind) {
  if (kind.length.fixed != 0) return kind.length.fixed;
  std::size_t least = std::max(kind.start.size(), kind.length.at + size_of(kind.length.type));
  for (const Constant& constant : kind.constants) least = std::max(least, constant.at + constant.bytes.size());
  const Checksum& checksum = kind.checksum;
  if (checksum.sum == Sum::none) return least;
  if (checksum.at < 0) least += static_cast<std::size_t>(-checksum.at);  // behind all that
  least = std::max(least, reach(checksum.at, size_of(checksum.sum)));
  least = std::max(least, reach(checksum.to, 0));
  if (checksum.from < 0) return std::max(least, reach(checksum.from, 0));
  // A byte at least is covered before the end, which may be counted from the back.
  const std::size_t behind = checksum.to < 0 ? static_cast<std::size_t>(-checksum.to) : 0;
  return std::max(least, static_cast<std::size_t>(checksum.from) + 1 + behind);
}

}  // namespace navcal::protocols::described
