// SPDX-License-Identifier: Apache-2.0
#include "protocols/ubx.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "protocols/crc16.h"
#include "protocols/decimal.h"
#include "protocols/fletcher.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::ubx {

FrameId id_of(MessageCode code) {
  if (const std::string_view name = name_of(code); !name.empty()) return FrameId(name);
  std::string text;
  append_hex(text, code, 4);
  return FrameId(text);
}

std::optional<MessageCode> code_of(const Frame& frame) {
  if (kind_of(frame) != Kind::ubx) return std::nullopt;
  return get_be<MessageCode>(frame.bytes.data() + 2);
}

std::optional<Bytes> payload_if(Bytes frame, MessageCode code, std::size_t least) {
  if (frame.size() < kOverhead + least || get_be<MessageCode>(frame.data() + 2) != code) return std::nullopt;
  return payload_of(frame);
}

Kind kind_of(const Frame& frame) {
  if (frame.bytes[0] == 0xB5) return Kind::ubx;
  return frame.bytes[0] == 0xD3 ? Kind::rtcm3 : Kind::nmea;
}

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available > 1 && first[1] != 0x62) return Scan::not_a_frame();
  if (available < 6) return Scan::incomplete(kOverhead - available);
  const std::size_t payload = get_le<std::uint16_t>(first + 4);
  if (payload > kMaxPayload) return Scan::not_a_frame();
  const std::size_t length = kOverhead + payload;
  if (available < length) return Scan::incomplete(length - available);
  const Fletcher sum = fletcher_of(Bytes(first + 2, length - 4));
  if (sum != Fletcher{first[length - 2], first[length - 1]}) return Scan::bad_checksum();
  return Scan::frame(length, id_of(get_be<MessageCode>(first + 2)));
}

Scan Rtcm3Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  constexpr std::size_t kRtcmOverhead = 6;
  const auto available = static_cast<std::size_t>(last - first);
  if (available > 1 && (first[1] & 0xFCU) != 0) return Scan::not_a_frame();
  if (available < 3) return Scan::incomplete(kRtcmOverhead - available);
  const std::size_t length = kRtcmOverhead + get_be<std::uint16_t>(first + 1);
  if (available < length) return Scan::incomplete(length - available);
  const std::uint8_t* const crc = first + length - 3;
  if (crc24q(Bytes(first, length - 3)) != (std::uint32_t{crc[0]} << 16 | get_be<std::uint16_t>(crc + 1))) {
    return Scan::bad_checksum();
  }
  return Scan::frame(length, kRtcm3);
}

Scan PortScanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  if (*first == 0xB5) return Scanner::scan(first, last);
  return *first == 0xD3 ? Rtcm3Scanner::scan(first, last) : nmea::Scanner::scan(first, last);
}

std::vector<std::uint8_t> encode_frame(MessageCode code, Bytes payload) {
  assert(payload.size() <= kMaxPayload);
  std::vector<std::uint8_t> frame(kOverhead + payload.size());
  frame[0] = 0xB5;
  frame[1] = 0x62;
  put_be(&frame[2], code);
  put_le(&frame[4], static_cast<std::uint16_t>(payload.size()));
  std::copy(payload.begin(), payload.end(), frame.begin() + 6);
  const Fletcher sum = fletcher_of(Bytes(frame).subspan(2, frame.size() - 4));
  frame[frame.size() - 2] = sum.first;
  frame[frame.size() - 1] = sum.second;
  return frame;
}

