// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstdlib>
#include <string>

#include "record/capture/capture_reader.h"
#include "record/capture/capture_writer.h"
#include "tests/fuzz/target.h"
#include "tests/record/memory_source.h"

// Whatever the reader accepts, the writer writes so that it reads the same again.

namespace navcal::fuzz::capture_target {

NAVCAL_FUZZ(capture) {
  using namespace navcal::record;
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    CaptureReader reader(std::make_unique<MemorySource>(text), "fuzz");
    CaptureWriter writer(reader.ports());
    std::string written;
    writer.begin(written);
    std::uint64_t reads = 0;
    for (RawRead read; reader.next(read); ++reads) {
      writer.bytes(written, read.port, read.direction, read.time_ns, read.bytes);
    }
    CaptureReader again(std::make_unique<MemorySource>(written), "again");
    for (RawRead read; again.next(read);) --reads;
    if (reads != 0) std::abort();
  } catch (const BadRecording&) {
  }
  return 0;
}

}  // namespace navcal::fuzz::capture_target
