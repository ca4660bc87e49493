// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_ascii.h"

#include <string_view>

#include "protocols/decimal.h"
#include "protocols/oncore.h"
#include "protocols/units.h"

namespace navcal::protocols::oncore {
namespace {

// Columns are fixed:
// @@Eq,mm,dd,yy,hh,mm,ss,dd,mm.mmmm,n,ddd,mm.mmmm,w,shhhhh.h,sss.s,hhh.h,m,t,dd.d,nn,rrrr,aa,CCC
class Columns {
 public:
  explicit Columns(std::string_view text) : text_(text) {}

  double number(std::size_t at, std::size_t width) {
    std::string_view field = text_.substr(at, width);
    if (field.front() == '+') field.remove_prefix(1);
    const auto value = decimal(field);
    readable_ = readable_ && value && text_[at + width] == ',';
    return value.value_or(0);
  }
  unsigned count(std::size_t at, std::size_t width) {
    const double value = number(at, width);
    readable_ = readable_ && value >= 0;
    return readable_ ? static_cast<unsigned>(value) : 0;
  }
  char letter(std::size_t at) {
    readable_ = readable_ && text_[at + 1] == ',';
    return text_[at];
  }
  [[nodiscard]] bool readable() const { return readable_; }

 private:
  std::string_view text_;
  bool readable_ = true;
};

Fix fix_of(char type) {
  switch (type) {
    case '1': return Fix::fix_2d;
    case '2': return Fix::fix_3d;
    case '3': return Fix::propagated;
    default: return Fix::none;
  }
}

}  // namespace

std::optional<Position> decode_eq(Bytes frame) {
  if (frame.size() != response_length('E', 'q')) return std::nullopt;
  Columns columns(std::string_view(reinterpret_cast<const char*>(frame.data()), frame.size()));
  const auto small = [&](std::size_t at) { return static_cast<std::uint8_t>(columns.count(at, 2)); };

  Position out;
  out.date = {full_year(columns.count(11, 2)), small(5), small(8)};
  out.time = {small(14), small(17), small(20), 0};
  const double latitude_minutes = columns.number(26, 7);
  const double longitude_minutes = columns.number(40, 7);
  out.filtered.latitude_deg = columns.count(23, 2) + latitude_minutes / 60;
  out.filtered.longitude_deg = columns.count(36, 3) + longitude_minutes / 60;
  const char north = columns.letter(34);
  const char east = columns.letter(48);
  out.filtered.height_m = columns.number(50, 8);
  out.speed_m_s = columns.number(59, 5) * kMetresPerSecondPerKnot;
  out.heading_deg = columns.number(65, 5);
  out.fix = fix_of(columns.letter(73));
  out.dop = columns.number(75, 4);
  out.tracked = small(80);
  if (!columns.readable() || (north != 'N' && north != 'S') || (east != 'E' && east != 'W')) return std::nullopt;

  out.in_range = is_valid(out.date) && is_valid(out.time) && latitude_minutes < 60 && longitude_minutes < 60 &&
                 out.filtered.latitude_deg <= 90 && out.filtered.longitude_deg <= 180 && out.heading_deg < 360;
  if (north == 'S') out.filtered.latitude_deg = -out.filtered.latitude_deg;
  if (east == 'W') out.filtered.longitude_deg = -out.filtered.longitude_deg;
  return out;
}

}  // namespace navcal::protocols::oncore
