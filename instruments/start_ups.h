// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "instruments/start_up.h"

namespace navcal::instruments {

/// The dialogue of each device that takes commands. make_start_up() chooses.
[[nodiscard]] std::unique_ptr<StartUp> start_tcm2(const config::PortSettings& settings);
[[nodiscard]] std::unique_ptr<StartUp> start_oncore(const config::PortSettings& settings);
[[nodiscard]] std::unique_ptr<StartUp> start_ubx(const config::PortSettings& settings);
[[nodiscard]] std::unique_ptr<StartUp> start_mip(const config::PortSettings& settings);
[[nodiscard]] std::unique_ptr<StartUp> start_vectornav(const config::PortSettings& settings);
[[nodiscard]] std::unique_ptr<StartUp> start_pni(const config::PortSettings& settings);
[[nodiscard]] std::unique_ptr<StartUp> start_paroscientific(const config::PortSettings& settings);
[[nodiscard]] std::unique_ptr<StartUp> start_keller(const config::PortSettings& settings);
[[nodiscard]] std::unique_ptr<StartUp> start_described(const config::PortSettings& settings);

}  // namespace navcal::instruments
