// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::analysis::mavlink {

/// Name of a message and what its checksum is made of (common.xml, minimal.xml).
struct MessageInfo {
  std::uint32_t id;
  std::string_view name;
  std::uint8_t crc_extra;
};

inline constexpr std::array kMessages{MessageInfo{0, "HEARTBEAT", 50},
                                      MessageInfo{1, "SYS_STATUS", 124},
                                      MessageInfo{2, "SYSTEM_TIME", 137},
                                      MessageInfo{22, "PARAM_VALUE", 220},
                                      MessageInfo{24, "GPS_RAW_INT", 24},
                                      MessageInfo{26, "SCALED_IMU", 170},
                                      MessageInfo{27, "RAW_IMU", 144},
                                      MessageInfo{29, "SCALED_PRESSURE", 115},
                                      MessageInfo{30, "ATTITUDE", 39},
                                      MessageInfo{32, "LOCAL_POSITION_NED", 185},
                                      MessageInfo{33, "GLOBAL_POSITION_INT", 104},
                                      MessageInfo{36, "SERVO_OUTPUT_RAW", 222},
                                      MessageInfo{42, "MISSION_CURRENT", 28},
                                      MessageInfo{62, "NAV_CONTROLLER_OUTPUT", 183},
                                      MessageInfo{65, "RC_CHANNELS", 118},
                                      MessageInfo{74, "VFR_HUD", 20},
                                      MessageInfo{77, "COMMAND_ACK", 143},
                                      MessageInfo{116, "SCALED_IMU2", 76},
                                      MessageInfo{129, "SCALED_IMU3", 46},
                                      MessageInfo{137, "SCALED_PRESSURE2", 195},
                                      MessageInfo{143, "SCALED_PRESSURE3", 131},
                                      MessageInfo{147, "BATTERY_STATUS", 154},
                                      MessageInfo{253, "STATUSTEXT", 83}};

struct Frame {
  std::uint32_t id = 0;
  std::uint8_t system = 0;
  std::size_t length = 0;                ///< all of it
  std::string_view payload;              ///< version 2: without the zeros that the sender has left out
  const MessageInfo* message = nullptr;  ///< nullptr: unknown, and the checksum was not checked
};

enum class Verdict : std::uint8_t { frame, incomplete, no_frame };
struct Found {
  Verdict verdict = Verdict::no_frame;
  Frame frame;
};

/// The frame at the beginning of `bytes`.
[[nodiscard]] Found find_frame(std::string_view bytes);

/// CRC-16/MCRF4XX, as MAVLink uses it.
[[nodiscard]] std::uint16_t checksum(std::string_view bytes, std::uint8_t extra);

}  // namespace navcal::analysis::mavlink
