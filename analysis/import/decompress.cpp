// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/decompress.h"

#include <lz4.h>
#include <lz4frame.h>
#include <zstd.h>

#include <memory>

namespace navcal::analysis {
namespace {

/// Takes `in` to its end, however many frames it has; memory is taken for what comes out, up to a limit.
/// `step(out, written, in, taken)` sets what it wrote and took: 0 at the end of a frame, nullopt for damage.
template <class Step>
std::optional<std::string> decompressed_frames(std::string_view in, Step step) {
  constexpr std::size_t kBlock = 1 << 17, kMostOfChunk = 1 << 28;
  std::string out, block(kBlock, '\0');
  bool is_ended = false;
  while (!is_ended || !in.empty()) {
    std::size_t written = block.size(), taken = in.size();
    const std::optional<std::size_t> more = step(block.data(), written, in.data(), taken);
    const bool is_cut = written == 0 && taken == 0;
    if (!more || is_cut || out.size() + written > kMostOfChunk) return std::nullopt;
    out.append(block, 0, written);
    in.remove_prefix(taken);
    is_ended = *more == 0;
  }
  return out;
}

std::optional<std::string> decompressed_zstd(std::string_view bytes) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  return decompressed_frames(bytes, [&](char* out, std::size_t& written, const char* in, std::size_t& taken) {
    ZSTD_outBuffer to{out, written, 0};
    ZSTD_inBuffer from{in, taken, 0};
    const std::size_t more = ZSTD_decompressStream(context.get(), &to, &from);
    written = to.pos;
    taken = from.pos;
    return ZSTD_isError(more) != 0 ? std::nullopt : std::optional(more);
  });
}

std::optional<std::string> decompressed_lz4(std::string_view bytes) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, LZ4F_freeDecompressionContext);
  return decompressed_frames(bytes, [&](char* out, std::size_t& written, const char* in, std::size_t& taken) {
    const std::size_t more = LZ4F_decompress(context.get(), out, &written, in, &taken, nullptr);
    return LZ4F_isError(more) != 0 ? std::nullopt : std::optional(more);
  });
}

}  // namespace

std::optional<std::string> decompressed_chunk(std::string_view compression, std::string_view bytes) {
  if (compression == "zstd") return decompressed_zstd(bytes);
  if (compression == "lz4") return decompressed_lz4(bytes);
  return std::nullopt;
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
