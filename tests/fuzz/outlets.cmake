# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_signalk_client SOURCES signalk_client.cpp USES navcal::web nlohmann_json::nlohmann_json)
