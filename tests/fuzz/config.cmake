# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_toml SOURCES toml.cpp USES navcal::config)
navcal_fuzz(fuzz_description SOURCES description.cpp USES navcal::config)
navcal_fuzz(fuzz_mission SOURCES mission.cpp USES navcal::config)
