// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/decompress.h"

#include <lz4.h>
#include <lz4frame.h>
#include <zstd.h>

#include <utility>

namespace navcal::analysis {
namespace {

/// Bytes written; 0 for what is damaged.
std::size_t decompress_lz4_frame(std::string_view bytes, std::string& out) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return 0;
  std::size_t written = out.size(), taken = bytes.size();
  const std::size_t more = LZ4F_decompress(context, out.data(), &written, bytes.data(), &taken, nullptr);
  LZ4F_freeDecompressionContext(context);
  return more == 0 ? written : 0;
}

}  // namespace

std::optional<std::string> decompressed_chunk(std::string_view compression, std::string_view bytes,
                                              std::uint64_t size) {
  // A damaged size must not take the memory of the machine.
  constexpr std::uint64_t kMostSize = 1 << 30, kMostRatio = 4096;
  if (size > kMostSize || size / kMostRatio > bytes.size()) return std::nullopt;
  std::string out(size, '\0');
  std::size_t written = 0;
  if (compression == "zstd") written = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
  if (compression == "lz4") written = decompress_lz4_frame(bytes, out);
  return written == size ? std::optional(std::move(out)) : std::nullopt;
}

std::string decompressed_blocks(std::string_view file) {
  constexpr std::size_t kHead = 2, kMostBlock = 1 << 20;
  std::string out, block(kMostBlock, '\0');
  while (file.size() > kHead) {
    const std::size_t length = static_cast<unsigned char>(file[0]) * 256U + static_cast<unsigned char>(file[1]);
    file.remove_prefix(kHead);
    if (length > file.size()) break;
    const int written = LZ4_decompress_safe(file.data(), block.data(), static_cast<int>(length), kMostBlock);
    if (written < 0) break;
    out.append(block, 0, static_cast<std::size_t>(written));
    file.remove_prefix(length);
  }
  return out;
}

}  // namespace navcal::analysis
