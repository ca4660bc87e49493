// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <variant>

#include "protocols/described/scanner.h"
#include "protocols/device_types.h"
#include "protocols/gps_stream.h"
#include "protocols/imu_card.h"
#include "protocols/keller.h"
#include "protocols/mavlink.h"
#include "protocols/mip.h"
#include "protocols/motor_card.h"
#include "protocols/nmea.h"
#include "protocols/oncore.h"
#include "protocols/paroscientific.h"
#include "protocols/pd0.h"
#include "protocols/pd6.h"
#include "protocols/samples_line.h"
#include "protocols/tcm2.h"
#include "protocols/trax.h"
#include "protocols/ubx.h"
#include "protocols/vectornav.h"
#include "protocols/water_linked.h"

/// Which parser each device has.
namespace navcal::protocols {

/// `Own` finds the frames of the protocol, `AtPort` also those of another one that the device may change to.
template <Scanner S, Scanner Port = S>
struct Scanners {
  using Own = S;
  using AtPort = Port;
};

/// Not defined, so that a device without its line below does not compile.
template <Protocol>
struct ScannersOf;
template <>
struct ScannersOf<Protocol::tcm2> : Scanners<tcm2::Scanner> {};
template <>
struct ScannersOf<Protocol::imu_card> : Scanners<imu_card::Scanner> {};
template <>
struct ScannersOf<Protocol::oncore> : Scanners<oncore::Scanner, GpsStreamScanner> {};
template <>
struct ScannersOf<Protocol::motor_card> : Scanners<motor_card::Scanner> {};
template <>
struct ScannersOf<Protocol::nmea> : Scanners<nmea::Scanner, nmea::PortScanner> {};
template <>
struct ScannersOf<Protocol::ubx> : Scanners<ubx::Scanner, ubx::PortScanner> {};
template <>
struct ScannersOf<Protocol::mip> : Scanners<mip::Scanner> {};
template <>
struct ScannersOf<Protocol::vectornav> : Scanners<vectornav::Scanner> {};
template <>
struct ScannersOf<Protocol::pni> : Scanners<trax::Scanner> {};
template <>
struct ScannersOf<Protocol::pd0> : Scanners<pd0::Scanner> {};
template <>
struct ScannersOf<Protocol::pd6> : Scanners<pd6::Scanner> {};
template <>
struct ScannersOf<Protocol::water_linked> : Scanners<water_linked::Scanner> {};
template <>
struct ScannersOf<Protocol::samples> : Scanners<samples_line::Scanner> {};
template <>
struct ScannersOf<Protocol::paroscientific> : Scanners<paroscientific::Scanner> {};
template <>
struct ScannersOf<Protocol::keller> : Scanners<keller::Scanner> {};
template <>
struct ScannersOf<Protocol::described> : Scanners<described::Scanner> {};
template <>
struct ScannersOf<Protocol::mavlink> : Scanners<mavlink::Scanner> {};

template <class Rows>
struct PortParsers;
template <std::size_t... Row>
struct PortParsers<std::index_sequence<Row...>> {
  using Any = std::variant<StreamParser<typename ScannersOf<kDeviceTypes[Row].protocol>::AtPort>...>;
  template <std::size_t Place>
  static Any make() {
    return Any(std::in_place_index<Place>);
  }
  static constexpr std::array<Any (*)(), sizeof...(Row)> kMakers{&make<Row>...};
};

/// The parser of a port, whichever device is there.
using AnyPortParser = PortParsers<std::make_index_sequence<kDeviceCount>>::Any;

/// `description` is that of a described device; without one its parser finds nothing. `requires_checksum` is of
/// NMEA 0183.
[[nodiscard]] inline AnyPortParser make_port_parser(Protocol protocol,
                                                    const described::Description* description = nullptr,
                                                    bool requires_checksum = true) {
  if (protocol == Protocol::nmea)
    return AnyPortParser(StreamParser<nmea::PortScanner>(nmea::PortScanner{{}, requires_checksum}));
  if (protocol == Protocol::described && description != nullptr) {
    constexpr auto kDescribed = static_cast<std::size_t>(Protocol::described);
    return AnyPortParser(std::in_place_index<kDescribed>, described::Scanner(described::compile(*description)));
  }
  return PortParsers<std::make_index_sequence<kDeviceCount>>::kMakers.at(static_cast<std::size_t>(protocol))();
}

}  // namespace navcal::protocols
