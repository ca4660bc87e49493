// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

namespace navcal::protocols::nmea {

/// NMEA 0183 allows 82 characters. Transducer lists (XDR) and makers' own sentences are longer in real streams, so
/// more is taken; the bound is there because a `$` in noise must not hold the parser for long (at 4800 baud: 1 s).
inline constexpr std::size_t kMaxLength = 512;

/// Sentences `$...*hh` and `!...*hh`, ended by CR LF or by LF alone. The checksum is required: without it a
/// sentence that lost or swapped bytes reads like a good one (gpsd's rule too). The identifier of a frame is
/// talker and type, "GPGGA", or the maker's word, "PTNTHTM"; of longer ones the first eight characters.
struct Scanner : StartsWith<'$', '!'> {
  static constexpr std::size_t kMaxFrameLength = kMaxLength;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last, bool requires_checksum = true);
};

using Parser = StreamParser<Scanner>;

/// At the port of a device that sends sentences without a checksum, those are taken as well.
struct PortScanner : Scanner {
  bool requires_checksum = true;
  [[nodiscard]] Scan scan(const std::uint8_t* first, const std::uint8_t* last) const {
    return Scanner::scan(first, last, requires_checksum);
  }
};

/// Sentences with a decoder here; any talker.
enum class Type : std::uint8_t {
  gga,
  gns,
  rmc,
  vtg,
  gll,
  gsa,
  gsv,
  zda,
  hdt,
  hdm,
  hdg,
  rot,
  xdr,
  ths,
  dbt,
  dpt,
  ptnthtm,
  attitude,  ///< PASHR, PRDID, PHTRO, PSAT, PFEC, HPR, KSXT
  other
};

[[nodiscard]] Type type_of(FrameId id);

/// The fields of an intact sentence; views into its bytes, no allocation.
class Sentence {
 public:
  explicit Sentence(Bytes frame);

  /// "GPGGA", "PTNTHTM".
  [[nodiscard]] std::string_view address() const { return text(0, ends_[0]); }
  /// Number of fields after the address.
  [[nodiscard]] std::size_t size() const { return count_ - 1; }
  /// Field after the address, from 0; empty beyond the last.
  [[nodiscard]] std::string_view operator[](std::size_t index) const {
    return index < size() ? text(ends_[index] + 1U, ends_[index + 1]) : std::string_view{};
  }

 private:
  [[nodiscard]] std::string_view text(std::size_t first, std::size_t last) const {
    return {body_ + first, last - first};
  }

  const char* body_;                            // behind the $
  std::size_t count_ = 0;                       // of fields, the address included
  std::array<std::uint16_t, kMaxLength> ends_;  // where each ends; the first count_ of them are set
};

}  // namespace navcal::protocols::nmea
