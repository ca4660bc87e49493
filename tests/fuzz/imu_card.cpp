// SPDX-License-Identifier: Apache-2.0
// Any bytes from an IMU card.
#include "protocols/imu_card.h"

#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::imu_card_target {

NAVCAL_FUZZ(imu_card) {
  using namespace navcal::protocols;
  navcal::fuzz::check_stream<imu_card::Scanner>({data, size}, [](const Frame& frame) {
    const auto record = imu_card::decode_record(frame.bytes);
    navcal::fuzz::require(record.has_value());
    const auto again = imu_card::encode_record(*record);
    navcal::fuzz::require(std::equal(again.begin(), again.end(), frame.bytes.begin(), frame.bytes.end()));
  });
  // Guessing a CRC takes long: frames of any content, damaged where the input says, get beyond it.
  if (size < 20) return 0;
  imu_card::Record record{data[0], data[1], {}};
  for (std::size_t i = 0; i < record.raw.size(); ++i) {
    record.raw[i] = static_cast<std::uint16_t>(data[2 + 2 * i] << 8 | data[3 + 2 * i]);
  }
  const auto frame = imu_card::encode_record(record);
  navcal::fuzz::require(imu_card::decode_record(frame) == record);
  std::vector<std::uint8_t> mixed(data + 18, data + size);
  mixed.insert(mixed.begin() + static_cast<std::ptrdiff_t>(data[18] % mixed.size()), frame.begin(), frame.end());
  navcal::fuzz::check_stream<imu_card::Scanner>(mixed, [](const Frame&) {});
  return 0;
}

}  // namespace navcal::fuzz::imu_card_target
