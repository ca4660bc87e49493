// SPDX-License-Identifier: Apache-2.0
#include "tests/protocols/receiver_sentences.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "protocols/checked_line.h"
#include "protocols/nmea_position.h"

namespace navcal::protocols::nmea {
namespace {

template <class... Values>
std::string print(const char* format, Values... values) {
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

bool has_fix(const Navigation& navigation) {
  return navigation.fix == Fix::fix_2d || navigation.fix == Fix::fix_3d || navigation.fix == Fix::propagated;
}

char mode_of(const Navigation& navigation) {
  if (!has_fix(navigation)) return 'N';
  return navigation.fix == Fix::propagated ? 'E' : 'A';
}

std::string hhmmss(const TimeOfDay& time) {
  return print("%02u%02u%02u.%02u", unsigned{time.hour}, unsigned{time.minute}, unsigned{time.second},
               static_cast<unsigned>(time.nanosecond / 10'000'000));
}

// Rounded as a whole number of 1e-4 minutes, so that 59.99996 minutes become the next degree and not "60.0000".
std::string coordinate(double angle_deg, int degree_digits, char positive, char negative) {
  const long total = std::lround(std::fabs(angle_deg) * 600'000);
  return print("%0*ld%02ld.%04ld,%c", degree_digits, total / 600'000, total / 10'000 % 60, total % 10'000,
               angle_deg < 0 ? negative : positive);
}

std::string place(const Navigation& navigation) {
  if (!has_fix(navigation)) return ",,,";
  return coordinate(navigation.latitude_deg, 2, 'N', 'S') + ',' +
         coordinate(navigation.longitude_deg, 3, 'E', 'W');
}

double course_in_tenths(double course_deg) {
  return static_cast<double>(std::lround(course_deg * 10) % 3600) / 10;
}

}  // namespace

std::vector<std::uint8_t> encode_gga(const Navigation& navigation, const Satellites& satellites) {
  const auto used = std::count_if(satellites.begin(), satellites.end(), [](const auto& s) { return s.used; });
  std::string body = "GPGGA," + hhmmss(navigation.time) + ',' + place(navigation);
  if (has_fix(navigation)) {
    body += print(",%d,%02ld,%.1f,%.1f,M,%.1f,M,,", navigation.fix == Fix::propagated ? 6 : 1,
                  static_cast<long>(used), navigation.hdop, navigation.altitude_m, navigation.geoid_separation_m);
  } else {
    body += print(",0,%02ld,,,M,,M,,", static_cast<long>(used));
  }
  return checked_line(body);
}

std::vector<std::uint8_t> encode_rmc(const Navigation& navigation) {
  std::string body =
      "GPRMC," + hhmmss(navigation.time) + (has_fix(navigation) ? ",A," : ",V,") + place(navigation);
  body += has_fix(navigation) ? print(",%.2f,%.1f", navigation.speed_m_s / kMetresPerSecondPerKnot,
                                      course_in_tenths(navigation.course_deg))
                              : ",,";
  body += print(",%02u%02u%02u,,,%c", unsigned{navigation.date.day}, unsigned{navigation.date.month},
                navigation.date.year % 100U, mode_of(navigation));
  return checked_line(body);
}

std::vector<std::uint8_t> encode_vtg(const Navigation& navigation) {
  if (!has_fix(navigation)) return checked_line("GPVTG,,T,,M,,N,,K,N");
  return checked_line(print("GPVTG,%.1f,T,,M,%.2f,N,%.2f,K,%c", course_in_tenths(navigation.course_deg),
                            navigation.speed_m_s / kMetresPerSecondPerKnot, navigation.speed_m_s * 3.6,
                            mode_of(navigation)));
}

std::vector<std::uint8_t> encode_gsa(const Navigation& navigation, const Satellites& satellites) {
  std::string body = "GPGSA,A,";
  body += navigation.fix == Fix::fix_3d ? '3' : (navigation.fix == Fix::fix_2d ? '2' : '1');
  std::size_t slots = 0;
  for (const auto& satellite : satellites) {
    if (!satellite.used || slots == Gsa::kSlots) continue;
    body += print(",%02u", unsigned{satellite.number});
    ++slots;
  }
  body.append(Gsa::kSlots - slots, ',');
  body +=
      has_fix(navigation) ? print(",%.1f,%.1f,%.1f", navigation.pdop, navigation.hdop, navigation.vdop) : ",,,";
  return checked_line(body);
}

std::vector<std::uint8_t> encode_zda(const Navigation& navigation) {
  return checked_line("GPZDA," + hhmmss(navigation.time) +
                      print(",%02u,%02u,%04u,00,00", unsigned{navigation.date.day},
                            unsigned{navigation.date.month}, unsigned{navigation.date.year}));
}

std::vector<std::uint8_t> encode_gsv(const Satellites& satellites) {
  std::vector<std::uint8_t> sentences;
  const std::size_t total = std::max<std::size_t>((satellites.size() + 3) / 4, 1);
  for (std::size_t n = 0; n < total; ++n) {
    std::string body = print("GPGSV,%zu,%zu,%02zu", total, n + 1, satellites.size());
    for (std::size_t i = 4 * n; i < std::min(4 * n + 4, satellites.size()); ++i) {
      const auto& satellite = satellites[i];
      body += print(",%02u,%02u,%03u,", unsigned{satellite.number}, unsigned{satellite.elevation_deg},
                    unsigned{satellite.azimuth_deg});
      if (satellite.cn0_dBHz) body += print("%02u", unsigned{*satellite.cn0_dBHz});
    }
    const auto line = checked_line(body);
    sentences.insert(sentences.end(), line.begin(), line.end());
  }
  return sentences;
}

}  // namespace navcal::protocols::nmea
