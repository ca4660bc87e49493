// SPDX-License-Identifier: Apache-2.0
#include "protocols/mavlink.h"

#include "protocols/crc16.h"

namespace navcal::protocols::mavlink {
namespace {

/// Name, number, CRC_EXTRA and length of each message, in the order of the numbers.
constexpr std::string_view kMessageText =
    "HEARTBEAT:0:50:9 SYS_STATUS:1:124:43 SYSTEM_TIME:2:137:12 PING:4:237:14 SET_MODE:11:89:6 "
    "PARAM_REQUEST_READ:20:214:20 PARAM_REQUEST_LIST:21:159:2 PARAM_VALUE:22:220:25 PARAM_SET:23:168:23 "
    "GPS_RAW_INT:24:24:52 SCALED_IMU:26:170:24 RAW_IMU:27:144:29 SCALED_PRESSURE:29:115:16 ATTITUDE:30:39:28 "
    "ATTITUDE_QUATERNION:31:246:48 LOCAL_POSITION_NED:32:185:28 GLOBAL_POSITION_INT:33:104:28 "
    "RC_CHANNELS_RAW:35:244:22 SERVO_OUTPUT_RAW:36:222:37 MISSION_ITEM:39:254:38 MISSION_CURRENT:42:28:18 "
    "MISSION_REQUEST_LIST:43:132:3 MISSION_COUNT:44:221:9 MISSION_ITEM_REACHED:46:11:2 MISSION_ACK:47:153:8 "
    "GPS_GLOBAL_ORIGIN:49:39:20 NAV_CONTROLLER_OUTPUT:62:183:26 RC_CHANNELS:65:118:42 "
    "REQUEST_DATA_STREAM:66:148:6 MANUAL_CONTROL:69:243:30 RC_CHANNELS_OVERRIDE:70:124:38 "
    "MISSION_ITEM_INT:73:38:38 VFR_HUD:74:20:20 COMMAND_INT:75:158:35 COMMAND_LONG:76:152:33 "
    "COMMAND_ACK:77:143:10 POSITION_TARGET_LOCAL_NED:85:140:51 POSITION_TARGET_GLOBAL_INT:87:150:51 "
    "HIGHRES_IMU:105:93:63 RADIO_STATUS:109:185:9 FILE_TRANSFER_PROTOCOL:110:84:254 TIMESYNC:111:34:18 "
    "SCALED_IMU2:116:76:24 GPS2_RAW:124:87:57 POWER_STATUS:125:203:6 SCALED_IMU3:129:46:24 "
    "DISTANCE_SENSOR:132:85:39 TERRAIN_REPORT:136:1:22 SCALED_PRESSURE2:137:195:16 ALTITUDE:141:47:32 "
    "SCALED_PRESSURE3:143:131:16 BATTERY_STATUS:147:154:54 AUTOPILOT_VERSION:148:178:78 SENSOR_OFFSETS:150:134:42 "
    "MEMINFO:152:208:8 MOUNT_STATUS:158:134:15 AHRS:163:127:28 SIMSTATE:164:154:44 HWSTATUS:165:21:3 "
    "WIND:168:1:12 RANGEFINDER:173:83:8 AIRSPEED_AUTOCAL:174:167:48 AHRS2:178:47:24 BATTERY2:181:174:4 "
    "AHRS3:182:229:40 MAG_CAL_PROGRESS:191:92:27 MAG_CAL_REPORT:192:36:54 EKF_STATUS_REPORT:193:71:26 "
    "ESTIMATOR_STATUS:230:163:42 GPS_INPUT:232:151:65 VIBRATION:241:90:32 HOME_POSITION:242:104:60 "
    "MESSAGE_INTERVAL:244:95:6 EXTENDED_SYS_STATE:245:130:2 NAMED_VALUE_FLOAT:251:170:18 STATUSTEXT:253:83:54 "
    "CAMERA_INFORMATION:259:92:237 CAMERA_SETTINGS:260:146:14 STORAGE_INFORMATION:261:179:61 "
    "CAMERA_CAPTURE_STATUS:262:12:23 VIDEO_STREAM_INFORMATION:269:109:215 VIDEO_STREAM_STATUS:270:59:20 "
    "PARAM_EXT_REQUEST_LIST:321:88:2 PARAM_EXT_VALUE:322:243:149 ODOMETRY:331:91:233 "
    "ACTUATOR_OUTPUT_STATUS:375:251:140 VISION_POSITION_DELTA:11011:106:44 WATER_DEPTH:11038:47:38 "
    "MCU_STATUS:11039:142:9";

constexpr auto kMessages = [] {
  std::array<MessageInfo, 89> messages{};
  std::string_view rest = kMessageText;
  for (MessageInfo& message : messages) {
    message.name = rest.substr(0, rest.find(':'));
    rest.remove_prefix(message.name.size());
    std::array<std::uint32_t, 3> numbers{};
    for (std::uint32_t& number : numbers) {
      rest.remove_prefix(1);
      for (; !rest.empty() && rest.front() >= '0' && rest.front() <= '9'; rest.remove_prefix(1))
        number = number * 10 + static_cast<std::uint32_t>(rest.front() - '0');
    }
    if (!rest.empty()) rest.remove_prefix(1);
    message.id = numbers[0];
    message.crc_extra = static_cast<std::uint8_t>(numbers[1]);
    message.length = static_cast<std::uint8_t>(numbers[2]);
  }
  return messages;
}();
static_assert(kMessages.back().name == "MCU_STATUS" && kMessages.back().length == 9);

/// The sum of a frame with `info`, of which `frame` are all bytes before its own sum, for a payload of so many
/// bytes; those that `frame` lacks are zero.
std::uint16_t sum_of(Bytes frame, std::size_t head, std::size_t length, const MessageInfo& info) {
  std::array<std::uint8_t, Scanner::kMaxFrameLength> summed{};
  std::copy(frame.begin() + 1, frame.end(), summed.begin());
  summed[0] = static_cast<std::uint8_t>(length);
  summed[head - 1 + length] = info.crc_extra;
  return crc16_mcrf4xx(Bytes(summed).first(head + length));
}

}  // namespace

const MessageInfo* message_of(std::uint32_t id) {
  const auto* const found = std::ranges::lower_bound(kMessages, id, {}, &MessageInfo::id);
  return found == kMessages.end() || found->id != id ? nullptr : found;
}

std::string Message::name() const {
  return info != nullptr ? std::string(info->name) : "MSG " + std::to_string(id);
}

std::string Payload::text(std::size_t offset, std::size_t length) const {
  const std::string text(bytes_.begin() + static_cast<std::ptrdiff_t>(offset),
                         bytes_.begin() + static_cast<std::ptrdiff_t>(offset + length));
  return text.substr(0, text.find('\0'));
}

Found find_message(Bytes bytes) {
  using Verdict = Found::Verdict;
  constexpr std::size_t kHead1 = 6, kHead2 = 10, kChecksum = 2, kSignature = 13;
  if (bytes.empty()) return {Verdict::incomplete, {}, kHead1 + kChecksum};
  const bool is_second = bytes[0] == 0xFD;
  if (!is_second && bytes[0] != 0xFE) return {};
  if (is_second && bytes.size() > 2 && (bytes[2] & ~1U) != 0) return {};
  const std::size_t head = is_second ? kHead2 : kHead1;
  if (bytes.size() < head) return {Verdict::incomplete, {}, head + kChecksum - bytes.size()};
  Message message;
  const std::size_t payload = bytes[1];
  message.is_signed = is_second && (bytes[2] & 1U) != 0;
  message.length = head + payload + kChecksum + (message.is_signed ? kSignature : 0);
  message.system = bytes[is_second ? 5 : 3];
  message.component = bytes[is_second ? 6 : 4];
  message.id = is_second ? bytes[7] | std::uint32_t{bytes[8]} << 8 | std::uint32_t{bytes[9]} << 16 : bytes[5];
  message.info = message_of(message.id);
  if (bytes.size() < message.length) return {Verdict::incomplete, message, message.length - bytes.size()};
  message.payload = bytes.subspan(head, payload);
  if (message.info == nullptr) return {Verdict::frame, message, 0};
  const auto sent = get_le<std::uint16_t>(bytes.data() + head + payload);
  const Bytes summed = bytes.first(head + payload);
  if (sum_of(summed, head, payload, *message.info) == sent) return {Verdict::frame, message, 0};
  message.is_untrimmed = is_second && payload < message.info->length &&
                         sum_of(summed, head, message.info->length, *message.info) == sent;
  return {message.is_untrimmed ? Verdict::frame : Verdict::bad_checksum, message, 0};
}

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto [verdict, message, missing] = find_message({first, last});
  if (verdict != Scan::Kind::frame) return {verdict, missing, {}};
  if (message.info != nullptr) return Scan::frame(message.length, FrameId(message.info->name));
  return *first == 0xFD ? Scan::frame(message.length, FrameId(message.name())) : Scan::not_a_frame();
}

