// SPDX-License-Identifier: Apache-2.0
#include "protocols/nmea.h"

#include <cmath>

#include "protocols/nmea_attitude.h"
#include "protocols/nmea_position.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::nmea_target {

namespace nmea = navcal::protocols::nmea;

void require_on_earth(const std::optional<nmea::LatLon>& place) {
  if (!place) return;
  navcal::fuzz::require(std::fabs(place->latitude_deg) <= 90 && std::fabs(place->longitude_deg) <= 180);
}

// Runs every decoder, whatever the type of the sentence.
void decode_everything(navcal::protocols::Bytes frame) {
  const nmea::Sentence sentence(frame);
  std::size_t bytes = sentence.address().size();
  for (std::size_t i = 0; i < sentence.size(); ++i) bytes += 1 + sentence[i].size();
  navcal::fuzz::require(bytes < frame.size());
  if (const auto gga = nmea::decode_gga(sentence)) require_on_earth(gga->place);
  if (const auto gns = nmea::decode_gns(sentence)) require_on_earth(gns->place);
  if (const auto rmc = nmea::decode_rmc(sentence)) {
    require_on_earth(rmc->place);
    navcal::fuzz::require(!rmc->date || is_valid(*rmc->date));
    navcal::fuzz::require(!rmc->time || is_valid(*rmc->time));
  }
  if (const auto gll = nmea::decode_gll(sentence)) require_on_earth(gll->place);
  if (const auto zda = nmea::decode_zda(sentence)) navcal::fuzz::require(!zda->date || is_valid(*zda->date));
  static_cast<void>(nmea::decode_vtg(sentence));
  static_cast<void>(nmea::decode_gsa(sentence));
  static_cast<void>(nmea::decode_gsv(sentence));
  for (const nmea::Type type : {nmea::Type::hdt, nmea::Type::hdm, nmea::Type::hdg, nmea::Type::ths})
    static_cast<void>(nmea::decode_heading(sentence, type));
  static_cast<void>(nmea::decode_attitude(sentence));
  static_cast<void>(nmea::decode_rot(sentence));
  static_cast<void>(nmea::decode_xdr(sentence));
  static_cast<void>(nmea::decode_ptnthtm(sentence));
  static_cast<void>(nmea::decode_depth(sentence, nmea::Type::dbt));
  static_cast<void>(nmea::decode_depth(sentence, nmea::Type::dpt));
}

NAVCAL_FUZZ(nmea) {
  navcal::fuzz::check_stream<nmea::Scanner>({data, size},
                                            [](const auto& frame) { decode_everything(frame.bytes); });
  // Checksums are hard to guess: the same text again as the body of a sentence.
  if (size > 0 && size < nmea::kMaxLength) decode_everything({data, size});
  return 0;
}

}  // namespace navcal::fuzz::nmea_target
