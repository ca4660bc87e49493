// SPDX-License-Identifier: Apache-2.0
#include <lz4frame.h>
#include <zstd.h>

#include "record/log/mcap_format.h"
#include "tests/analysis/import/without_channels.h"
#include "tests/fuzz/import_sink.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::import_ros_bag_target {

void read(std::string_view file) {
  static_cast<void>(navcal::analysis::is_ros_bag(file));
  navcal::fuzz::CheckingSink sink;
  navcal::fuzz::require_within(navcal::analysis::read_ros_bag(file, sink), file.size());
}

/// A bag of one chunk that states a size of its own.
std::string bag_of(std::string_view compression, std::uint64_t size, std::string_view bytes) {
  std::string bag(record::kMcapMagic);
  {
    const record::RecordScope scope(bag, record::Opcode::chunk);
    bag.append(16, '\0');
    record::append_le(bag, size);
    record::append_le(bag, std::uint32_t{0});
    record::append_mcap_string(bag, compression);
    record::append_le(bag, std::uint64_t{bytes.size()});
    bag += bytes;
  }
  return bag;
}

// The input as a file, as the records in a chunk, and as the compressed bytes of one.
NAVCAL_FUZZ(import_ros_bag) {
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  read(file);
  std::string packed(ZSTD_compressBound(size), '\0');
  read(bag_of("zstd", size, packed.substr(0, ZSTD_compress(packed.data(), packed.size(), data, size, 1))));
  packed.resize(LZ4F_compressFrameBound(size, nullptr));
  read(bag_of("lz4", size,
              packed.substr(0, LZ4F_compressFrame(packed.data(), packed.size(), data, size, nullptr))));
  for (const std::string_view compression : {"zstd", "lz4"}) read(bag_of(compression, size, file));
  return 0;
}

}  // namespace navcal::fuzz::import_ros_bag_target