std::vector<std::uint8_t> encode(std::uint32_t id, Sender sender, Bytes payload) {
  while (payload.size() > 1 && payload.back() == 0) payload = payload.first(payload.size() - 1);
  const auto length = static_cast<std::uint8_t>(payload.size());
  std::vector<std::uint8_t> frame{0xFD, length, 0, 0, sender.sequence, sender.system, sender.component};
  append_le(frame, static_cast<std::uint16_t>(id));
  frame.push_back(static_cast<std::uint8_t>(id >> 16));
  frame.insert(frame.end(), payload.begin(), payload.end());
  append_checksum(frame, id);
  return frame;
}

void append_checksum(std::vector<std::uint8_t>& frame, std::uint32_t id) {
  append_le(frame, sum_of(frame, frame.size() - frame[1], frame[1], *message_of(id)));
}

std::vector<std::uint8_t> encode_heartbeat(Sender sender, std::uint8_t type) {
  constexpr std::uint8_t kActive = 4, kVersion = 3;
  return encode(0, sender, packed_le(0U, type, kNoAutopilot, std::uint8_t{0}, kActive, kVersion));
}

Parameter parameter_of(const Message& parameter_value, bool is_bytewise) {
  const Payload payload(parameter_value.payload);
  Parameter parameter{payload.text(8, 16), payload.at<std::uint8_t>(24), payload.at<float>(0)};
  if (is_bytewise && parameter.type == Parameter::kInt32) parameter.value = payload.at<std::int32_t>(0);
  return parameter;
}

std::vector<std::uint8_t> encode_setting(Sender sender, std::uint8_t vehicle, const Parameter& parameter,
                                         bool is_bytewise) {
  std::vector<std::uint8_t> payload;
  if (is_bytewise && parameter.type == Parameter::kInt32)
    append_le(payload, saturated<std::int32_t>(parameter.value));
  else
    append_le(payload, static_cast<float>(parameter.value));
  payload.insert(payload.end(), {vehicle, kAutopilot});
  payload.insert(payload.end(), parameter.name.begin(), parameter.name.end());
  payload.resize(22);
  payload.push_back(parameter.type);
  return encode(23, sender, payload);
}

std::vector<std::uint8_t> encode_reading(Sender sender, std::uint8_t vehicle, std::string_view name) {
  std::vector<std::uint8_t> payload{0xFF, 0xFF, vehicle, kAutopilot};  // -1: by its name
  payload.insert(payload.end(), name.begin(), name.end());
  payload.resize(20);
  return encode(20, sender, payload);
}

}  // namespace navcal::protocols::mavlink
