# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_fleet SOURCES fleet.cpp USES navcal::fleet)
navcal_fuzz(fuzz_fleet_evidence SOURCES fleet_evidence.cpp USES navcal::fleet)