namespace {

struct MessageName {
  MessageCode code;
  std::string_view name;
};

/// Names of the interface descriptions of generations 5 to 10, in the order of their codes. Names that a FrameId
/// cannot hold (LOG-RETRIEVEPOSEXTRA) are left out: such frames have their code.
constexpr auto kMessageNames = std::to_array<MessageName>(
    {{0x0101, "NAV-POSECEF"},     {0x0102, "NAV-POSLLH"},      {0x0103, "NAV-STATUS"},
     {0x0104, "NAV-DOP"},         {0x0105, "NAV-ATT"},         {0x0106, "NAV-SOL"},
     {0x0107, "NAV-PVT"},         {0x0109, "NAV-ODO"},         {0x0110, "NAV-RESETODO"},
     {0x0111, "NAV-VELECEF"},     {0x0112, "NAV-VELNED"},      {0x0113, "NAV-HPPOSECEF"},
     {0x0114, "NAV-HPPOSLLH"},    {0x0117, "NAV-PVAT"},        {0x0120, "NAV-TIMEGPS"},
     {0x0121, "NAV-TIMEUTC"},     {0x0122, "NAV-CLOCK"},       {0x0123, "NAV-TIMEGLO"},
     {0x0124, "NAV-TIMEBDS"},     {0x0125, "NAV-TIMEGAL"},     {0x0126, "NAV-TIMELS"},
     {0x0127, "NAV-TIMEQZSS"},    {0x0128, "NAV-NMI"},         {0x0130, "NAV-SVINFO"},
     {0x0131, "NAV-DGPS"},        {0x0132, "NAV-SBAS"},        {0x0134, "NAV-ORB"},
     {0x0135, "NAV-SAT"},         {0x0136, "NAV-COV"},         {0x0139, "NAV-GEOFENCE"},
     {0x013B, "NAV-SVIN"},        {0x013C, "NAV-RELPOSNED"},   {0x013D, "NAV-EELL"},
     {0x0140, "NAV-EKFSTATUS"},   {0x0142, "NAV-SLAS"},        {0x0143, "NAV-SIG"},
     {0x0160, "NAV-AOPSTATUS"},   {0x0161, "NAV-EOE"},         {0x0162, "NAV-PL"},
     {0x0163, "NAV-TIMENAVIC"},   {0x0164, "NAV-TIMETRUSTED"}, {0x0210, "RXM-RAW"},
     {0x0211, "RXM-SFRB"},        {0x0213, "RXM-SFRBX"},       {0x0214, "RXM-MEASX"},
     {0x0215, "RXM-RAWX"},        {0x0220, "RXM-SVSI"},        {0x0230, "RXM-ALM"},
     {0x0231, "RXM-EPH"},         {0x0232, "RXM-RTCM"},        {0x0233, "RXM-SPARTN"},
     {0x0234, "RXM-COR"},         {0x0236, "RXM-SPARTN-KEY"},  {0x0240, "RXM-POSREQ"},
     {0x0241, "RXM-PMREQ"},       {0x0259, "RXM-RLM"},         {0x0261, "RXM-IMES"},
     {0x0272, "RXM-PMP"},         {0x0273, "RXM-QZSSL6"},      {0x0274, "RXM-TM"},
     {0x0280, "RXM-MEASD12"},     {0x0282, "RXM-MEASC12"},     {0x0284, "RXM-MEAS20"},
     {0x0286, "RXM-MEAS50"},      {0x0400, "INF-ERROR"},       {0x0401, "INF-WARNING"},
     {0x0402, "INF-NOTICE"},      {0x0403, "INF-TEST"},        {0x0404, "INF-DEBUG"},
     {0x0500, "ACK-NAK"},         {0x0501, "ACK-ACK"},         {0x0600, "CFG-PRT"},
     {0x0601, "CFG-MSG"},         {0x0602, "CFG-INF"},         {0x0604, "CFG-RST"},
     {0x0606, "CFG-DAT"},         {0x0607, "CFG-TP"},          {0x0608, "CFG-RATE"},
     {0x0609, "CFG-CFG"},         {0x060E, "CFG-FXN"},         {0x0611, "CFG-RXM"},
     {0x0612, "CFG-EKF"},         {0x0613, "CFG-ANT"},         {0x0616, "CFG-SBAS"},
     {0x0617, "CFG-NMEA"},        {0x061B, "CFG-USB"},         {0x061D, "CFG-TMODE"},
     {0x061E, "CFG-ODO"},         {0x0622, "CFG-NVS"},         {0x0623, "CFG-NAVX5"},
     {0x0624, "CFG-NAV5"},        {0x0629, "CFG-ESFGWT"},      {0x0631, "CFG-TP5"},
     {0x0632, "CFG-PM"},          {0x0634, "CFG-RINV"},        {0x0639, "CFG-ITFM"},
     {0x063B, "CFG-PM2"},         {0x063D, "CFG-TMODE2"},      {0x063E, "CFG-GNSS"},
     {0x0641, "CFG-OTP"},         {0x0647, "CFG-LOGFILTER"},   {0x064C, "CFG-ESFA"},
     {0x064D, "CFG-ESFG"},        {0x0653, "CFG-TXSLOT"},      {0x0656, "CFG-ESFALG"},
     {0x0657, "CFG-PWR"},         {0x065C, "CFG-HNR"},         {0x0660, "CFG-ESRC"},
     {0x0661, "CFG-DOSC"},        {0x0662, "CFG-SMGR"},        {0x0664, "CFG-SPT"},
     {0x0669, "CFG-GEOFENCE"},    {0x0670, "CFG-DGNSS"},       {0x0671, "CFG-TMODE3"},
     {0x0682, "CFG-ESFWT"},       {0x0684, "CFG-FIXSEED"},     {0x0685, "CFG-DYNSEED"},
     {0x0686, "CFG-PMS"},         {0x0688, "CFG-SENIF"},       {0x068A, "CFG-VALSET"},
     {0x068B, "CFG-VALGET"},      {0x068C, "CFG-VALDEL"},      {0x068D, "CFG-SLAS"},
     {0x0693, "CFG-BATCH"},       {0x0914, "UPD-SOS"},         {0x0A02, "MON-IO"},
     {0x0A04, "MON-VER"},         {0x0A06, "MON-MSGPP"},       {0x0A07, "MON-RXBUF"},
     {0x0A08, "MON-TXBUF"},       {0x0A09, "MON-HW"},          {0x0A0B, "MON-HW2"},
     {0x0A21, "MON-RXR"},         {0x0A27, "MON-PATCH"},       {0x0A28, "MON-GNSS"},
     {0x0A2E, "MON-SMGR"},        {0x0A2F, "MON-SPT"},         {0x0A31, "MON-SPAN"},
     {0x0A36, "MON-COMMS"},       {0x0A37, "MON-HW3"},         {0x0A38, "MON-RF"},
     {0x0A39, "MON-SYS"},         {0x0B00, "AID-REQ"},         {0x0B01, "AID-INI"},
     {0x0B02, "AID-HUI"},         {0x0B10, "AID-DATA"},        {0x0B30, "AID-ALM"},
     {0x0B31, "AID-EPH"},         {0x0B32, "AID-ALPSRV"},      {0x0B33, "AID-AOP"},
     {0x0B50, "AID-ALP"},         {0x0D01, "TIM-TP"},          {0x0D03, "TIM-TM2"},
     {0x0D04, "TIM-SVIN"},        {0x0D06, "TIM-VRFY"},        {0x0D11, "TIM-DOSC"},
     {0x0D12, "TIM-TOS"},         {0x0D13, "TIM-SMEAS"},       {0x0D15, "TIM-VCOCAL"},
     {0x0D16, "TIM-FCHG"},        {0x0D17, "TIM-HOC"},         {0x1002, "ESF-MEAS"},
     {0x1003, "ESF-RAW"},         {0x1004, "ESF-CAL"},         {0x1010, "ESF-STATUS"},
     {0x1013, "ESF-RESETALG"},    {0x1014, "ESF-ALG"},         {0x1015, "ESF-INS"},
     {0x1300, "MGA-GPS"},         {0x1302, "MGA-GAL"},         {0x1303, "MGA-BDS"},
     {0x1305, "MGA-QZSS"},        {0x1306, "MGA-GLO"},         {0x1320, "MGA-ANO"},
     {0x1321, "MGA-FLASH"},       {0x1340, "MGA-INI"},         {0x1360, "MGA-ACK"},
     {0x1380, "MGA-DBD"},         {0x2103, "LOG-ERASE"},       {0x2104, "LOG-STRING"},
     {0x2107, "LOG-CREATE"},      {0x2108, "LOG-INFO"},        {0x2109, "LOG-RETRIEVE"},
     {0x210B, "LOG-RETRIEVEPOS"}, {0x210E, "LOG-FINDTIME"},    {0x2111, "LOG-BATCH"},
     {0x2701, "SEC-SIGN"},        {0x2703, "SEC-UNIQID"},      {0x2709, "SEC-SIG"},
     {0x270A, "SEC-OSNMA"},       {0x2710, "SEC-SIGLOG"},      {0x2800, "HNR-PVT"},
     {0x2801, "HNR-ATT"},         {0x2802, "HNR-INS"},         {0x2901, "NAV2-POSECEF"},
     {0x2902, "NAV2-POSLLH"},     {0x2903, "NAV2-STATUS"},     {0x2904, "NAV2-DOP"},
     {0x2907, "NAV2-PVT"},        {0x2909, "NAV2-ODO"},        {0x2911, "NAV2-VELECEF"},
     {0x2912, "NAV2-VELNED"},     {0x2917, "NAV2-PVAT"},       {0x2920, "NAV2-TIMEGPS"},
     {0x2921, "NAV2-TIMEUTC"},    {0x2922, "NAV2-CLOCK"},      {0x2923, "NAV2-TIMEGLO"},
     {0x2924, "NAV2-TIMEBDS"},    {0x2925, "NAV2-TIMEGAL"},    {0x2926, "NAV2-TIMELS"},
     {0x2927, "NAV2-TIMEQZSS"},   {0x2932, "NAV2-SBAS"},       {0x2935, "NAV2-SAT"},
     {0x2936, "NAV2-COV"},        {0x293B, "NAV2-SVIN"},       {0x293D, "NAV2-EELL"},
     {0x2942, "NAV2-SLAS"},       {0x2943, "NAV2-SIG"},        {0x2961, "NAV2-EOE"},
     {0x2963, "NAV2-TIMENAVIC"}});
static_assert(std::is_sorted(kMessageNames.begin(), kMessageNames.end(),
                             [](const MessageName& a, const MessageName& b) { return a.code < b.code; }));

}  // namespace

std::string_view name_of(MessageCode code) {
  const auto found = std::ranges::lower_bound(kMessageNames, code, {}, &MessageName::code);
  return found != kMessageNames.end() && found->code == code ? found->name : std::string_view();
}

}  // namespace navcal::protocols::ubx
