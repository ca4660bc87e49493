// SPDX-License-Identifier: Apache-2.0
#include "instruments/oncore_aid.h"

#include "base/durations.h"
#include "protocols/oncore.h"
#include "protocols/oncore_position.h"

namespace navcal::instruments {
namespace {

namespace oncore = protocols::oncore;

/// After such a pause of its positions a receiver may have lost its power.
constexpr std::int64_t kOncorePause_ns = 3 * base::kSecond_ns;

}  // namespace

void OncoreAid::begin() {
  wanted_ = decided_ = false;
  newest_ns_.reset();
}

void OncoreAid::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (frame.id != oncore::kHa) return;
  const auto position = oncore::decode_position(frame.bytes);
  if (!position) return;
  if (newest_ns_ && now_ns - *newest_ns_ >= kOncorePause_ns) begin();
  newest_ns_ = now_ns;
  const bool fixed = position->fix == protocols::Fix::fix_2d || position->fix == protocols::Fix::fix_3d;
  if (fixed) {
    decided_ = true;
    wanted_ = false;
  } else if (!decided_) {
    wanted_ = position->no_almanac;
  }
}

std::vector<std::vector<std::uint8_t>> OncoreAid::give(const ReceiverAid& aid) {
  decided_ = true;
  wanted_ = false;
  return {oncore::encode_aid_time(aid.utc_ns), oncore::encode_aid_position(aid.position)};
}

}  // namespace navcal::instruments
