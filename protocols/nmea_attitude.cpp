// SPDX-License-Identifier: Apache-2.0
#include "protocols/nmea_attitude.h"

#include <algorithm>
#include <iterator>

#include "protocols/nmea_fields.h"

namespace navcal::protocols::nmea {
namespace {

constexpr double kMaxRate_deg_min = 1e5;
constexpr double kMaxDepth_m = 12000;
constexpr double kMetresPerFoot = 0.3048;
constexpr double kMetresPerFathom = 1.8288;

Depth below_transducer(FieldReader& fields) {
  const auto feet = fields.decimal(0, kMaxDepth_m / kMetresPerFoot);
  fields.skip();
  const auto metres = fields.decimal(0, kMaxDepth_m);
  fields.skip();
  const auto fathoms = fields.decimal(0, kMaxDepth_m / kMetresPerFathom);
  Depth out;
  if (metres) {
    out.depth_m = metres->value();
  } else if (feet) {
    out.depth_m = feet->value() * kMetresPerFoot;
  } else if (fathoms) {
    out.depth_m = fathoms->value() * kMetresPerFathom;
  }
  return out;
}

constexpr std::size_t kNone = kMaxLength;  // a field that no sentence has

/// Places of the values in a maker's sentence; fields count from 0.
struct AttitudeForm {
  std::string_view ending;  ///< of the address
  std::size_t mark;         ///< field that tells the sentences of one maker apart: it reads `marked`
  std::string_view marked;
  std::size_t heading, pitch, roll;
  std::size_t quality;  ///< 0 there: not valid
};
constexpr AttitudeForm kAttitudeForms[] = {
    {"PASHR", 2, "T", 1, 4, 3, kNone},        {"PRDID", kNone, "", 2, 0, 1, kNone},
    {"PHTRO", kNone, "", kNone, 0, 2, kNone}, {"PSAT", 0, "HPR", 2, 3, 4, kNone},
    {"PFEC", 0, "GPatt", 1, 2, 3, kNone},     {"KSXT", kNone, "", 4, 5, 8, 10},
    {"HPR", kNone, "", 1, 2, 3, 4},
};

}  // namespace

std::optional<Heading> decode_heading(const Sentence& sentence, Type type) {
  FieldReader fields(sentence);
  Heading out;
  out.heading_deg = fields.decimal(0, 360);
  out.is_true = type == Type::hdt || type == Type::ths;
  switch (type) {
    case Type::hdt:
    case Type::hdm: {
      const char reference = fields.letter();
      if (reference != '\0' && reference != (out.is_true ? 'T' : 'M')) fields.refuse();
      break;
    }
    case Type::hdg:
      out.deviation_deg = fields.signed_by_letter('E', 'W', 180);
      out.variation_deg = fields.signed_by_letter('E', 'W', 180);
      break;
    case Type::ths: out.mode = fields.optional_letter(); break;
    default: return std::nullopt;
  }
  return fields.if_in_range(out);
}

std::optional<Attitude> decode_attitude(const Sentence& sentence) {
  Attitude out;
  const auto* const form = std::ranges::find_if(
      kAttitudeForms, [&](const auto& one) { return sentence.address().ends_with(one.ending); });
  if (form == std::end(kAttitudeForms)) return std::nullopt;
  if (sentence[form->mark] != form->marked || sentence[form->quality] == "0") return out;
  FieldReader fields(sentence);
  const auto angle = [&](std::size_t field, double low, double high) {
    fields.seek(field);
    auto number = fields.decimal(low, high);
    const std::string_view side = fields.text();  // PHTRO: nose-down or port-down
    if (number && (side == "P" || side == "B")) number->mantissa = -number->mantissa;
    return number;
  };
  out.heading_deg = angle(form->heading, 0, 360);
  out.pitch_deg = angle(form->pitch, -90, 90);
  out.roll_deg = angle(form->roll, -180, 180);
  return fields.if_in_range(out);
}

std::optional<Rot> decode_rot(const Sentence& sentence) {
  FieldReader fields(sentence);
  Rot out;
  out.rate_deg_min = fields.decimal(-kMaxRate_deg_min, kMaxRate_deg_min);
  out.valid = fields.letter() == 'A';
  return fields.if_in_range(out);
}

std::optional<Xdr> decode_xdr(const Sentence& sentence) {
  FieldReader fields(sentence);
  Xdr out;
  while (!fields.at_end() && out.count < Xdr::kMaxTransducers) {
    auto& transducer = out.transducers[out.count++];
    transducer.type = fields.letter();
    transducer.value = fields.decimal();
    transducer.unit = fields.letter();
    transducer.name = fields.text();
  }
  return fields.if_in_range(out);
}

std::optional<Ptnthtm> decode_ptnthtm(const Sentence& sentence) {
  FieldReader fields(sentence);
  Ptnthtm out;
  out.heading = fields.decimal();
  out.magnetic_status = fields.letter();
  out.pitch = fields.decimal();
  out.pitch_status = fields.letter();
  out.roll = fields.decimal();
  out.roll_status = fields.letter();
  out.dip = fields.decimal();
  out.horizontal_field = fields.decimal();
  return fields.if_in_range(out);
}

std::optional<Depth> decode_depth(const Sentence& sentence, Type type) {
  FieldReader fields(sentence);
  Depth out;
  if (type == Type::dbt) {
    out = below_transducer(fields);
  } else if (type == Type::dpt) {
    if (const auto depth = fields.decimal(0, kMaxDepth_m)) out.depth_m = depth->value();
    out.offset_m = fields.decimal(-kMaxDepth_m, kMaxDepth_m);
    out.range_m = fields.decimal(0, kMaxDepth_m);
  } else {
    return std::nullopt;
  }
  return fields.if_in_range(out);
}

}  // namespace navcal::protocols::nmea
