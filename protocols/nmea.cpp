// SPDX-License-Identifier: Apache-2.0
#include "protocols/nmea.h"

#include <algorithm>

#include "protocols/checked_line.h"

namespace navcal::protocols::nmea {
namespace {

constexpr std::size_t kShortestAddress = 2;
constexpr std::size_t kLongestAddress = 16;

constexpr bool is_address(std::uint8_t c) {
  return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z');
}

constexpr unsigned packed(char a, char b, char c) {
  return static_cast<unsigned>(a) << 16 | static_cast<unsigned>(b) << 8 | static_cast<unsigned>(c);
}

}  // namespace

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last, bool requires_checksum) {
  const std::uint8_t* const address = first + 1;
  const std::uint8_t* p = address;
  while (p != last && is_address(*p)) ++p;
  const auto length = static_cast<std::size_t>(p - address);
  if (length > kLongestAddress) return Scan::not_a_frame();
  if (p != last && (length < kShortestAddress || (*p != ',' && *p != '*'))) return Scan::not_a_frame();
  const FrameId id(std::string_view(reinterpret_cast<const char*>(address), length));
  return scan_checked_line(first, last, kMaxLength, id, requires_checksum);
}

Type type_of(FrameId id) {
  const std::string_view name = id.view();
  if (name == "PTNTHTM" || name == "PTNTHPR") return Type::ptnthtm;
  constexpr std::string_view kAttitudes[] = {"PASHR", "PRDID", "PHTRO", "PSAT", "PFEC", "KSXT"};
  if (std::ranges::count(kAttitudes, name) > 0) return Type::attitude;
  if (name.size() != 5 || name[0] == 'P') return Type::other;  // P begins makers' own words
  switch (packed(name[2], name[3], name[4])) {
    case packed('G', 'G', 'A'): return Type::gga;
    case packed('G', 'N', 'S'): return Type::gns;
    case packed('R', 'M', 'C'): return Type::rmc;
    case packed('V', 'T', 'G'): return Type::vtg;
    case packed('G', 'L', 'L'): return Type::gll;
    case packed('G', 'S', 'A'): return Type::gsa;
    case packed('G', 'S', 'V'): return Type::gsv;
    case packed('Z', 'D', 'A'): return Type::zda;
    case packed('H', 'D', 'T'): return Type::hdt;
    case packed('H', 'P', 'R'): return Type::attitude;
    case packed('H', 'D', 'M'): return Type::hdm;
    case packed('H', 'D', 'G'): return Type::hdg;
    case packed('R', 'O', 'T'): return Type::rot;
    case packed('X', 'D', 'R'): return Type::xdr;
    case packed('T', 'H', 'S'): return Type::ths;
    case packed('D', 'B', 'T'): return Type::dbt;
    case packed('D', 'P', 'T'): return Type::dpt;
    default: return Type::other;
  }
}

Sentence::Sentence(Bytes frame) : body_(reinterpret_cast<const char*>(frame.data()) + 1) {
  const std::size_t limit = std::min(frame.size() - 1, kMaxLength - 1);
  std::size_t i = 0;
  for (; i < limit && body_[i] != '*' && body_[i] != '\r' && body_[i] != '\n'; ++i) {
    if (body_[i] == ',') ends_[count_++] = static_cast<std::uint16_t>(i);
  }
  ends_[count_++] = static_cast<std::uint16_t>(i);
}

}  // namespace navcal::protocols::nmea
