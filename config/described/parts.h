// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/described/table_reader.h"
#include "protocols/described/description.h"

// Parts of the reader of descriptions.
namespace navcal::config::described {

/// What frames take from the description where they do not state it themselves.
struct Defaults {
  bool is_text = false;
  protocols::described::ByteOrder byte_order = protocols::described::ByteOrder::little;
  char separator = ',', end = '\n', key_sign = '=';
};

/// Takes byte_order, and of a text separator, end and key_sign, where the table states them.
void take_defaults(TableReader& table, Defaults& defaults);

[[nodiscard]] protocols::described::Field read_field(const Node& node, const Defaults& defaults,
                                                     std::vector<Problem>& problems);
[[nodiscard]] protocols::described::FrameKind read_frame(const Node& node, Defaults defaults,
                                                         std::vector<Problem>& problems);

/// Contradictions within a frame: fields, length and checksum that overlap or do not fit, the same meaning twice,
/// axes that are missing. `fields` are the fields' tables, in the order of the frame's.
void check_frame(const protocols::described::FrameKind& kind, bool is_text, const Node& node,
                 const std::vector<const Node*>& fields, std::vector<Problem>& problems);

}  // namespace navcal::config::described
