// SPDX-License-Identifier: Apache-2.0
// Any bytes from described devices of each form, and frames of any content among them.
#include "protocols/described/reading.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"
#include "tests/protocols/described_samples.h"

namespace navcal::fuzz::described_target {

using navcal::protocols::Bytes;
using navcal::protocols::Frame;
namespace described = navcal::protocols::described;

void read_frame(const described::Description& device, const Frame& frame) {
  for (const auto& kind : device.kinds) {
    if (kind.id != frame.id) continue;
    std::vector<double> values(kind.fields.size());
    const described::FrameReader reader(kind, device.is_text);
    (void)reader.read(frame.bytes, values);
    reader.read_plain(frame.bytes, values);
  }
}

void check(const described::Description& device, Bytes input) {
  navcal::fuzz::check_stream<described::Scanner>(
      input, [&](const Frame& frame) { read_frame(device, frame); }, described::test::scanner_of(device));
}

NAVCAL_FUZZ(described) {
  if (size < 2) return 0;
  const auto devices = described::test::all_devices();
  const auto& device = devices[data[0] % devices.size()].description;
  check(device, {data + 1, size - 1});
  // Guessing a checksum takes long: a frame of any content, put where the input says.
  if (size < 20) return 0;
  const auto& kind = device.kinds[data[1] % device.kinds.size()];
  std::vector<double> values;
  for (std::size_t i = 0; i < kind.fields.size(); ++i) values.push_back(data[2 + i % 16] * 3.5 - 100);
  const auto frame = encode(device, kind, values);
  std::vector<std::uint8_t> mixed(data + 18, data + size);
  mixed.insert(mixed.begin() + static_cast<std::ptrdiff_t>(data[18] % mixed.size()), frame.begin(), frame.end());
  check(device, mixed);
  return 0;
}

}  // namespace navcal::fuzz::described_target
