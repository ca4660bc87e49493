// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "analysis/decode_describe.h"
#include "analysis/decode_summary.h"
#include "protocols/frame.h"

namespace navcal::analysis {

/// Hands on the frames of a whole stream of the device that speaks `protocol`. `next` gives the bytes, piece by
/// piece, an empty piece at the end.
DecodeSummary decode_frames(protocols::Protocol protocol, const std::function<protocols::Bytes()>& next,
                            const std::function<void(const protocols::Frame&)>& on_frame);

/// What writes the fields of the frames of the device that speaks `protocol`.
[[nodiscard]] Describe description_of(protocols::Protocol protocol);

}  // namespace navcal::analysis
