// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "instruments/instrument.h"
#include "instruments/start_up.h"

// What devices.cpp binds to the names of the devices.
namespace navcal::instruments {

/// Instruments without a state: the reading of one frame.
using Read = Verdict(const protocols::Frame& frame, const config::PortSettings& settings, Receiver& receiver);
Read read_imu_card, read_keller, read_motor_card, read_pni, read_samples, read_tcm2, read_vectornav;

using MakeInstrument = std::unique_ptr<Instrument>(const config::PortSettings& settings);
MakeInstrument make_described, make_mavlink, make_mip, make_nmea, make_oncore, make_paroscientific, make_pd0,
    make_pd6, make_ubx, make_water_linked;

/// The dialogue of each device that takes commands.
using MakeStartUp = std::unique_ptr<StartUp>(const config::PortSettings& settings);
MakeStartUp start_described, start_keller, start_mavlink, start_mip, start_oncore, start_paroscientific, start_pni,
    start_tcm2, start_ubx, start_vectornav;

}  // namespace navcal::instruments
