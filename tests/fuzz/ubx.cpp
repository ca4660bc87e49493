// SPDX-License-Identifier: Apache-2.0
// Any bytes from a u-blox receiver or to it.
#include "protocols/ubx.h"

#include "protocols/ubx_configuration.h"
#include "protocols/ubx_navigation.h"
#include "protocols/ubx_receiver.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::ubx_target {

void decode(const navcal::protocols::Frame& frame) {
  using namespace navcal::protocols;
  if (ubx::kind_of(frame) != ubx::Kind::ubx) return;
  if (const auto pvt = ubx::decode_nav_pvt(frame.bytes)) static_cast<void>(pvt->utc_ns());
  static_cast<void>(ubx::decode_nav_sat(frame.bytes));
  static_cast<void>(ubx::decode_nav_dop(frame.bytes));
  static_cast<void>(ubx::decode_hnr_pvt(frame.bytes));
  static_cast<void>(ubx::decode_attitude(frame.bytes));
  static_cast<void>(ubx::decode_nav_relposned(frame.bytes));
  static_cast<void>(ubx::decode_nav_timegps(frame.bytes));
  static_cast<void>(ubx::decode_acknowledgement(frame.bytes));
  static_cast<void>(ubx::decode_cfg_msg(frame.bytes));
  static_cast<void>(ubx::decode_cfg_valset(frame.bytes));
  static_cast<void>(ubx::decode_cfg_rate(frame.bytes));
  static_cast<void>(ubx::decode_mon_ver(frame.bytes));
  static_cast<void>(ubx::decode_tim_tp(frame.bytes));
}

NAVCAL_FUZZ(ubx) {
  using namespace navcal::protocols;
  navcal::fuzz::check_stream<ubx::PortScanner>({data, size}, decode);
  // Messages with a valid checksum and an arbitrary payload.
  if (size > 2 && size < ubx::kMaxPayload) {
    for (const ubx::MessageCode code : {ubx::kNavAtt, ubx::kNavRelPosNed, ubx::kHnrPvt, ubx::kHnrAtt, ubx::kNavPvt,
                                        ubx::kNavSat, ubx::kNavDop, ubx::kNavTimeGps, ubx::kAckAck, ubx::kCfgMsg,
                                        ubx::kCfgValset, ubx::kCfgRate, ubx::kMonVer, ubx::kTimTp}) {
      const auto frame = ubx::encode_frame(code, {data, size});
      decode({ubx::id_of(code), 0, frame});
    }
  }
  return 0;
}

}  // namespace navcal::fuzz::ubx_target
